#include <gracilis/methods/mass_spring/spring_net.hpp>

#include <gracilis/core/parallel.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gracilis::mass_spring {

SpringNet build_spring_net(const Points& rest, const SpringPairs& pairs, Real material, Real shortest_share) {
  SpringNet net;
  std::vector<Index> ends;
  Real sum = 0;
  for (const auto& [a, b] : pairs) {
    const Real length = (rest.col(a) - rest.col(b)).norm();
    net.springs.push_back({a, b, length, 0});
    ends.insert(ends.end(), {a, b});
    sum += length;
  }
  const Real shortest = net.springs.empty() ? 0 : shortest_share * sum / static_cast<Real>(net.springs.size());
  for (Spring& spring : net.springs) {
    const Real length = std::max(spring.length, shortest);
    spring.stiffness = length > 0 ? material / length : 0;
  }
  net.ends = group_by_key(ends, static_cast<Index>(rest.cols()));
  return net;
}

void spring_forces(const SpringNet& net, const Points& points, Points& forces) {
  forces.resize(3, points.cols());
  parallel_for(static_cast<Index>(points.cols()), 256, [&](Index begin, Index end) {
    for (Index p = begin; p < end; ++p) {
      const Vec3 here = points.col(p);
      Vec3 force = Vec3::Zero();
      for (const Index item : net.ends.with(p)) {
        const Spring& spring = net.springs[static_cast<std::size_t>(item / 2)];
        const Vec3 along = here - points.col(item % 2 == 0 ? spring.b : spring.a);
        const Real length = along.norm();
        if (length > 0) force -= spring.stiffness * (length - spring.length) / length * along;
      }
      forces.col(p) = force;
    }
  });
}

Real length_changes(const SpringNet& net, const Points& points) {
  Real sum = 0;
  for (const Spring& spring : net.springs)
    sum += std::abs((points.col(spring.a) - points.col(spring.b)).norm() - spring.length);
  return sum;
}

Real mean_stiffness(const SpringNet& net) {
  Real sum = 0;
  for (const Spring& spring : net.springs) sum += spring.stiffness;
  return net.springs.empty() ? 0 : sum / static_cast<Real>(net.springs.size());
}

Real stable_step(const SpringNet& net, Real mass) {
  Real largest = 0;
  for (Index p = 0; p + 1 < static_cast<Index>(net.ends.begins.size()); ++p) {
    Real sum = 0;
    for (const Index item : net.ends.with(p)) sum += net.springs[static_cast<std::size_t>(item / 2)].stiffness;
    largest = std::max(largest, sum);
  }
  return largest > 0 ? 2 * std::sqrt(mass / (2 * largest)) : std::numeric_limits<Real>::infinity();
}

}  // namespace gracilis::mass_spring
