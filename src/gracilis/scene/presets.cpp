#include <gracilis/scene/presets.hpp>

namespace gracilis {

static Preset thesis_2024() {
  Preset preset;
  preset.name = "thesis-2024";
  preset.meaning = "the published setting, with everything that this project added switched off";
  XpbdSettings& xpbd = preset.xpbd;
  xpbd.iterations = 70;
  xpbd.time_step = 0.001;
  xpbd.constraint_time_step = 1;
  xpbd.time_mode = TimeMode::dynamic;
  xpbd.damping = 0.9;
  xpbd.gravity = Vec3::Zero();
  xpbd.rayleigh_beta = 0.01;
  xpbd.unit_masses = true;
  xpbd.distance_shape_scaling = false;
  xpbd.distance_stiffness = 1e2;
  xpbd.fiber_anisotropy = true;
  xpbd.anisotropy_floor = 0;
  xpbd.dihedral_stiffness = 1e8;
  xpbd.dihedral_shape_scaling = false;
  xpbd.dihedral_formula = DihedralFormula::arccos;
  xpbd.volume_compliance = 0;
  xpbd.pressure = 1;
  xpbd.bone_margin = 0.001;
  xpbd.bone_rest_gap = false;
  xpbd.edge_contact = false;
  xpbd.tunnelling = TunnellingGuard::turned_direction;
  xpbd.predictor = false;
  xpbd.skinning = Skinning::bodies;
  xpbd.tendon_length = 0;
  xpbd.step_turn = 0;
  xpbd.settling_rounds = 0;
  xpbd.shape_recovery = 0;
  xpbd.hinge_limit = 0;
  xpbd.stretch_limit = 0;
  xpbd.slack_uptake = false;
  preset.distance_fields.resolution = 128;
  preset.distance_fields.domain_margin = 0;
  preset.distance_fields.domain_factor = 1.5;
  preset.contact.muscle = MuscleContact::virtual_edges;
  preset.contact.self = false;
  preset.contact.seed_reach = 0.02;
  preset.contact.update_period = 5;
  preset.contact.walk_steps = 100;
  preset.contact.contact_distance = 0.002;
  preset.contact.adaptive_distance = false;
  preset.contact.resolution = VirtualEdgeResolution::vector_sum;
  preset.contact.reset_edges = false;
  preset.contact.coinciding_edges = CoincidingEdges::keep;
  preset.contraction.stiffness = 1e2;
  preset.contraction.spread = false;
  preset.contraction.paths = SurfacePaths::nearest_joined;
  return preset;
}

static Preset fast() {
  Preset preset;
  preset.name = "fast";
  preset.meaning = "nearly the shapes of `physical` from coarser copies of the muscles, in a fraction of the time";
  preset.xpbd.simulated_edge = 0.006;
  preset.xpbd.iterations = 15;
  preset.xpbd.full_iterations = 1;
  return preset;
}

const std::vector<Preset>& presets() {
  static const std::vector<Preset> all = {
      {"physical", "real masses and units, and what this project added for stability", {}, {}, {}, {}},
      thesis_2024(),
      fast()};
  return all;
}

const Preset* find_preset(std::string_view name) {
  for (const Preset& preset : presets())
    if (preset.name == name) return &preset;
  return nullptr;
}

}  // namespace gracilis
