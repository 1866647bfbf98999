#include <gracilis/anatomy/attachments/muscle_bodies.hpp>

#include <gracilis/anatomy/attachments/body_carriers.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/nearest_points.hpp>
#include <gracilis/geometry/rotations.hpp>

#include <algorithm>
#include <cassert>
#include <set>

namespace gracilis {

namespace {

/// What lies on a muscle moves with the vertices within so many mean edges of it: enough to tell how they turn.
constexpr Real patch_edges = 3;

/// Vertices within `reach` of the surface's nearest points to `points`; the corners of the triangles there always.
std::vector<Index> patch_under(const TriangleMesh& surface, const Points& points, Real reach) {
  const NearestTriangle tree(surface);
  Points below(3, points.cols());
  std::set<Index> patch;
  for (Index i = 0; i < static_cast<Index>(points.cols()); ++i) {
    const NearestPoint nearest = tree.query(points.col(i));
    below.col(i) = nearest.point;
    for (const Index corner : surface.faces.col(nearest.face)) patch.insert(corner);
  }
  const NearestPoints near(below);
  for (Index v = 0; v < surface.vertex_count(); ++v) {
    const Vec3 vertex = surface.vertices.col(v);
    if ((below.col(near.nearest(vertex)) - vertex).norm() <= reach) patch.insert(v);
  }
  return {patch.begin(), patch.end()};
}

/// Which muscle carries the body; -1: none.
Index host_of(const Scene& scene, Index body) {
  const MuscleBody* found = muscle_body(scene, body);
  return found ? found->muscle : -1;
}

}  // namespace

Index add_muscle_body(Scene& scene, const std::string& name, Index muscle, const Points& points) {
  assert(points.cols() > 0);
  const Muscle& host = scene.muscles[static_cast<std::size_t>(muscle)];
  const MeshTopology topology = build_topology(host.surface.faces, host.surface.vertex_count());
  MuscleBody result;
  result.body = static_cast<Index>(scene.bodies.size());
  result.muscle = muscle;
  result.patch =
      patch_under(host.surface, points, patch_edges * mean_edge_length(topology.edges, host.surface.vertices));
  const BodyCarriers carriers = body_carriers(host, topology, 0);
  result.center = host.surface.vertices(Eigen::all, result.patch).rowwise().mean();
  Eigen::VectorXd shares = carriers.weights(Eigen::all, result.patch).cast<Real>().rowwise().mean();
  if (shares.sum() > 0) shares /= shares.sum();
  for (std::size_t b = 0; b < carriers.bodies.size(); ++b) {
    result.bodies.push_back(carriers.bodies[b]);
    result.shares.push_back(shares[static_cast<Index>(b)]);
  }
  scene.bodies.push_back(name);
  scene.muscle_bodies.push_back(std::move(result));
  return scene.muscle_bodies.back().body;
}

HostPlace host_place(const NearestTriangle& host, const Eigen::Matrix3Xi& faces, const Vec3& point) {
  const NearestPoint below = host.query(point);
  const auto corners = faces.col(below.face);
  return {{corners[0], corners[1], corners[2]}, below.barycentric, point - below.point};
}

std::vector<std::vector<std::size_t>> hosts_first(const Scene& scene) {
  std::vector<std::size_t> rank(scene.muscles.size(), 0);
  // A chain of muscles on muscles is no longer than there are muscles.
  for (std::size_t pass = 0; pass < rank.size(); ++pass)
    for (std::size_t m = 0; m < rank.size(); ++m)
      for (const Attachment& attachment : scene.muscles[m].attachments)
        if (const Index host = host_of(scene, attachment.body); host >= 0)
          rank[m] = std::min(std::max(rank[m], rank[static_cast<std::size_t>(host)] + 1), rank.size() - 1);
  std::vector<std::vector<std::size_t>> groups(1);
  for (std::size_t m = 0; m < rank.size(); ++m) {
    groups.resize(std::max(groups.size(), rank[m] + 1));
    groups[rank[m]].push_back(m);
  }
  return groups;
}

std::vector<CarriedBody> carried_bodies(const Scene& scene) {
  std::vector<CarriedBody> bodies;
  for (const MuscleBody& each : scene.muscle_bodies) {
    const Points& vertices = scene.muscles[static_cast<std::size_t>(each.muscle)].surface.vertices;
    bodies.push_back({each.body, each.muscle, each.patch, vertices(Eigen::all, each.patch)});
  }
  return bodies;
}

RigidTransform motion_of(const CarriedBody& body, const Points& vertices) {
  return rigid_motion(body.rest, vertices(Eigen::all, body.patch));
}

void place_carried_bodies(const std::vector<CarriedBody>& bodies, const std::vector<std::size_t>& muscles,
                          const std::function<const Points*(std::size_t muscle)>& shape, Pose& pose) {
  for (const CarriedBody& each : bodies) {
    const auto host = static_cast<std::size_t>(each.muscle);
    if (std::find(muscles.begin(), muscles.end(), host) == muscles.end()) continue;
    if (const Points* now = shape(host)) pose.bodies[static_cast<std::size_t>(each.body)] = motion_of(each, *now);
  }
}

}  // namespace gracilis
