#pragma once

#include <gracilis/core/types.hpp>

namespace gracilis::tissue {

using Matrix3 = Eigen::Matrix3d;
/// Second derivatives by the entries of F, column after column.
using Matrix9 = Eigen::Matrix<Real, 9, 9>;

/// Energy per volume at rest (J/m³) and its first two derivatives by a number.
struct Curve {
  Real energy = 0, slope = 0, curvature = 0;
};

/// How hard fibers pull: stretch → tension per area at rest, Pa.
struct FiberLaw {
  Real rest_tension = 0;     ///< Pa, at stretch 1
  Real stiffness = 0;        ///< Pa per stretch
  Real active_tension = 0;   ///< Pa: activation times maximal stress, at the optimal stretch
  Real optimal_stretch = 1;  ///< where the active tension is largest

  /// Of all tensions at once: a fiber bundle's tension, not its stress, is the same all along it.
  FiberLaw scaled(Real by) const { return {by * rest_tension, by * stiffness, by * active_tension, optimal_stretch}; }
};

/// The strain below which passive fibers keep the least tension they have; -infinity where they do not change it.
Real slack_strain(const FiberLaw& law);

/// The tension's integral, the tension and its slope. Passive: linear, never below a fifth of the tension at rest.
/// Active: the force-length curve of Blemker, Pinsky and Delp (2005), from 0.4 to 1.6 of the optimal stretch.
Curve fiber_curve(const FiberLaw& law, Real stretch);

/// Resists shear by `shear` (G, Pa), change of volume by `lambda` (Pa). Drawn out it gets stiffer: G is
/// 1 + `stiffening` (|F|² - 3)² times as large, the last term of Yeoh (1993).
struct MatrixLaw {
  Real shear = 0, lambda = 0, stiffening = 0;
};

/// What the matrix adds by |F|², and the factors of F and of F ⊗ F in its first and second derivatives by F.
Curve shear_curve(const MatrixLaw& law, Real squared_size);

/// What the matrix adds by J = det F alone: stable neo-Hookean (Smith, de Goes and Kim 2018, without the logarithm that
/// only moves the rest state) and, below `barrier_begin`, a barrier that is infinite at 0, so that nothing inverts. It
/// grows with the shear modulus, which grows with tension: else what pulls hard squeezes a tetrahedron to nothing, and
/// no step of a minimizer is short enough for it.
inline constexpr Real barrier_begin = 0.3, barrier_per_shear = 20;
/// At this J. Precondition: it is above 0.
Curve volume_curve(const MatrixLaw& law, Real volume_ratio);

/// Energy per volume at rest of matrix and fibers at the deformation gradient F, without what holds the cell's volume.
/// `direction` is the fibers' at rest, unit, or 0: none. `stress` gets the first Piola-Kirchhoff stress, Pa.
/// Precondition: det F above 0.
Real tissue_energy(const MatrixLaw& matrix, const FiberLaw& fibers, const Vec3& direction, const Matrix3& f,
                   Matrix3& stress);

/// Its second derivatives.
Matrix9 tissue_hessian(const MatrixLaw& matrix, const FiberLaw& fibers, const Vec3& direction, const Matrix3& f);

/// Cofactors: the derivative of det F.
inline Matrix3 cofactors(const Matrix3& f) {
  Matrix3 c;
  c.col(0) = f.col(1).cross(f.col(2));
  c.col(1) = f.col(2).cross(f.col(0));
  c.col(2) = f.col(0).cross(f.col(1));
  return c;
}

}  // namespace gracilis::tissue
