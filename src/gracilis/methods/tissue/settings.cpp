#include <gracilis/methods/tissue/settings.hpp>

#include <gracilis/methods/method_entry.hpp>

namespace gracilis {

template <>
std::span<const Setting<TissueSettings>> setting_table() {
  using S = TissueSettings;
  static const Setting<S> table[] = {
      {"cell_size", &S::cell_size, "m", 0.001, 0.1, "Edge of the cells of the lattice that fills a muscle."},
      {"cells_at_least", &S::cells_at_least, "", 0, 1000000,
       "A muscle whose volume is less than that of so many cells gets smaller ones."},
      {"minimizer_iterations", &S::minimizer_iterations, "", 1, 100000,
       "Iterations at most in each step: about 8 for a live picture, hundreds for forces."},
      {"minimizer_residual", &S::minimizer_residual, "N", 0, 1,
       "A step ends once the root mean square of the forces left on the lattice's nodes is no larger."},
      {"largest_turn", &S::largest_turn, "rad", 0.001, 1,
       "Where bodies turn further about each other in a frame, it is gone through in several steps, up to 8."},
      {"tension_frames", &S::tension_frames, "", 1, 100000,
       "Frames from the capture pose on in which the fibers' tension comes up evenly."},
      {"matrix_shear_modulus", &S::matrix_shear_modulus, "Pa", 1, 1e9, "Shear modulus of the tissue between fibers."},
      {"matrix_stiffening", &S::matrix_stiffening, "", 0, 100,
       "Where a cell is drawn out, its shear modulus is 1 + this times the square of |F|² - 3 times as large: 1.8 "
       "where it "
       "is twice as long, 10 where three times."},
      {"matrix_lambda", &S::matrix_lambda, "Pa", 1, 1e12,
       "Resistance of every tetrahedron against change of its own volume."},
      {"bulk_modulus", &S::bulk_modulus, "Pa", 0, 1e12, "Resistance of every cell against change of its volume."},
      {"shear_per_tension", &S::shear_per_tension, "", 0, 100,
       "Shear modulus of a cell is at least this times its fibers' tension, so that tendons and active muscles do not "
       "give way between fibers."},
      {"bulk_per_tension", &S::bulk_per_tension, "", 0, 1000,
       "Bulk modulus of a cell is at least this times its fibers' tension."},
      {"fiber_tension", &S::fiber_tension, "Pa", 0, 1e7,
       "Passive tension of fibers at their length in the capture pose, over the muscle's mean section."},
      {"fiber_stiffness", &S::fiber_stiffness, "Pa", 0, 1e9, "Growth of the passive tension by stretch."},
      {"largest_active_stress", &S::largest_active_stress, "Pa", 0, 1e7,
       "Tension of fully active fibers at their optimal length."},
      {"optimal_stretch", &S::optimal_stretch, "", 0.3, 3,
       "Length over that in the capture pose at which active fibers pull hardest."},
      {"attachment_stiffness", &S::attachment_stiffness, "N/m³", 0, 1e13,
       "Stiffness per area of the springs that hold attached vertices to their bones."},
      {"contact_stiffness", &S::contact_stiffness, "N/m³", 0, 1e13,
       "Stiffness per area of what keeps the surface off bones."},
      {"contact_gap", &S::contact_gap, "m", 0, 0.05,
       "Gap kept to bones, or that of the capture pose where it is smaller."},
      {"neighbor_gap", &S::neighbor_gap, "m", 0, 0.05,
       "Gap kept to other muscles, or that of the capture pose where it is smaller or the two overlap."},
      {"neighbor_stiffness", &S::neighbor_stiffness, "N/m³", 0, 1e13,
       "Stiffness per area of what keeps muscles out of each other. They are soft: where it is much stiffer than their "
       "bulk, thin ones lose volume between others."},
      {"neighbor_per_tension", &S::neighbor_per_tension, "1/m", 0, 1e6,
       "Stiffness of what keeps two muscles out of each other is at least this times the tension of the more active "
       "one's fibers, which press as much harder."},
      {"contact_rounds", &S::contact_rounds, "", 0, 100,
       "How often in a step muscles look where their neighbors are, the largest of all muscles; 0: they do not feel "
       "each "
       "other."},
      {"self_contact", &S::self_contact, "", 0, 0, "Keep a muscle out of itself, too, where it folds."},
      {"fascia_stiffness", &S::fascia_stiffness, "N/m³", 0, 1e13,
       "Stiffness per area of the ties of fascia to bones, across the fibers alone, where the surface touches a bone; "
       "less with distance."},
      {"fascia_reach", &S::fascia_reach, "m", 0.0001, 0.2, "Distance from a bone at which nothing ties to it anymore."},
      {"fascia_yield", &S::fascia_yield, "m", 1e-5, 1,
       "Fascia drawn much further than this pulls no harder than at this distance."},
  };
  return table;
}

TissueSettings tissue_settings(const Scene& scene, const Muscle& muscle) {
  return muscle_settings<TissueSettings>(scene, muscle);
}

}  // namespace gracilis
