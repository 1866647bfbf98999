#include <gracilis/methods/rbf/muscle_model.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/nearest_points.hpp>
#include <gracilis/geometry/radial_fit.hpp>
#include <gracilis/geometry/radial_solid.hpp>
#include <gracilis/geometry/rbf_centers.hpp>
#include <gracilis/geometry/signed_distance.hpp>
#include <gracilis/geometry/vertex_normals.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis::rbf {

namespace {

/// Points of the fit and of the cost per center, centers that a vertex is bound to.
constexpr Index fit_points_per_center = 12;
constexpr Index cost_points_per_center = 3;
constexpr Index bound_centers = 8;

/// Below every vertex as deep as it goes up to `depth`, and all over the inside where that is deeper than `depth`.
Points inner_points(const TriangleMesh& mesh, const Points& normals, const SignedDistance& distance, Real depth,
                    Index over_inside) {
  const Points around = halton_centers(bounding_box(mesh.vertices), over_inside);
  const Index n = mesh.vertex_count();
  Points points(3, n + around.cols());
  std::vector<char> is_inside(static_cast<std::size_t>(points.cols()), 0);
  parallel_for(static_cast<Index>(points.cols()), 64, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) {
      auto inside = [&](Real least) {
        return is_inside[static_cast<std::size_t>(i)] = distance.query(points.col(i)).distance < -least;
      };
      if (i >= n) {
        points.col(i) = around.col(i - n);
        inside(depth);
        continue;
      }
      for (Real way = depth; way > depth / 20; way /= 2) {
        points.col(i) = mesh.vertices.col(i) - way * normals.col(i);
        if (inside(way / 2)) break;
      }
    }
  });
  Points kept(3, std::count(is_inside.begin(), is_inside.end(), 1));
  for (Index i = 0, next = 0; i < static_cast<Index>(points.cols()); ++i)
    if (is_inside[static_cast<std::size_t>(i)]) kept.col(next++) = points.col(i);
  return kept;
}

std::vector<Index> nearest_vertices(const NearestPoints& vertices, const Points& points) {
  std::vector<Index> nearest;
  for (Index i = 0; i < static_cast<Index>(points.cols()); ++i) nearest.push_back(vertices.nearest(points.col(i)));
  return nearest;
}

/// Points at which the field is fitted, on the surface, beside it and at the centers, and the leveled distance there.
void choose_fit_points(MuscleModel& model, const TriangleMesh& mesh, const Points& normals,
                       const NearestPoints& vertices, const SignedDistance& distance, const Points& centers,
                       Real band) {
  const Points on = spread_out(mesh.vertices, fit_points_per_center * static_cast<Index>(centers.cols()) / 2);
  Points& points = model.fit_points;
  points.resize(3, 2 * on.cols() + centers.cols());
  points.leftCols(on.cols()) = on;
  for (Index i = 0; i < static_cast<Index>(on.cols()); ++i) {
    const Real way = (i % 3 == 0 ? -0.4 : i % 3 == 1 ? 0.4 : 1) * band;
    points.col(on.cols() + i) = on.col(i) + way * normals.col(vertices.nearest(on.col(i)));
  }
  points.rightCols(centers.cols()) = centers;
  model.fit_vertex = nearest_vertices(vertices, points);
  model.fit_values.resize(points.cols());
  parallel_for(static_cast<Index>(points.cols()), 64, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) model.fit_values[i] = leveled(distance.query(points.col(i)).distance, band);
  });
}

/// An offset must not turn thin parts inside out: they take the less of it the less deep the muscle is below them.
Eigen::VectorXd offset_shares(const TriangleMesh& mesh, const Points& normals, const VertexStars& stars,
                              const RadialBasis& field, Real band) {
  constexpr int looks = 8, spreads = 8;
  Eigen::VectorXd shares = Eigen::VectorXd::Zero(mesh.vertex_count());
  parallel_for(mesh.vertex_count(), 64, [&](Index begin, Index end) {
    for (Index v = begin; v < end; ++v) {
      for (int look = 1; look <= looks; ++look)
        shares[v] = std::max(shares[v], -value_at(field, mesh.vertices.col(v) - look * band / looks * normals.col(v)));
      shares[v] = std::min(shares[v] / (band / 2), 1.0);
    }
  });
  for (int spread = 0; spread < spreads; ++spread) {
    const Eigen::VectorXd before = shares;
    for (std::size_t v = 0; v + 1 < stars.offsets.size(); ++v) {
      const Index first = stars.offsets[v], last = stars.offsets[v + 1];
      Real sum = 0;
      for (Index k = first; k < last; ++k) sum += before[stars.neighbors[static_cast<std::size_t>(k)]];
      const auto at = static_cast<Index>(v);
      if (last > first) shares[at] = (before[at] + sum / (last - first)) / 2;
    }
  }
  return shares;
}

