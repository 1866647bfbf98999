#include <gracilis/strings/section_rates.hpp>

#include <gracilis/strings/cross_sections.hpp>

#include <Eigen/LU>

namespace gracilis::strings {

Eigen::Matrix3d rate_of_unit(const Vec3& v) {
  const Real length = v.norm();
  if (!(length > 0)) return Eigen::Matrix3d::Zero();
  const Vec3 unit = v / length;
  return (Eigen::Matrix3d::Identity() - unit * unit.transpose()) / length;
}

SectionRates::SectionRates(const MuscleStrings& muscle, const Points& places)
    : muscle_(muscle), turns_(section_turns(muscle, places)), arms_(3, places.cols()), directions_(3, muscle.nodes) {
  softness_.assign(static_cast<std::size_t>(muscle.nodes), Eigen::Matrix3d::Zero());
  mean_rate_ = softness_;
  unit_rate_.assign(static_cast<std::size_t>(places.cols()), Eigen::Matrix3d::Zero());
  for (Index i = 1; i + 1 < muscle.nodes; ++i) {
    const auto section = static_cast<std::size_t>(i);
    const StringSection rest = string_section(muscle, muscle.taut, i), now = string_section(muscle, places, i);
    Eigen::Matrix3d stretch = Eigen::Matrix3d::Zero();
    for (Index s = 0; s < muscle.strings; ++s) {
      const Index p = muscle.node(s, i);
      unit_rate_[static_cast<std::size_t>(p)] = rate_of_unit(places.col(p + 1) - places.col(p - 1));
      arms_.col(p) = turns_[section] * (muscle.taut.col(p) - rest.center);
      stretch += (places.col(p) - now.center) * arms_.col(p).transpose();
    }
    directions_.col(i) = rest.spread * (turns_[section] * rest.direction.normalized());
    stretch += now.direction.normalized() * directions_.col(i).transpose();
    mean_rate_[section] = rate_of_unit(now.direction);
    // With M = S R, S symmetric, and a turn w: (tr S - S) w is the axial vector of dM Rᵀ - R dMᵀ.
    const Eigen::Matrix3d symmetric = (stretch + stretch.transpose()) / 2;
    const Eigen::Matrix3d stiffness = symmetric.trace() * Eigen::Matrix3d::Identity() - symmetric;
    if (std::abs(stiffness.determinant()) > 0) softness_[section] = stiffness.inverse();
  }
}

Points SectionRates::turning(const Points& rates) const {
  Points turning = Points::Zero(3, muscle_.nodes);
  for (Index i = 1; i + 1 < muscle_.nodes; ++i) {
    const auto section = static_cast<std::size_t>(i);
    Vec3 moment = Vec3::Zero(), direction = Vec3::Zero();
    for (Index s = 0; s < muscle_.strings; ++s) {
      const Index p = muscle_.node(s, i);
      moment += Vec3(arms_.col(p)).cross(Vec3(rates.col(p)));
      direction += unit_rate_[static_cast<std::size_t>(p)] * (rates.col(p + 1) - rates.col(p - 1));
    }
    moment += Vec3(directions_.col(i)).cross(mean_rate_[section] * direction);
    turning.col(i) = softness_[section] * moment;
  }
  return turning;
}

void SectionRates::add_transposed(const Points& weights, Points& rates) const {
  for (Index i = 1; i + 1 < muscle_.nodes; ++i) {
    const auto section = static_cast<std::size_t>(i);
    const Vec3 moment = softness_[section].transpose() * weights.col(i);
    const Vec3 direction = mean_rate_[section] * moment.cross(Vec3(directions_.col(i)));
    for (Index s = 0; s < muscle_.strings; ++s) {
      const Index p = muscle_.node(s, i);
      rates.col(p) += moment.cross(Vec3(arms_.col(p)));
      const Vec3 along = unit_rate_[static_cast<std::size_t>(p)] * direction;
      rates.col(p + 1) += along, rates.col(p - 1) -= along;
    }
  }
}

}  // namespace gracilis::strings
