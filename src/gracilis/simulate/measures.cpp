#include <gracilis/simulate/measures.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/dynamics/constraints/dihedral.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/methods/registry.hpp>
#include <gracilis/scene/attached_vertices.hpp>
#include <gracilis/simulate/attachment_zone.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis {

namespace {

Points midpoints(const std::vector<std::pair<Index, Index>>& ends, const Points& x) {
  Points middles(3, static_cast<Index>(ends.size()));
  for (std::size_t e = 0; e < ends.size(); ++e)
    middles.col(static_cast<Index>(e)) = (x.col(ends[e].first) + x.col(ends[e].second)) / 2;
  return middles;
}

/// A box that holds all that a transform makes of another.
Eigen::AlignedBox3d box_of_corners(const RigidTransform& transform, const Eigen::AlignedBox3d& box) {
  Eigen::AlignedBox3d moved;
  for (int corner = 0; corner < 8; ++corner)
    moved.extend(transform * box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner)));
  return moved;
}

std::vector<SignedDistance> distances_to_bones(const Scene& scene) {
  std::vector<SignedDistance> distances;
  for (const Bone& bone : scene.bones) distances.emplace_back(bone.surface);
  return distances;
}

}  // namespace

Measurer::Measurer(const Scene& scene, const FiberTracker* tracker, MeasureLevel level) : scene_(scene), level_(level) {
  if (level == MeasureLevel::full) {
    bones_ = distances_to_bones(scene);
    if (scene.muscles.size() > 1 && keeps_surfaces_apart(scene)) muscle_depths_.emplace(scene);
    ways_.emplace(scene, bones_, tracker);
    bellies_.emplace(scene, bones_, ways_->taut());
  }
  for (const Bone& bone : scene.bones) bone_boxes_.push_back(bounding_box(bone.surface.vertices));
  muscles_.resize(scene.muscles.size());
  last_.assign(muscles_.size(), std::vector<LastSeen>(2 * bones_.size()));
  parallel_for_each(muscles_.size(), [&](std::size_t m) { muscles_[m] = rest_of(scene.muscles[m], last_[m]); });
}

Measurer::MuscleRest Measurer::rest_of(const Muscle& muscle, std::vector<LastSeen>& last) const {
  const Points& x = muscle.surface.vertices;
  MuscleRest rest;
  const MeshTopology topology = build_topology(muscle.surface.faces, muscle.surface.vertex_count());
  rest.edges = topology.edges;
  rest.flaws = SurfaceFlaws(muscle.surface, topology);
  rest.volume = enclosed_volume(x, muscle.surface.faces);
  const std::vector<char> fixed = attached_vertices(muscle);
  const auto is_fixed = [&](Index v) { return fixed[static_cast<std::size_t>(v)] != 0; };
  std::vector<Index> attached;
  for (Index v = 0; v < x.cols(); ++v) (is_fixed(v) ? attached : rest.free_vertices).push_back(v);
  const std::vector<char> near = near_attachments(x, attached);
  for (const MeshEdge& edge : rest.edges) {
    rest.lengths.push_back((x.col(edge.a) - x.col(edge.b)).norm());
    const bool dihedral = edge.left >= 0 && edge.right >= 0;
    rest.angles.push_back(
        dihedral ? dihedral_angle(x.col(edge.a), x.col(edge.b), x.col(edge.left_apex), x.col(edge.right_apex)) : 0);
    rest.far_edge.push_back(near[static_cast<std::size_t>(edge.a)] == 0 && near[static_cast<std::size_t>(edge.b)] == 0);
    if (!is_fixed(edge.a) || !is_fixed(edge.b)) rest.free_edges.emplace_back(edge.a, edge.b);
  }
  const Points vertices = x(Eigen::all, rest.free_vertices), middles = midpoints(rest.free_edges, x);
  rest.vertex_depth.resize(vertices.cols(), static_cast<Index>(bones_.size()));
  rest.midpoint_depth.resize(middles.cols(), static_cast<Index>(bones_.size()));
  for (std::size_t b = 0; b < bones_.size(); ++b) {
    rest.vertex_depth.col(static_cast<Index>(b)) = depths_in(b, vertices, last[2 * b]);
    rest.midpoint_depth.col(static_cast<Index>(b)) = depths_in(b, middles, last[2 * b + 1]);
  }
  return rest;
}

/// Depth of each point (bone's frame) in a bone, m, 0 outside. The distance to a surface changes by no more than the
/// point moves, so a point is asked for again only once it has used up its last clearance; the bone's box is asked
/// first.
Eigen::VectorXd Measurer::depths_in(std::size_t bone, const Points& points, LastSeen& last) const {
  if (last.points.cols() != points.cols()) {
    last.points = points;
    last.clearances = Eigen::VectorXd::Zero(points.cols());
  }
  Eigen::VectorXd depths = Eigen::VectorXd::Zero(points.cols());
  for (Index i = 0; i < points.cols(); ++i) {
    if ((points.col(i) - last.points.col(i)).norm() < last.clearances[i]) continue;
    const Real outside = bone_boxes_[bone].exteriorDistance(points.col(i));
    const Real distance = outside > 0 ? outside : bones_[bone].query(points.col(i)).distance;
    last.points.col(i) = points.col(i);
    last.clearances[i] = std::max(distance, Real{0});
    depths[i] = std::max(-distance, Real{0});
  }
  return depths;
}

