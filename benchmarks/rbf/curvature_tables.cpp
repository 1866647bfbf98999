#include "solids.hpp"
#include "spread_axes.hpp"
#include "tables.hpp"

#include <gracilis/anatomy/attachments/body_carriers.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/topology.hpp>
#include <gracilis/io/mesh/mesh_reader.hpp>
#include <gracilis/methods/rbf/curvature_cost.hpp>
#include <gracilis/methods/rbf/muscle_model.hpp>

#include <fmt/format.h>

#include <cmath>

namespace gracilis {

namespace {

/// The field that the method `rbf` makes of a muscle that is attached to nothing.
rbf::MuscleModel model_of(const TriangleMesh& surface, Index centers) {
  Muscle muscle;
  muscle.name = "gluteus_maximus_r";
  muscle.surface = surface;
  const MeshTopology topology = build_topology(surface.faces, surface.vertex_count());
  return rbf::muscle_model(muscle, topology, body_carriers(muscle, topology, 0), centers, 1.2);
}

/// Field and curvatures in the plane through the muscle's middle along its most and its least spread.
void write_slice(const TableRequest& request, const rbf::MuscleModel& model, const TriangleMesh& surface) {
  std::ofstream table = request.table("curvature", "along_mm,across_mm,field_mm,field_curvature,surface_curvature");
  const Eigen::Matrix3d axes = spread_axes(surface.vertices);
  const Vec3 middle = surface.vertices.rowwise().mean();
  const Points seen = axes.transpose() * (surface.vertices.colwise() - middle);
  const Real margin = 0.01, step = request.thin ? 0.01 : 0.002;
  for (Real across = seen.row(2).minCoeff() - margin; across <= seen.row(2).maxCoeff() + margin; across += step)
    for (Real along = seen.row(0).minCoeff() - margin; along <= seen.row(0).maxCoeff() + margin; along += step) {
      const RadialSample here = sample(model.rest, middle + along * axes.col(0) + across * axes.col(2));
      table << fmt::format("{:.2f},{:.2f},{:.4f},{:.4g},{:.4g}\n", 1000 * along, 1000 * across, 1000 * here.value,
                           here.hessian.trace() / 3, surface_mean_curvature(here));
    }
}

/// Where the surface's edges cross that plane.
void write_crossings(const TableRequest& request, const TriangleMesh& surface) {
  std::ofstream table = request.table("crossings", "along_mm,across_mm");
  const Points seen =
      spread_axes(surface.vertices).transpose() * (surface.vertices.colwise() - surface.vertices.rowwise().mean());
  for (const MeshEdge& edge : build_topology(surface.faces, surface.vertex_count()).edges) {
    const Real a = seen(1, edge.a), b = seen(1, edge.b);
    if ((a < 0) == (b < 0)) continue;
    const Vec3 at = seen.col(edge.a) + a / (a - b) * (seen.col(edge.b) - seen.col(edge.a));
    table << fmt::format("{:.2f},{:.2f}\n", 1000 * at.x(), 1000 * at.z());
  }
}

/// A field whose centers were drawn apart along the muscle by a tenth.
RadialBasis stretched(const RadialBasis& rest, const TriangleMesh& surface) {
  const Vec3 along = spread_axes(surface.vertices).col(0), middle = surface.vertices.rowwise().mean();
  RadialBasis moved = rest;
  for (Index k = 0; k < moved.count(); ++k)
    moved.centers.col(k) += 0.1 * along.dot(rest.centers.col(k) - middle) * along;
  return moved;
}

/// Eqs. 6.8 to 6.12 beside what differences of the cost (eq. 6.6) say, for every center and direction.
void write_gradient(const TableRequest& request, const rbf::MuscleModel& model, const RadialBasis& moved) {
  const Points closed = rbf::curvature_cost_gradient(moved, model.curvature);
  std::ofstream table = request.table("gradient", "center,axis,closed_form,by_differences,without_weight");
  const Index count = std::min<Index>(moved.count(), request.thin ? 6 : 40);
  const Real h = 1e-5 * model.spacing;
  for (Index k = 0; k < count; ++k)
    for (int axis = 0; axis < 3; ++axis) {
      RadialBasis ahead = moved, behind = moved;
      ahead.centers(axis, k) += h;
      behind.centers(axis, k) -= h;
      const Real slope =
          (rbf::curvature_cost(ahead, model.curvature) - rbf::curvature_cost(behind, model.curvature)) / (2 * h);
      table << fmt::format("{},{},{:.9g},{:.9g},{:.9g}\n", k, axis, closed(axis, k), slope,
                           closed(axis, k) / moved.weights[k]);
    }
}

void write_descent(const TableRequest& request, const rbf::MuscleModel& model, const RadialBasis& moved) {
  std::ofstream table = request.table("descent", "steps,cost_share");
  const std::vector<char> all_free(static_cast<std::size_t>(moved.count()), 1);
  const Real before = rbf::curvature_cost(moved, model.curvature);
  table << "0,1\n";
  for (const int steps : request.thin ? std::vector<int>{2, 5} : std::vector<int>{1, 2, 3, 5, 8, 12, 20, 35, 60, 100}) {
    RadialBasis descended = moved;
    const rbf::Descent done = rbf::descend(descended, model.curvature, all_free, steps, model.spacing / 10);
    table << fmt::format("{},{:.6g}\n", steps, done.after / before);
  }
}

}  // namespace

void write_curvature(const TableRequest& request) {
  const TriangleMesh surface = request.thin || request.data.empty()
                                   ? builtin_gluteus()
                                   : read_mesh(request.data / "lhdl-hip/clean/gluteus_maximus_r.ply", 0.001);
  const rbf::MuscleModel model = model_of(surface, request.thin ? 60 : 300);
  const RadialBasis moved = stretched(model.rest, surface);
  write_slice(request, model, surface);
  write_crossings(request, surface);
  write_gradient(request, model, moved);
  write_descent(request, model, moved);
}

}  // namespace gracilis
