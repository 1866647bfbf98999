#pragma once

#include <gracilis/scene/scene.hpp>
#include <gracilis/scene/setting_table.hpp>

namespace gracilis {

/// Settings of one muscle of the method `tissue`. Stiffnesses of what acts on the surface are per area of it.
struct TissueSettings {
  Real cell_size = 0.008;            ///< m
  int cells_at_least = 500;          ///< a small muscle gets smaller cells
  int minimizer_iterations = 30;     ///< in each step
  Real minimizer_residual = 1e-4;    ///< N, root mean square over nodes
  Real largest_turn = radians(3);    ///< rad, between two bodies in one step
  int tension_frames = 10;           ///< in which the fibers' tension comes up
  Real matrix_shear_modulus = 5e3;   ///< Pa
  Real matrix_stiffening = 0.2;      ///< of the shear modulus, where the matrix is drawn out
  Real matrix_lambda = 1e5;          ///< Pa, of every tetrahedron
  Real bulk_modulus = 1e6;           ///< Pa, of the mean volume of a cell
  Real shear_per_tension = 0.25;     ///< least shear modulus over the fibers' tension
  Real bulk_per_tension = 30;        ///< least bulk modulus over the fibers' tension
  Real fiber_tension = 2e4;          ///< Pa, passive, at the length in the capture pose
  Real fiber_stiffness = 5e4;        ///< Pa per stretch
  Real largest_active_stress = 3e5;  ///< Pa
  Real optimal_stretch = 1;          ///< at which active fibers pull hardest
  Real attachment_stiffness = 3e8;   ///< N/m per m²
  Real contact_stiffness = 2e9;      ///< N/m per m²
  Real contact_gap = 0.004;          ///< m
  Real neighbor_gap = 0.0005;        ///< m, between muscles
  Real neighbor_stiffness = 1e8;     ///< N/m per m²
  Real neighbor_per_tension = 1300;  ///< 1/m: least neighbor stiffness over the active fibers' tension
  int contact_rounds = 2;            ///< of looking where other muscles are, in each step; 0: muscles do not meet
  bool self_contact = true;          ///< keeps a muscle out of itself where it folds
  Real fascia_stiffness = 1.5e7;     ///< N/m per m², at the bone
  Real fascia_reach = 0.03;          ///< m
  Real fascia_yield = 0.002;         ///< m
};

template <>
std::span<const Setting<TissueSettings>> setting_table();  ///< a row for each setting

/// A muscle's settings: its own, else the scene's, else the defaults.
TissueSettings tissue_settings(const Scene& scene, const Muscle& muscle);

}  // namespace gracilis
