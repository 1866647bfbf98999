#include <gracilis/anatomy/fibers/surface_fibers.hpp>

#include <gracilis/anatomy/fibers/muscle_fibers.hpp>
#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/nearest_points.hpp>
#include <gracilis/geometry/polylines.hpp>
#include <gracilis/geometry/shortest_paths.hpp>
#include <gracilis/scene/attached_vertices.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace gracilis {

namespace {

/// Which way fibers run, anywhere.
class DirectionField {
 public:
  explicit DirectionField(const Polylines& fibers)
      : directions_(3, fibers.points.cols() - fibers.count()), middles_(middles(fibers)), nearest_(middles_) {}

  /// Unit; zero where fibers have no length.
  Vec3 at(const Vec3& p) const {
    Vec3 sum = Vec3::Zero();
    for (const Index piece : nearest_.query(p, 4)) sum += directions_.col(piece);
    return sum.normalized();
  }

  /// The same by the nearest 32 pieces, weighted by one over the square of their distance (Shepard 1968): smooth where
  /// fibers are few.
  Vec3 between(const Vec3& p) const {
    Vec3 sum = Vec3::Zero();
    for (const Index piece : nearest_.query(p, 32))
      sum += directions_.col(piece) / std::max((middles_.col(piece) - p).squaredNorm(), Real{1e-12});
    return sum.normalized();
  }

 private:
  Points middles(const Polylines& fibers) {
    Points middles(3, directions_.cols());
    Index piece = 0;
    for (Index f = 0; f < fibers.count(); ++f)
      for (Index i = fibers.begin(f) + 1; i < fibers.end(f); ++i, ++piece) {
        middles.col(piece) = (fibers.points.col(i) + fibers.points.col(i - 1)) / 2;
        directions_.col(piece) = (fibers.points.col(i) - fibers.points.col(i - 1)).normalized();
      }
    return middles;
  }

  Points directions_, middles_;
  NearestPoints nearest_;
};

/// The published way.
std::vector<Index> joined_nearest(const Points& line, const NearestPoints& vertices, const EdgeGraph& lengths) {
  std::vector<Index> path;
  for (Eigen::Index i = 0; i < line.cols(); ++i) {
    const Index vertex = vertices.nearest(line.col(i));
    if (path.empty()) {
      path.push_back(vertex);
    } else if (vertex != path.back()) {
      const std::vector<Index> way = shortest_path(lengths, path.back(), vertex);
      if (!way.empty()) path.insert(path.end(), way.begin() + 1, way.end());
    }
  }
  return path;
}

/// Lengths in a metric in which across the fibers counts several times as much as along them.
EdgeGraph anisotropic_graph(const Points& x, const MeshTopology& topology, const DirectionField& directions) {
  constexpr Real across_factor = 4;
  EdgeGraph graph{topology.stars, {}};
  graph.costs.resize(graph.stars.neighbors.size());
  parallel_for(static_cast<Index>(x.cols()), 64, [&](Index begin, Index end) {
    for (Index v = begin; v < end; ++v)
      for (Index i = graph.stars.offsets[static_cast<std::size_t>(v)];
           i < graph.stars.offsets[static_cast<std::size_t>(v) + 1]; ++i) {
        const Vec3 edge = x.col(graph.stars.neighbors[static_cast<std::size_t>(i)]) - x.col(v);
        const Real along = edge.dot(directions.at(x.col(v) + edge / 2));
        const Real across2 = std::max(edge.squaredNorm() - along * along, Real{0});
        graph.costs[static_cast<std::size_t>(i)] = std::sqrt(along * along + across_factor * across_factor * across2);
      }
  });
  return graph;
}

/// One way for the whole fiber: it cannot jump from side to side where the muscle is thin, and stays near.
std::vector<Index> along_fiber(const Points& x, const Points& line, const NearestPoints& vertices, EdgeGraph graph) {
  const Index first = vertices.nearest(line.col(0));
  const Index last = vertices.nearest(line.col(line.cols() - 1));
  // Distances count against the fiber's own from the surface: those in the middle of the belly are far from it all.
  Eigen::VectorXd distances(x.cols());
  for (Index v = 0; v < x.cols(); ++v) distances[v] = distance_to_polyline(line, x.col(v));
  Real depth = 0;
  for (Eigen::Index i = 0; i < line.cols(); ++i)
    depth = std::max(depth, (Vec3(x.col(vertices.nearest(line.col(i)))) - line.col(i)).norm());
  const Real scale = std::max(depth, polyline_length(line) / 50);
  for (std::size_t v = 0; v < static_cast<std::size_t>(x.cols()); ++v)
    for (Index i = graph.stars.offsets[v]; i < graph.stars.offsets[v + 1]; ++i) {
      const Real far =
          (distances[static_cast<Index>(v)] + distances[graph.stars.neighbors[static_cast<std::size_t>(i)]]) / 2 /
          scale;
      graph.costs[static_cast<std::size_t>(i)] *= 1 + far * far;
    }
  return shortest_path(graph, first, last);
}

/// Edges of all paths, each once, with those off the direction left out.
void collect_segments(const Points& x, const DirectionField* directions, SurfaceFibers& result) {
  std::map<std::pair<Index, Index>, Index> counts;
  for (const std::vector<Index>& path : result.paths)
    for (std::size_t i = 1; i < path.size(); ++i) ++counts[std::minmax(path[i - 1], path[i])];
  for (const auto& [edge, count] : counts) {
    const Vec3 along = x.col(edge.second) - x.col(edge.first);
    const Real length = along.norm();
    if (directions) {
      const Real cosine = std::abs(along.dot(directions->at((x.col(edge.first) + x.col(edge.second)) / 2)));
      if (!(cosine >= std::cos(largest_segment_angle) * length)) {
        ++result.rejected;
        continue;
      }
    }
    result.segments.push_back({edge.first, edge.second, length, count});
  }
}

Real coverage(const Muscle& muscle, const MeshTopology& topology, const std::vector<FiberSegment>& segments) {
  const auto count = static_cast<std::size_t>(muscle.surface.vertex_count());
  const std::vector<char> held = attached_vertices(muscle);
  std::vector<char> covered(count, 0);
  for (const FiberSegment& segment : segments)
    for (const Index v : {segment.a, segment.b}) {
      covered[static_cast<std::size_t>(v)] = 1;
      for (Index i = topology.stars.offsets[static_cast<std::size_t>(v)];
           i < topology.stars.offsets[static_cast<std::size_t>(v) + 1]; ++i)
        covered[static_cast<std::size_t>(topology.stars.neighbors[static_cast<std::size_t>(i)])] = 1;
    }
  const Eigen::VectorXd areas = vertex_areas(muscle.surface.vertices, muscle.surface.faces);
  Real free = 0, reached = 0;
  for (std::size_t v = 0; v < count; ++v) {
    if (held[v]) continue;
    free += areas[static_cast<Index>(v)];
    if (covered[v]) reached += areas[static_cast<Index>(v)];
  }
  return free > 0 ? reached / free : 0;
}

}  // namespace

