#include <gracilis/anatomy/attachments/attachments.hpp>

#include <gracilis/core/sort_unique.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/outline_curves.hpp>
#include <gracilis/geometry/point_segment.hpp>
#include <gracilis/geometry/principal_axes.hpp>
#include <gracilis/geometry/surface_region.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis {

Real distance_to(const LandmarkSet& landmarks, const Vec3& p) {
  const Points& points = landmarks.points;
  Real nearest = std::numeric_limits<Real>::infinity();
  for (Index i = 0; i < points.cols(); ++i) nearest = std::min(nearest, (points.col(i) - p).norm());
  if (landmarks.kind == LineKind::cloud) return nearest;
  const Index segments = points.cols() - (landmarks.kind == LineKind::open ? 1 : 0);
  for (Index i = 0; i < segments; ++i) {
    nearest = std::min(nearest, distance_to_segment<Vec3>(p, points.col(i), points.col((i + 1) % points.cols())));
  }
  return nearest;
}

bool inside_outline(const Points& outline, const Vec3& p, Real reach) {
  if (outline.cols() < 3) return false;
  const Vec3 center = outline.rowwise().mean();
  const Eigen::Matrix3d directions = spread_of(outline).directions;
  const Points flat = directions.transpose() * (outline.colwise() - center);
  const Vec3 q = directions.transpose() * (p - center);
  if (std::abs(q[0]) > flat.row(0).cwiseAbs().maxCoeff() + reach) return false;

  // A ray from q along the second direction crosses the outline an odd number of times when q lies inside.
  bool inside = false;
  for (Index i = 0, j = static_cast<Index>(flat.cols()) - 1; i < flat.cols(); j = i++) {
    if ((flat(2, i) > q[2]) == (flat(2, j) > q[2])) continue;
    const Real share = (q[2] - flat(2, i)) / (flat(2, j) - flat(2, i));
    if (q[1] < flat(1, i) + share * (flat(1, j) - flat(1, i))) inside = !inside;
  }
  return inside;
}

namespace {

struct NearestOnBones {
  std::size_t bone = 0;
  NearestPoint nearest;
};

}  // namespace

static NearestOnBones nearest_on(std::span<const NearestTriangle* const> bones, const Vec3& p, Real reach) {
  NearestOnBones best;
  for (std::size_t b = 0; b < bones.size(); ++b) {
    const NearestPoint found = bones[b]->query(p, std::min(reach, best.nearest.distance));
    if (found.face >= 0 && found.distance < best.nearest.distance) best = {b, found};
  }
  return best;
}

LandmarkSet outline_on_bones(const Points& points, std::span<const TriangleMesh* const> bones) {
  LandmarkSet set{ordered_outline(OutlineCurve::shortest_tour, points), LineKind::outline};
  std::vector<NearestTriangle> trees;
  for (const TriangleMesh* bone : bones) trees.emplace_back(*bone);
  std::vector<const NearestTriangle*> asked;
  for (const NearestTriangle& tree : trees) asked.push_back(&tree);
  std::vector<Index> votes(bones.size(), 0);
  for (const auto point : points.colwise())
    ++votes[nearest_on(asked, point, std::numeric_limits<Real>::infinity()).bone];
  const auto most = static_cast<std::size_t>(std::max_element(votes.begin(), votes.end()) - votes.begin());
  for (std::size_t b = 0; b < bones.size(); ++b)
    set.inside.push_back(b == most ? faces_inside(*bones[b], set.points)
                                   : std::vector<char>(static_cast<std::size_t>(bones[b]->face_count()), 0));
  return set;
}

static bool near(const std::vector<LandmarkSet>& landmarks, const Vec3& p, Real distance) {
  return std::any_of(landmarks.begin(), landmarks.end(),
                     [&](const LandmarkSet& set) { return distance_to(set, p) <= distance; });
}

namespace {

/// Says of one vertex whether a rule takes it.
struct Taken {
  const Vec3 p;
  std::span<const NearestTriangle* const> bones;

  bool operator()(const NearLandmarks& rule) const {
    const auto [bone, nearest] = nearest_on(bones, p, rule.bone_distance);
    if (nearest.face < 0 || nearest.distance > rule.bone_distance) return false;
    if (near(rule.landmarks, p, rule.landmark_distance)) return true;
    return std::any_of(
        rule.landmarks.begin(), rule.landmarks.end(), [&, bone = bone, &nearest = nearest](const LandmarkSet& set) {
          if (set.kind == LineKind::outline)
            return bone < set.inside.size() && set.inside[bone][static_cast<std::size_t>(nearest.face)] != 0;
          return set.kind == LineKind::closed && inside_outline(set.points, nearest.point, rule.landmark_distance);
        });
  }
  bool operator()(const NearPoints& rule) const { return near(rule.landmarks, p, rule.distance); }
  bool operator()(const NearBone& rule) const {
    return nearest_on(bones, p, rule.distance).nearest.distance <= rule.distance;
  }
  bool operator()(const ListedVertices&) const { return false; }  // not asked vertex by vertex
};

}  // namespace

std::vector<Index> select_vertices(const TriangleMesh& muscle, std::span<const NearestTriangle* const> bones,
                                   const AttachmentRule& rule) {
  std::vector<Index> vertices;
  if (const ListedVertices* listed = std::get_if<ListedVertices>(&rule)) {
    vertices = listed->vertices;
    sort_unique(vertices);
    return vertices;
  }
  for (Index i = 0; i < muscle.vertex_count(); ++i) {
    if (std::visit(Taken{muscle.vertices.col(i), bones}, rule)) vertices.push_back(i);
  }
  return vertices;
}

AttachmentArea attachment_area(const TriangleMesh& muscle, std::span<const Index> vertices) {
  AttachmentArea result;
  if (vertices.empty()) return result;
  const Eigen::VectorXd areas = vertex_areas(muscle.vertices, muscle.faces);
  Points points(3, vertices.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    points.col(i) = muscle.vertices.col(vertices[i]);
    result.area += areas[vertices[i]];
  }
  const Eigen::RowVectorXd along = spread_of(points).most().transpose() * points;
  result.length = along.maxCoeff() - along.minCoeff();
  result.width = result.length > 0 ? result.area / result.length : 0;
  return result;
}

}  // namespace gracilis
