#include <gracilis/methods/xpbd/settings.hpp>

#include <gracilis/methods/method_entry.hpp>

namespace gracilis {

template <>
std::span<const Setting<XpbdSettings>> setting_table() {
  using S = XpbdSettings;
  static const Setting<S> table[] = {
      {"iterations", &S::iterations, "", 1, 100000, "Inner iterations of the solver in each substep."},
      {"substeps", &S::substeps, "", 1, 1000, "Outer steps of the solver in each frame.", true},
      {"time_step", &S::time_step, "s", 0, 1,
       "Time that passes in a frame; 0 takes what passes between the motion's poses."},
      {"constraint_time_step", &S::constraint_time_step, "s", 0, 1000,
       "Time step inside the distance and dihedral projections; 0 takes the substep's own, as the theory asks."},
      {"time_mode", &S::time_mode, "", 0, 0,
       "'quasi_static' carries no velocity from frame to frame, 'dynamic' gives the muscle inertia."},
      {"damping", &S::damping, "", 0, 1, "Factor on all velocities in each step; used by the dynamic mode only."},
      {"gravity", &S::gravity, "m/s²", -1000, 1000, "Acceleration of free fall."},
      {"rayleigh_beta", &S::rayleigh_beta, "N·s/m", 0, 1e6,
       "Rayleigh dissipation of edges, contractions and (in N·m·s) dihedrals: resists what changes them within a step, "
       "in both time modes."},
      {"stop_displacement", &S::stop_displacement, "m", 0, 1,
       "A substep ends early once no vertex moved further in an iteration; 0 never ends it early."},
      {"stop_milliseconds", &S::stop_milliseconds, "ms", 0, 1e6,
       "A frame ends early after this time, which makes results depend on the machine; 0 never ends it early."},
      {"simulated_edge", &S::simulated_edge, "m", 0, 0.1,
       "Edge length of a coarser copy of the muscle that is simulated and that the surface follows; 0 simulates the "
       "surface itself."},
      {"full_iterations", &S::full_iterations, "", 0, 100000,
       "Iterations on the whole surface in each frame, from where its coarser copy takes it; used with simulated_edge "
       "and target_fps."},
      {"target_fps", &S::target_fps, "1/s", 0, 1000,
       "Rate of frames to hold by fewer iterations and a coarser copy, which makes results depend on the machine. "
       "0 holds none.",
       true},
      {"unit_masses", &S::unit_masses, "", 0, 0,
       "Gives every vertex 1 kg, as the published setting does, instead of its share of the muscle's mass."},
      {"density", &S::density, "kg/m³", 1, 1e5, "Density of muscle; ignored with unit masses."},
      {"distance_stiffness", &S::distance_stiffness, "N/m", 0, 1e18,
       "Stiffness of the surface's edges against stretch."},
      {"distance_shape_scaling", &S::distance_shape_scaling, "", 0, 0,
       "Scales each edge's stiffness by A/l² (l its length, A its two triangles), which makes it independent of the "
       "mesh."},
      {"fiber_anisotropy", &S::fiber_anisotropy, "", 0, 0,
       "Scales each edge's stiffness by 1 - |u·v|, u along the edge and v along the fibers."},
      {"fiber_direction", &S::fiber_direction, "", 0, 0,
       "Which way fibers run at an edge, for its anisotropy: 'harmonic' along the gradient of the harmonic coordinate "
       "from origins to insertions, 'nearest_fiber' as the nearest fiber, as published, where there are fibers."},
      {"anisotropy_floor", &S::anisotropy_floor, "", 0, 1, "Smallest factor that the anisotropy may reach."},
      {"dihedral_stiffness", &S::dihedral_stiffness, "N·m", 0, 1e18,
       "Stiffness of the surface's dihedrals against bending."},
      {"dihedral_shape_scaling", &S::dihedral_shape_scaling, "", 0, 0,
       "Scales each dihedral's stiffness by 3 l²/A (l its edge, A its two triangles), which makes it independent of "
       "the "
       "mesh."},
      {"dihedral_formula", &S::dihedral_formula, "", 0, 0,
       "Measure of the dihedral's angle: 'atan2' is stable everywhere, 'arccos' is the published one."},
      {"volume_compliance", &S::volume_compliance, "m⁶/J", 0, 1e6,
       "Compliance of the enclosed volume; 0 keeps it exactly."},
      {"pressure", &S::pressure, "", 0.01, 100, "Volume aimed at, as a multiple of the volume at rest."},
      {"bone_margin", &S::bone_margin, "m", 0, 0.1, "Gap kept between muscle and bone where the gap at rest allows."},
      {"bone_rest_gap", &S::bone_rest_gap, "", 0, 0,
       "Where a point is closer than the margin in the capture pose, keeps that gap, so that the rest stays at rest."},
      {"edge_contact", &S::edge_contact, "", 0, 0,
       "Keeps edges and large triangles out of the bones, not vertices only."},
      {"tunnelling", &S::tunnelling, "", 0, 0,
       "Keeps fast vertices from passing through bones: 'kept_path' limits each step along its path, "
       "'turned_direction' is "
       "the published test, 'none' does nothing."},
      {"slide_on_bone", &S::slide_on_bone, "", 0, 0,
       "Name of a bone from which the muscle does not lift off: vertices near it in the capture pose keep their "
       "distance "
       "and slide along it; empty for none."},
      {"slide_reach", &S::slide_reach, "m", 0, 0.1, "Vertices this near to that bone in the capture pose slide on it."},
      predictor_row<S>(),
      {"skinning", &S::skinning, "", 0, 0,
       "What carries them: 'strings', the muscle's fibers pulled tight among the bones, or 'bodies', a blend of the "
       "motions "
       "of the bodies that the muscle is attached to."},
      {"tendon_length", &S::tendon_length, "m", 0, 1,
       "Distance from the attachments over which the surface is graded from tendon to belly, so that the bones' motion "
       "stretches the belly and not the triangles beside an attachment; 0 grades nothing."},
      {"step_turn", &S::step_turn, "rad", 0, 3.2,
       "Largest turn of the muscle's bones against each other that is taken in one step; frames that turn them further "
       "are divided. 0 never divides."},
      {"settling_rounds", &S::settling_rounds, "", 0, 1000,
       "Rounds of volume and contact alone after the last iteration, so that neither undoes the other.", true},
      {"shape_recovery", &S::shape_recovery, "", 0, 1,
       "Share of its displacement from the skinned rest shape that the predictor takes back in each step."},
      {"hinge_limit", &S::dihedral_limit, "", 0, 10,
       "Largest motion that one projection of a dihedral may cause, as a share of its edge; 0 sets no limit."},
      {"stretch_limit", &S::stretch_limit, "", 0, 1000,
       "Longest an edge may become as a multiple of its length at rest; 0 sets no limit."},
      {"spike_limit", &S::spike_limit, "", 0, 1000,
       "Farthest a vertex may stand out from its neighbors beyond rest, as a multiple of the edges around it; 0 sets "
       "no limit."},
      {"thickness_limit", &S::thickness_limit, "", 0, 1000,
       "Thickest a place of the muscle may become as a multiple of its thickness at rest; 0 sets no limit."},
      {"thinness_limit", &S::thinness_limit, "", 0, 1000,
       "How many times as thin as at rest a place of the muscle may become; 0 sets no limit."},
      {"slack_uptake", &S::slack_uptake, "", 0, 0,
       "Edges aim at the lengths they have on the surface skinned to the bones, so that a muscle shortens and "
       "lengthens where the motion asks for it instead of folding."},
  };
  return table;
}

template <>
std::span<const Setting<ContactSettings>> setting_table() {
  using S = ContactSettings;
  static const Setting<S> table[] = {
      {"muscle", &S::muscle, "", 0, 0,
       "How muscles keep out of each other: 'surface' by nearest triangles and crossing edges, 'virtual-edges' as "
       "published, 'none' not at all."},
      {"self", &S::self, "", 0, 0,
       "A muscle keeps out of itself; with 'surface' only. Not where it is made of sections across a line."},
      {"margin", &S::margin, "m", 0, 0.1, "Gap kept between muscles where the gap at rest allows."},
      {"reach", &S::reach, "m", 0, 0.1,
       "Farthest that another muscle is looked for, once per step; with 'surface' only."},
  };
  return table;
}

/// Contact of both kinds has this setting, which a scene gives once.
static constexpr const char* update_period_meaning =
    "Frames after which everything is searched, or virtual edges seeded, from nothing but where the muscles are; "
    "--resume goes on from such a frame. What comes near sooner is found sooner.";

template <>
std::span<const Setting<SurfaceContactSettings>> setting_table() {
  using S = SurfaceContactSettings;
  static const Setting<S> table[] = {
      {"friction", &S::friction, "", 0, 10, "Coulomb's coefficient of friction between muscles."},
      {"cohesion", &S::cohesion, "m", 0, 0.1,
       "Farthest that parts of muscles which touch in the capture pose may part; 0 lets them."},
      {"update_period", &S::update_period, "", 1, 100000, update_period_meaning},
  };
  return table;
}

template <>
std::span<const Setting<VirtualEdgeSettings>> setting_table() {
  using S = VirtualEdgeSettings;
  static const Setting<S> table[] = {
      {"update_period", &S::update_period, "", 1, 100000, update_period_meaning},
      {"seed_reach", &S::reach, "m", 0, 1,
       "Virtual edges: longest that one may be where it is seeded, from each vertex of one muscle to the nearest of "
       "another."},
      {"walk_steps", &S::walk_steps, "", 1, 100000,
       "Virtual edges: most steps of a walk over neighboring vertices to a shorter edge."},
      {"contact_distance", &S::distance, "m", 0, 0.1,
       "Virtual edges: distance to which the ends of a shorter one are pushed apart."},
      {"adaptive_distance", &S::adaptive, "", 0, 0,
       "Virtual edges: raises the contact distance to what the ends came nearer in the step, at most to seed_reach."},
      {"resolution", &S::resolution, "", 0, 0,
       "Virtual edges: ends are pushed apart along the line between them ('push'), or leaned toward where they were "
       "before "
       "the step, as much as along the line ('unit_sum') or the more the farther they came ('vector_sum')."},
      {"reset_edges", &S::reset, "", 0, 0,
       "Virtual edges: walks begin at the seeds in every iteration instead of where the last one ended."},
      {"coinciding_edges", &S::coinciding, "", 0, 0,
       "Virtual edges: those that end a frame on the same vertices are left ('keep'), left out until the next seeding "
       "('drop'), or begin again at a random seed ('reseed')."},
  };
  return table;
}

XpbdSettings xpbd_settings(const Scene& scene, const Muscle& muscle) {
  return muscle_settings<XpbdSettings>(scene, muscle);
}

ContactSettings contact_settings(const Scene& scene) { return with_values(ContactSettings{}, scene.method.contact); }

}  // namespace gracilis