SurfaceFibers surface_fibers(const Muscle& muscle, const Polylines& fibers, SurfacePaths paths, bool reject) {
  SurfaceFibers result;
  if (fibers.count() == 0) return result;
  const Points& x = muscle.surface.vertices;
  const MeshTopology topology = build_topology(muscle.surface.faces, muscle.surface.vertex_count());
  const NearestPoints vertices(x);
  const DirectionField directions(fibers);
  const EdgeGraph graph =
      paths == SurfacePaths::along_fibers ? anisotropic_graph(x, topology, directions) : length_graph(x, topology);
  result.paths.resize(static_cast<std::size_t>(fibers.count()));
  parallel_for(fibers.count(), 1, [&](Index begin, Index end) {
    for (Index f = begin; f < end; ++f)
      result.paths[static_cast<std::size_t>(f)] = paths == SurfacePaths::along_fibers
                                                      ? along_fiber(x, fibers.line(f), vertices, graph)
                                                      : joined_nearest(fibers.line(f), vertices, graph);
  });
  collect_segments(x, reject ? &directions : nullptr, result);
  result.coverage = coverage(muscle, topology, result.segments);
  return result;
}

SurfaceFibers surface_fibers_from_lines(const Muscle& muscle, const Polylines& lines) {
  SurfaceFibers result;
  const Points& x = muscle.surface.vertices;
  const MeshTopology topology = build_topology(muscle.surface.faces, muscle.surface.vertex_count());
  const NearestPoints vertices(x);
  const EdgeGraph lengths = length_graph(x, topology);
  for (Index f = 0; f < lines.count(); ++f) result.paths.push_back(joined_nearest(lines.line(f), vertices, lengths));
  collect_segments(x, nullptr, result);
  result.coverage = coverage(muscle, topology, result.segments);
  return result;
}

SurfaceFibers contracting_fibers(const Muscle& muscle) {
  if (muscle.given_surface_fibers.count() > 0) return surface_fibers_from_lines(muscle, muscle.given_surface_fibers);
  Muscle finer = muscle;
  finer.fibers.segments = muscle.contraction.segments;
  return surface_fibers(muscle, fibers_of(finer), muscle.contraction.paths, muscle.contraction.reject_across);
}

Polylines segment_lines(const SurfaceFibers& fibers, const Points& vertices) {
  std::vector<Points> lines;
  for (const FiberSegment& segment : fibers.segments) {
    lines.emplace_back(3, 2);
    lines.back() << vertices.col(segment.a), vertices.col(segment.b);
  }
  return join(lines);
}

Points directions_of_fibers(const Polylines& fibers, const Points& places) {
  const DirectionField field(fibers);
  Points directions(3, places.cols());
  parallel_for(static_cast<Index>(places.cols()), 256, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) directions.col(i) = field.between(places.col(i));
  });
  return directions;
}

}  // namespace gracilis
