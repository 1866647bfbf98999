#pragma once

#include <gracilis/methods/tissue/cell_energy.hpp>

/// What the tissue's energy has to give where the answer can be written down; derived in docs/mathematics.md.
namespace gracilis::tissue {

/// Resistance against change of volume where all tetrahedra of a cell have the same J.
inline Real volume_modulus(const CellLaw& law) { return law.matrix.lambda + law.bulk; }

/// Stretched along its fibers, its sides free: the stress (Pa, per area at rest), and J.
struct Uniaxial {
  Real stress = 0, volume_ratio = 1;
};
inline Uniaxial uniaxial(const CellLaw& law, Real stretch) {
  // The stiffened G depends on J, which is hardly changed by it.
  Real j = 1, stiffened = law.matrix.shear;
  for (int i = 0; i < 20; ++i) {
    stiffened = shear_curve(law.matrix, stretch * stretch + 2 * j / stretch).slope;
    j = 1 + (law.matrix.shear - stiffened / stretch) / volume_modulus(law);
  }
  const Real fibers = law.direction.isZero(0) ? 0 : fiber_curve(law.fibers, stretch).slope;
  return {stiffened * (stretch - j / (stretch * stretch)) + fibers, j};
}

/// F = 1 + shear · x ⊗ z: the first Piola-Kirchhoff stress, Pa.
inline Matrix3 simple_shear(const CellLaw& law, Real shear) {
  Matrix3 f = Matrix3::Identity();
  f(0, 2) = shear;
  const Real stiffened = shear_curve(law.matrix, f.squaredNorm()).slope;
  Matrix3 stress = (stiffened - law.matrix.shear) * Matrix3::Identity();
  stress(0, 2) = stiffened * shear;
  stress(2, 0) = law.matrix.shear * shear;
  const Vec3 along = f * law.direction;
  if (!along.isZero(0))
    stress += fiber_curve(law.fibers, along.norm()).slope / along.norm() * along * law.direction.transpose();
  return stress;
}

/// Small deformations of the matrix alone: Lamé's constants are G and the volume modulus less G.
struct Elastic {
  Real young = 0, poisson = 0, shear = 0;
};
inline Elastic elastic(const CellLaw& law) {
  const Real g = law.matrix.shear, lame = volume_modulus(law) - g;
  return {g * (3 * lame + 2 * g) / (lame + g), lame / (2 * (lame + g)), g};
}

/// The moment that bends a bar of a square section by so much per length, N·m.
inline Real bending_moment(const Elastic& bar, Real width, Real curvature) {
  return bar.young * std::pow(width, 4) / 12 * curvature;
}

/// The force that moves the tip of a clamped bar of a square section aside by `way` (Timoshenko; Cowper 1966), N.
inline Real tip_force(const Elastic& bar, Real width, Real length, Real way) {
  const Real shear_share = 10 * (1 + bar.poisson) / (12 + 11 * bar.poisson), area = width * width;
  return way / (std::pow(length, 3) / (3 * bar.young * area * area / 12) + length / (shear_share * bar.shear * area));
}

}  // namespace gracilis::tissue
