#include <gracilis/methods/xpbd/presets.hpp>

#include <gracilis/methods/xpbd/settings.hpp>
#include <gracilis/scene/setting_values.hpp>

namespace gracilis {

static Preset thesis_2024() {
  Preset preset;
  preset.name = "thesis-2024";
  preset.meaning = "the published setting, with everything that this project added switched off";
  XpbdSettings xpbd;
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
  xpbd.fiber_direction = FiberDirection::nearest_fiber;
  xpbd.anisotropy_floor = 0;
  xpbd.dihedral_stiffness = 1e8;
  xpbd.dihedral_shape_scaling = false;
  xpbd.dihedral_formula = DihedralFormula::arccos;
  xpbd.volume_compliance = 0;
  xpbd.pressure = 1;
  xpbd.bone_margin = 0.001;
  xpbd.bone_rest_gap = false;
  xpbd.edge_contact = false;
  xpbd.tunnelling = MotionGuard::turned_direction;
  xpbd.predictor = Predictor::none;
  xpbd.skinning = Skinning::bodies;
  xpbd.tendon_length = 0;
  xpbd.step_turn = 0;
  xpbd.settling_rounds = 0;
  xpbd.shape_recovery = 0;
  xpbd.dihedral_limit = 0;
  xpbd.stretch_limit = 0;
  xpbd.spike_limit = 0;
  xpbd.thickness_limit = 0;
  xpbd.thinness_limit = 0;
  xpbd.slack_uptake = false;
  preset.distance_fields.resolution = 128;
  preset.distance_fields.domain_margin = 0;
  preset.distance_fields.domain_factor = 1.5;
  preset.method.settings = changed_values(xpbd);
  ContactSettings contact;
  contact.muscle = MuscleContact::virtual_edges;
  contact.self = false;
  preset.method.contact = changed_values(contact);
  preset.contraction.stiffness = 1e2;
  preset.contraction.threshold = 0;
  preset.contraction.two_sided = true;
  preset.contraction.ramp = false;
  preset.contraction.spread = false;
  preset.contraction.area_scaling = false;
  preset.contraction.paths = SurfacePaths::nearest_joined;
  preset.contraction.reject_across = false;
  return preset;
}

static Preset fast() {
  Preset preset;
  preset.name = "fast";
  preset.meaning = "nearly the shapes of `physical` from coarser copies of the muscles, in a fraction of the time";
  XpbdSettings xpbd;
  xpbd.simulated_edge = 0.006;
  xpbd.iterations = 15;
  xpbd.full_iterations = 1;
  preset.method.settings = changed_values(xpbd);
  return preset;
}

std::vector<Preset> xpbd_presets() {
  return {{"physical", "real masses and units, and what this project added for stability"}, thesis_2024(), fast()};
}

}  // namespace gracilis
