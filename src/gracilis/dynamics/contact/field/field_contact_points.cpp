#include <gracilis/dynamics/contact/field/field_contact_points.hpp>

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

}  // namespace gracilis