void Measurer::measure_depths(const MuscleRest& rest, const Points& points, const Pose& pose,
                              std::vector<LastSeen>& last, MuscleMeasures& measures) const {
  const Eigen::AlignedBox3d box = bounding_box(points);
  for (std::size_t b = 0; b < bones_.size(); ++b) {
    const auto column = static_cast<Index>(b);
    const RigidTransform to_capture = pose.bodies[static_cast<std::size_t>(scene_.bones[b].body)].inverse();
    if (!box_of_corners(to_capture, box).intersects(bone_boxes_[b])) continue;  // nothing of it can be inside
    const auto beyond_rest = [&](const Eigen::VectorXd& depths, const Eigen::MatrixXd& at_rest) {
      return depths.size() == 0 ? 0 : std::max((depths - at_rest.col(column)).maxCoeff(), Real{0});
    };
    const Points local = (to_capture.linear() * points).colwise() + to_capture.translation();
    const Eigen::VectorXd of_vertices = depths_in(b, local(Eigen::all, rest.free_vertices), last[2 * b]);
    const Eigen::VectorXd of_midpoints = depths_in(b, midpoints(rest.free_edges, local), last[2 * b + 1]);
    if (of_vertices.size() > 0) measures.vertex_depth = std::max(measures.vertex_depth, of_vertices.maxCoeff());
    measures.vertex_depth_beyond_rest =
        std::max(measures.vertex_depth_beyond_rest, beyond_rest(of_vertices, rest.vertex_depth));
    measures.midpoint_depth_beyond_rest =
        std::max(measures.midpoint_depth_beyond_rest, beyond_rest(of_midpoints, rest.midpoint_depth));
  }
}

MuscleMeasures Measurer::measure_shape(std::size_t muscle, const Points& x, const Pose& pose) {
  const MuscleRest& rest = muscles_[muscle];
  MuscleMeasures measures;
  measures.level = level_;
  measures.finite = x.allFinite();
  if (!measures.finite || level_ == MeasureLevel::none) return measures;
  measures.volume_ratio = enclosed_volume(x, scene_.muscles[muscle].surface.faces) / rest.volume;
  Real ratio_sum = 0, change_sum = 0;
  for (std::size_t e = 0; e < rest.edges.size(); ++e) {
    const MeshEdge& edge = rest.edges[e];
    const Real length = (x.col(edge.a) - x.col(edge.b)).norm();
    const Real ratio = rest.lengths[e] > 0 ? length / rest.lengths[e] : 1;
    ratio_sum += ratio;
    measures.edge_ratio_max = std::max(measures.edge_ratio_max, ratio);
    if (rest.far_edge[e])
      measures.edge_ratio_max_free = std::max(measures.edge_ratio_max_free, ratio);
    else
      measures.edge_ratio_max_near =
          std::max(measures.edge_ratio_max_near, rest.flaws.edge_ratio(length, rest.lengths[e]));
    const Real angle = dihedral_angle(x.col(edge.a), x.col(edge.b), x.col(edge.left_apex), x.col(edge.right_apex));
    const Real change = std::abs(std::remainder(angle - rest.angles[e], 2 * pi));
    change_sum += change;
    measures.dihedral_change_max = std::max(measures.dihedral_change_max, change);
    measures.dihedrals_over_90 += change > pi / 2;
  }
  measures.edge_ratio_mean = ratio_sum / static_cast<Real>(rest.edges.size());
  measures.dihedral_change_mean = change_sum / static_cast<Real>(rest.edges.size());
  const SurfaceFlaws::Worst worst = rest.flaws.worst(x);
  measures.spike = worst.spike, measures.thickening = worst.thickening, measures.thinning = worst.thinning;
  measure_depths(rest, x, pose, last_[muscle], measures);
  return measures;
}

static bool all_are_finite(const std::vector<MuscleMeasures>& measures) {
  return std::all_of(measures.begin(), measures.end(), [](const MuscleMeasures& each) { return each.finite; });
}

/// How deep muscles lie in each other. Points that are not finite lie nowhere.
void Measurer::measure_muscle_depths(const Frame& frame, std::vector<MuscleMeasures>& measures) const {
  if (!muscle_depths_ || !all_are_finite(measures)) return;
  const std::vector<DepthBeyondRest> depths = muscle_depths_->beyond_rest(frame);
  for (std::size_t m = 0; m < measures.size(); ++m) {
    if (depths[m].other < 0) continue;
    measures[m].muscle_depth_beyond_rest = depths[m].depth;
    measures[m].deepest_in = scene_.muscles[static_cast<std::size_t>(depths[m].other)].name;
  }
}

/// Where the muscles run and lie. A frame that is not finite has no places.
void Measurer::measure_places(const Frame& frame, const std::vector<MuscleFibers>& fibers,
                              std::vector<MuscleMeasures>& measures) {
  if (level_ != MeasureLevel::full) return;
  ways_->follow(frame.pose);
  if (!all_are_finite(measures)) return;
  const std::vector<MuscleWay> ways = ways_->measure(frame, fibers);
  std::vector<Real> length_ratios;
  for (const MuscleWay& way : ways) length_ratios.push_back(way.length_ratio);
  const std::vector<Real> off_place = bellies_->off_place(frame, length_ratios);
  for (std::size_t m = 0; m < measures.size(); ++m) {
    measures[m].belly_off_place = off_place[m];
    measures[m].wrong_side = ways[m].wrong_side;
    measures[m].slack = ways[m].slack;
  }
}

std::vector<MuscleMeasures> Measurer::measure(const Frame& frame, const std::vector<MuscleFibers>& fibers) {
  std::vector<MuscleMeasures> all(muscles_.size());
  parallel_for_each(all.size(), [&](std::size_t m) { all[m] = measure_shape(m, frame.muscles[m].points, frame.pose); });
  measure_muscle_depths(frame, all);
  measure_places(frame, fibers, all);
  return all;
}

}  // namespace gracilis
