#include <gracilis/dynamics/contact/field/two_obstacle_contact.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace gracilis {

namespace {

/// What of both constraints' normal equations is added to their diagonal: between parallel surfaces no direction leads
/// out and the step must stay small.
constexpr float damping = 1e-3f;

/// A particle against one of two obstacles: G·Δ must reach `missing`.
struct Press {
  Eigen::Vector3f gradient;
  float missing = 0;
};

Press press_of(const FieldContactSet& set, const FieldPlacement& placement, const NearField& near, Index particle,
               const Eigen::Vector3f& x) {
  const FieldSample at = sample(set.field.grid, placement.to_obstacle(x));
  return {placement.rotation.transpose() * at.gradient, near.gap[static_cast<std::size_t>(particle)] - at.distance};
}

bool may_press(const FieldPlacement& placement, const NearField& near, Index particle, const Eigen::Vector3f& x) {
  const auto p = static_cast<std::size_t>(particle);
  return may_reach(near.last[p], placement.to_obstacle(x), near.gap[p]);
}

/// The shortest step that serves both; zero when one alone can be served without hurting the other, which the plain
/// contact does.
Eigen::Vector3f way_out(const Press& one, const Press& other) {
  const Press &first = one.missing > other.missing ? one : other, &second = one.missing > other.missing ? other : one;
  const float a = first.gradient.squaredNorm(), b = second.gradient.squaredNorm();
  const float c = first.gradient.dot(second.gradient);
  if (!(first.missing > 0) || !(a > 0) || !(b > 0) || c * first.missing / a >= second.missing)
    return Eigen::Vector3f::Zero();
  const float da = a * (1 + damping), db = b * (1 + damping), determinant = da * db - c * c;
  return (first.gradient * (db * first.missing - c * second.missing) +
          second.gradient * (da * second.missing - c * first.missing)) /
         determinant;
}

}  // namespace

Index project_two_obstacle_contact(const std::vector<FieldContactSet>& sets,
                                   const std::vector<FieldPlacement>& placements, const std::vector<NearField>& near,
                                   Particles& particles) {
  Index count = 0;
  std::vector<Index> common;
  for (std::size_t i = 0; i < sets.size(); ++i)
    for (std::size_t j = i + 1; j < sets.size(); ++j) {
      if (near[i].particles.empty() || near[j].particles.empty()) continue;
      common.clear();
      std::set_intersection(near[i].particles.begin(), near[i].particles.end(), near[j].particles.begin(),
                            near[j].particles.end(), std::back_inserter(common));
      const float longest = std::min(safe_step(*sets[i].field.field), safe_step(*sets[j].field.field));
      for (const Index p : common) {
        const Eigen::Vector3f x = particles.position(p);
        if (!may_press(placements[i], near[i], p, x) && !may_press(placements[j], near[j], p, x)) continue;
        Eigen::Vector3f step =
            way_out(press_of(sets[i], placements[i], near[i], p, x), press_of(sets[j], placements[j], near[j], p, x));
        const float length = step.norm();
        if (!(length > 0)) continue;
        if (length > longest) step *= longest / length;
        particles.position(p) += step;
        ++count;
      }
    }
  return count;
}

}  // namespace gracilis
