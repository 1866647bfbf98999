#pragma once

#include <gracilis/core/aligned.hpp>
#include <gracilis/dynamics/constraints/color_order.hpp>
#include <gracilis/dynamics/constraints/projection_parameters.hpp>
#include <gracilis/dynamics/particles.hpp>

#include <array>
#include <cmath>
#include <vector>

namespace gracilis {

/// Signed dihedral angle in double precision, rad in (-π, π], 0 when flat: the edge runs from x0 to x1, x2 is the apex
/// of the triangle on its left, x3 of that on its right. 0 for degenerate triangles. The formula is that of the kernel.
inline Real dihedral_angle(const Vec3& x0, const Vec3& x1, const Vec3& x2, const Vec3& x3) {
  const Vec3 e = x1 - x0, n1 = e.cross(x2 - x0), n2 = (x3 - x0).cross(e);
  const Real length = e.norm();
  return length > 0 ? std::atan2(n1.cross(n2).dot(e) / length, n1.dot(n2)) : 0;
}

/// Two triangles keep the angle at their shared edge: \f$C = \theta(x) - \theta_0\f$, θ the signed angle between the
/// normals. Particles: the edge runs from `particles[0]` to `particles[1]`; [2] is the apex on its left, [3] on its
/// right.
struct DihedralSet {
  std::array<AlignedVector<Index>, 4> particles;
  AlignedVector<float> rest_angle;   ///< rad
  AlignedVector<float> compliance;   ///< 1/(N·m)
  AlignedVector<float> edge_length;  ///< m, in the capture pose
  ColorOrder order;
  Index count = 0;
};

/// One constraint, input of the builder.
struct DihedralConstraint {
  std::array<Index, 4> particles{};
  Real rest_angle = 0, compliance = 0, edge_length = 0;
};

/// Lays out constraints over `particle_count` particles, which the idle ones follow (color_order.hpp).
DihedralSet build_dihedral_set(const std::vector<DihedralConstraint>& constraints, Index particle_count);

/// Projects dihedrals of slots [begin, end), which belong to one color; `lambda` in N·m s² has one entry per slot,
/// `start` are the particles at the substep's beginning. Vectorised for the machine it runs on.
ProjectionCounts project_dihedrals(const DihedralSet& set, ColorRange range, float* lambda, const Particles& start,
                                   Particles& particles, const ProjectionParameters& parameters);

}  // namespace gracilis
