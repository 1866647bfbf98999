#include <gracilis/anatomy/attachments/body_carriers.hpp>

#include <gracilis/anatomy/attachments/skinning_weights.hpp>
#include <gracilis/core/parallel.hpp>
#include <gracilis/core/sort_unique.hpp>
#include <gracilis/geometry/rigid_blend.hpp>

#include <numeric>

namespace gracilis {

BodyCarriers body_carriers(const Muscle& muscle, const MeshTopology& topology, Real tendon_length) {
  BodyCarriers carriers;
  carriers.center = muscle.surface.vertices.rowwise().mean();
  carriers.fixed_body.assign(static_cast<std::size_t>(muscle.surface.vertex_count()), -1);
  for (const Attachment& attachment : muscle.attachments) {
    for (const Index v : attachment.vertices) carriers.fixed_body[static_cast<std::size_t>(v)] = attachment.body;
    carriers.bodies.push_back(attachment.body);
  }
  sort_unique(carriers.bodies);
  if (!carriers.bodies.empty())
    carriers.weights = skinning_weights(muscle.surface, topology, carriers.fixed_body, carriers.bodies, tendon_length);
  return carriers;
}

std::vector<char> held_vertices(const BodyCarriers& carriers) {
  std::vector<char> held;
  for (std::size_t v = 0; v < carriers.fixed_body.size(); ++v) {
    const bool is_reached = !carriers.bodies.empty() && carriers.weights.col(static_cast<Index>(v)).sum() > 0;
    held.push_back(carriers.fixed_body[v] >= 0 || !is_reached);
  }
  return held;
}

std::vector<RigidTransform> carried_motions(const BodyCarriers& carriers, const Pose& pose) {
  std::vector<Index> all(carriers.fixed_body.size());
  std::iota(all.begin(), all.end(), 0);
  return carried_motions(carriers, pose, all);
}

std::vector<RigidTransform> carried_motions(const BodyCarriers& carriers, const Pose& pose,
                                            const std::vector<Index>& vertices) {
  std::vector<RigidTransform> motions(vertices.size(), RigidTransform::Identity());
  if (carriers.bodies.empty()) return motions;
  const Eigen::Translation3d from_center(carriers.center);
  std::vector<RigidTransform> of_bodies;
  for (const Index body : carriers.bodies)
    of_bodies.push_back(from_center.inverse() * pose.bodies[static_cast<std::size_t>(body)] * from_center);
  const RigidBlend blended = prepare_blend(of_bodies);
  parallel_for(static_cast<Index>(motions.size()), 512, [&](Index begin, Index end) {
    std::vector<Real> weights(carriers.bodies.size());
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      const Index v = vertices[i];
      RigidTransform& motion = motions[i];
      if (const Index body = carriers.fixed_body[static_cast<std::size_t>(v)]; body >= 0) {
        motion = pose.bodies[static_cast<std::size_t>(body)];
        continue;
      }
      Real sum = 0;
      for (std::size_t b = 0; b < weights.size(); ++b)
        sum += weights[b] = static_cast<Real>(carriers.weights(static_cast<Index>(b), v));
      if (!(sum > 0)) continue;
      for (Real& weight : weights) weight /= sum;
      motion = from_center * blend(blended, weights) * from_center.inverse();
    }
  });
  return motions;
}

Points moved_by(const std::vector<RigidTransform>& motions, const Points& points) {
  Points moved(3, points.cols());
  for (Index i = 0; i < static_cast<Index>(points.cols()); ++i)
    moved.col(i) = motions[static_cast<std::size_t>(i)] * Vec3(points.col(i));
  return moved;
}

Points carried_on(const BodyCarriers& carriers, const Points& rest, const Pose& last, const Pose& now,
                  const Points& before) {
  const std::vector<RigidTransform> from = carried_motions(carriers, last), to = carried_motions(carriers, now);
  Points points(3, before.cols());
  for (Index v = 0; v < static_cast<Index>(points.cols()); ++v) {
    const auto at = static_cast<std::size_t>(v);
    const bool is_fixed = carriers.fixed_body[at] >= 0;
    points.col(v) = to[at] * (is_fixed ? Vec3(rest.col(v)) : Vec3(from[at].inverse() * Vec3(before.col(v))));
  }
  return points;
}

}  // namespace gracilis