void bind(MuscleModel& model, const Points& vertices) {
  const NearestPoints tree(model.rest.centers);
  const Index count = std::min(bound_centers, model.rest.count());
  model.bound.resize(count, vertices.cols());
  model.bound_shares.resize(count, vertices.cols());
  for (Index v = 0; v < static_cast<Index>(vertices.cols()); ++v) {
    const std::vector<Index> near = tree.query(vertices.col(v), static_cast<std::size_t>(count));
    const Real farthest = (vertices.col(v) - model.rest.centers.col(near.back())).norm();
    for (Index k = 0; k < count; ++k) {
      const Real r = (vertices.col(v) - model.rest.centers.col(near[static_cast<std::size_t>(k)])).norm();
      model.bound(k, v) = near[static_cast<std::size_t>(k)];
      // 0 at the farthest, so that nothing leaps where another center becomes the eighth.
      model.bound_shares(k, v) = radial_value({RadialShape::wendland_31}, farthest * (1 + 1e-9) + 1e-12, r);
    }
    model.bound_shares.col(v) /= model.bound_shares.col(v).sum();
  }
}

}  // namespace

Eigen::VectorXd refitted_weights(const MuscleModel& model, const RadialBasis& moved, const Points& points) {
  // Of the mean diagonal entry: enough for Gaussians that have come close to share what they do.
  constexpr Real damping = 1e-4;
  const Index count = moved.count();
  Eigen::MatrixXd matrix(points.cols(), count);
  Eigen::VectorXd left(points.cols());
  parallel_for(static_cast<Index>(points.cols()), 64, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) {
      for (Index k = 0; k < count; ++k)
        matrix(i, k) = radial_value(moved.kernel, moved.reaches[k], (points.col(i) - moved.centers.col(k)).norm());
      left[i] = model.fit_values[i] - moved.polynomial[0] - matrix.row(i).dot(moved.weights);
    }
  });
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(count, count);
  normal.selfadjointView<Eigen::Lower>().rankUpdate(matrix.transpose());
  normal.diagonal().array() += damping * normal.trace() / count;
  return moved.weights + normal.llt().solve(matrix.transpose() * left);
}

MuscleModel muscle_model(const Muscle& muscle, const MeshTopology& topology, const BodyCarriers& carriers,
                         Index centers, Real reach_in_spacings) {
  const TriangleMesh& mesh = muscle.surface;
  const SignedDistance distance(mesh);
  const NearestPoints vertices(mesh.vertices);
  const Points normals = vertex_normals(mesh.vertices, mesh.faces);
  MuscleModel model;
  model.spacing = std::sqrt(surface_area(mesh.vertices, mesh.faces) / centers);
  model.depth = model.spacing / 3;
  Points inside = inner_points(mesh, normals, distance, model.depth, 10 * centers);
  if (inside.cols() == 0) inside = mesh.vertices;  // thinner than any number tells
  const Points chosen = spread_out(inside, centers);
  const Real reach = reach_in_spacings * model.spacing;
  choose_fit_points(model, mesh, normals, vertices, distance, chosen, model.spacing);
  model.rest = fit_least_squares({{RadialShape::gaussian}, RadialPolynomial::constant}, chosen,
                                 Eigen::VectorXd::Constant(chosen.cols(), reach), model.fit_points, model.fit_values)
                   .basis;
  model.rest.weights = refitted_weights(model, model.rest, model.fit_points);  // damped, as in every other pose
  model.center_vertex = nearest_vertices(vertices, chosen);
  for (const Index v : model.center_vertex)
    model.is_free.push_back(carriers.fixed_body[static_cast<std::size_t>(v)] < 0);
  const Points sampled = spread_out(mesh.vertices, cost_points_per_center * centers);
  model.curvature.points.resize(3, sampled.cols() + chosen.cols());
  model.curvature.points << sampled, chosen;
  model.point_vertex = nearest_vertices(vertices, model.curvature.points);
  const auto count = static_cast<Index>(model.curvature.points.cols());
  model.curvature.share = enclosed_volume(mesh.vertices, mesh.faces) / count;
  model.curvature.curvatures.resize(count);
  for (Index q = 0; q < count; ++q)
    model.curvature.curvatures[q] = field_curvature(model.rest, model.curvature.points.col(q));
  model.levels.resize(mesh.vertex_count());
  parallel_for(mesh.vertex_count(), 64, [&](Index begin, Index end) {
    for (Index v = begin; v < end; ++v) model.levels[v] = value_at(model.rest, mesh.vertices.col(v));
  });
  model.offset_shares = offset_shares(mesh, normals, topology.stars, model.rest, model.spacing);
  bind(model, mesh.vertices);
  return model;
}

}  // namespace gracilis::rbf
