#include <gracilis/dynamics/contact/field/field_contact_points.hpp>

#include <gracilis/dynamics/contact/field/near_field.hpp>

#include <limits>

namespace gracilis {

Eigen::Vector3f deepest_on_face(const FieldGrid& field, const std::array<ContactCorner, 3>& corners) {
  Eigen::Vector3f where = Eigen::Vector3f::Constant(1.0f / 3), best = where;
  float deepest = std::numeric_limits<float>::infinity();
  for (int step = 0; step < 6; ++step) {
    Eigen::Vector3f q = Eigen::Vector3f::Zero();
    float gap = 0;
    for (int k = 0; k < 3; ++k) {
      q += where[k] * corners[static_cast<std::size_t>(k)].q;
      gap += where[k] * corners[static_cast<std::size_t>(k)].gap;
    }
    const FieldSample at = sample(field, q);
    if (at.distance - gap < deepest) deepest = at.distance - gap, best = where;
    Eigen::Vector3f height;
    for (int k = 0; k < 3; ++k) {
      const ContactCorner& corner = corners[static_cast<std::size_t>(k)];
      height[k] = at.gradient.dot(corner.q) - corner.gap;
    }
    int lowest = 0;
    height.minCoeff(&lowest);
    const float stride = 2.0f / static_cast<float>(step + 3);
    where = (1 - stride) * where + stride * Eigen::Vector3f::Unit(lowest);
  }
  return best;
}

/// The part of a face that is tested, as barycentric coordinates of its corners, one per column. `movable` has ones and
/// zeros, and sums to more than 0.
static Eigen::Matrix3f tested_part(const Eigen::Vector3f& movable, float untested) {
  Eigen::Matrix3f part = Eigen::Matrix3f::Identity();
  for (int k = 0; k < 3; ++k)
    if (movable[k] == 0) part.col(k) += untested * (movable / movable.sum() - part.col(k));
  return part;
}

Eigen::Vector3f deepest_tested(const FieldGrid& grid, const std::array<ContactCorner, 3>& corners,
                               const Eigen::Vector3f& movable, float untested) {
  Eigen::Vector3f deepest = deepest_on_face(grid, corners);
  if (deepest.dot(movable) >= untested) return deepest;
  const Eigen::Matrix3f part = tested_part(movable, untested);
  std::array<ContactCorner, 3> tested;
  for (int k = 0; k < 3; ++k) {
    ContactCorner& corner = tested[static_cast<std::size_t>(k)] = {Eigen::Vector3f::Zero(), 0};
    for (int c = 0; c < 3; ++c) {
      corner.q += part(c, k) * corners[static_cast<std::size_t>(c)].q;
      corner.gap += part(c, k) * corners[static_cast<std::size_t>(c)].gap;
    }
  }
  return part * deepest_on_face(grid, tested);
}

}  // namespace gracilis
