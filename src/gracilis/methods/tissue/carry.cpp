#include <gracilis/methods/tissue/carry.hpp>

#include <gracilis/methods/tissue/total_energy.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis::tissue {

namespace {

constexpr int most_steps = 8;
constexpr int carry_halvings = 10;
/// A carried state has no tetrahedron with less of its volume.
constexpr Real least_carried_ratio = 0.05;

std::size_t at(Index body) { return static_cast<std::size_t>(body); }

/// How a carrier moves as the first carrier sees it.
RigidTransform seen(const PreparedTissue& muscle, const std::vector<RigidTransform>& bodies, Index body) {
  return bodies[at(muscle.carriers[0])].inverse() * bodies[at(body)];
}

RigidTransform between(const RigidTransform& from, const RigidTransform& to, const Vec3& center, Real share) {
  const Eigen::Quaterniond a(from.linear()), b(to.linear());
  RigidTransform result(a.slerp(share, b));
  const Vec3 place = (1 - share) * (from * center) + share * (to * center);
  result.translation() = place - result.linear() * center;
  return result;
}

Points carried(const PreparedTissue& muscle, const std::vector<RigidTransform>& before,
               const std::vector<RigidTransform>& now, const Points& nodes) {
  std::vector<RigidTransform> motions;
  for (const Index body : muscle.carriers) motions.push_back(now[at(body)] * before[at(body)].inverse());
  Points result = nodes;
  for (Index n = 0; n < static_cast<Index>(nodes.cols()); ++n) {
    Vec3 sum = Vec3::Zero();
    Real shares = 0;
    for (std::size_t b = 0; b < motions.size(); ++b) {
      const Real share = muscle.skinning_weights(n, static_cast<Index>(b));
      sum += share * (motions[b] * Vec3(nodes.col(n)));
      shares += share;
    }
    if (shares > 0) result.col(n) = sum / shares;
  }
  return result;
}

}  // namespace

int steps_needed(const PreparedTissue& muscle, const std::vector<RigidTransform>& before,
                 const std::vector<RigidTransform>& now) {
  if (muscle.carriers.empty()) return 1;
  const Vec3 center = muscle.lattice.nodes.rowwise().mean();
  Real parts = 1;
  for (const Index body : muscle.carriers) {
    const RigidTransform from = seen(muscle, before, body), to = seen(muscle, now, body);
    const Real turn = Eigen::AngleAxisd(from.linear().transpose() * to.linear()).angle();
    const Real shift = (to * center - from * center).norm();
    parts = std::max({parts, turn / muscle.settings.largest_turn, shift / muscle.lattice.cell_size});
  }
  // Rounding of a pose shall not make a step of its own.
  return std::max(1, static_cast<int>(std::min<Real>(most_steps, std::ceil(parts - 1e-6))));
}

std::vector<RigidTransform> bodies_after(int steps, int count, const PreparedTissue& muscle,
                                         const std::vector<RigidTransform>& before,
                                         const std::vector<RigidTransform>& now) {
  std::vector<RigidTransform> bodies = now;
  if (steps == count) return bodies;
  const Vec3 center = muscle.lattice.nodes.rowwise().mean();
  const Real share = static_cast<Real>(steps) / static_cast<Real>(count);
  for (const Index body : muscle.carriers)
    bodies[at(body)] =
        now[at(muscle.carriers[0])] * between(seen(muscle, before, body), seen(muscle, now, body), center, share);
  return bodies;
}

void carry(const PreparedTissue& muscle, const std::vector<RigidTransform>& before,
           const std::vector<RigidTransform>& now, Points& nodes) {
  if (muscle.carriers.empty()) return;
  // With the first carrier all the way, which inverts nothing; the others then move as it sees them.
  const RigidTransform first = now[at(muscle.carriers[0])] * before[at(muscle.carriers[0])].inverse();
  const Points start = (first.linear() * nodes).colwise() + first.translation();
  const Points aim = carried(muscle, before, now, nodes);
  const Real least = std::min(least_carried_ratio, least_volume_ratio(muscle.lattice, start) / 2);
  Real share = 1;
  for (int i = 0; i < carry_halvings; ++i, share /= 2) {
    nodes = start + share * (aim - start);
    if (least_volume_ratio(muscle.lattice, nodes) > least) return;
  }
  nodes = start;
}

}  // namespace gracilis::tissue
