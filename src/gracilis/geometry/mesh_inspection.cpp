#include <gracilis/geometry/mesh_inspection.hpp>

#include <gracilis/geometry/disjoint_sets.hpp>
#include <gracilis/geometry/half_edges.hpp>
#include <gracilis/geometry/measures.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace gracilis {

bool is_degenerate(const TriangleMesh& mesh, Index face) {
  const Eigen::Vector3i f = mesh.faces.col(face);
  if (f[0] == f[1] || f[1] == f[2] || f[2] == f[0]) return true;
  const Vec3 a = mesh.vertices.col(f[0]);
  const Vec3 b = mesh.vertices.col(f[1]);
  const Vec3 c = mesh.vertices.col(f[2]);
  const Real longest2 = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  return area_vector(mesh.vertices, f).norm() <= 1e-12 * longest2;
}

std::vector<Index> first_at_same_place(const Points& vertices) {
  const Index count = static_cast<Index>(vertices.cols());
  std::vector<Index> first(static_cast<std::size_t>(count));
  std::iota(first.begin(), first.end(), 0);
  if (count == 0) return first;
  const Real tolerance = 1e-9 * (vertices.rowwise().maxCoeff() - vertices.rowwise().minCoeff()).norm();
  // Sorted along a direction that no grid's planes lie across, few others come between two at one place.
  const Vec3 direction = Vec3(1, std::sqrt(2), std::sqrt(3)).normalized();
  const Eigen::VectorXd along = (vertices.colwise() - vertices.col(0)).transpose() * direction;
  std::vector<Index> order = first;
  std::sort(order.begin(), order.end(),
            [&](Index i, Index j) { return along[i] != along[j] ? along[i] < along[j] : i < j; });
  DisjointSets sets(count);
  for (std::size_t i = 0; i < order.size(); ++i) {
    for (std::size_t j = i + 1; j < order.size(); ++j) {
      if (along[order[j]] - along[order[i]] > 2 * tolerance) break;  // twice: of rounding
      if ((vertices.col(order[j]) - vertices.col(order[i])).norm() <= tolerance) sets.join(order[i], order[j]);
    }
  }
  std::vector<Index> smallest(static_cast<std::size_t>(count), -1);
  for (Index v = 0; v < count; ++v) {
    Index& representative = smallest[static_cast<std::size_t>(sets.find(v))];
    if (representative < 0) representative = v;
    first[static_cast<std::size_t>(v)] = representative;
  }
  return first;
}

std::vector<Index> component_of_vertices(const TriangleMesh& mesh) {
  DisjointSets sets(mesh.vertex_count());
  std::vector<bool> used(static_cast<std::size_t>(mesh.vertex_count()), false);
  for (Index f = 0; f < mesh.face_count(); ++f) {
    for (const Index v : mesh.faces.col(f)) {
      sets.join(v, mesh.faces(0, f));
      used[static_cast<std::size_t>(v)] = true;
    }
  }
  std::vector<Index> number(used.size(), -1);
  std::vector<Index> component(used.size(), -1);
  Index next = 0;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (!used[static_cast<std::size_t>(v)]) continue;
    Index& root_number = number[static_cast<std::size_t>(sets.find(v))];
    if (root_number < 0) root_number = next++;
    component[static_cast<std::size_t>(v)] = root_number;
  }
  return component;
}

Index component_count(const std::vector<Index>& component) {
  return component.empty() ? 0 : 1 + *std::max_element(component.begin(), component.end());
}

static void inspect_indices_and_coordinates(const TriangleMesh& mesh, MeshReport& report) {
  for (Index f = 0; f < mesh.face_count(); ++f) {
    if (mesh.faces.col(f).minCoeff() < 0 || mesh.faces.col(f).maxCoeff() >= mesh.vertex_count()) {
      report.out_of_range_faces.add(f);
    }
  }
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (!mesh.vertices.col(v).allFinite()) report.non_finite_vertices.add(v);
  }
}

static void inspect_vertices(const TriangleMesh& mesh, MeshReport& report) {
  const std::vector<Index> first = first_at_same_place(mesh.vertices);
  const std::vector<Index> component = component_of_vertices(mesh);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (first[static_cast<std::size_t>(v)] != v) report.duplicate_vertices.add(v);
    if (component[static_cast<std::size_t>(v)] < 0) report.unreferenced_vertices.add(v);
  }
  report.components = component_count(component);
}

/// Corners of faces around a vertex hang together through the edges they share; two groups at one vertex are a pinch.
static void inspect_vertex_faces(const TriangleMesh& mesh, const std::vector<HalfEdge>& half_edges,
                                 MeshReport& report) {
  DisjointSets corners(3 * mesh.face_count());
  const auto corner_at = [&](Index face, Index vertex) {
    Index k = 0;
    while (mesh.faces(k, face) != vertex) ++k;
    return 3 * face + k;
  };
  for_each_edge(half_edges, [&](std::span<const HalfEdge> sides) {
    for (const HalfEdge& side : sides.subspan(1)) {
      corners.join(corner_at(sides[0].face, side.low), corner_at(side.face, side.low));
      corners.join(corner_at(sides[0].face, side.high), corner_at(side.face, side.high));
    }
  });
  std::vector<Index> fan_of(static_cast<std::size_t>(mesh.vertex_count()), -1);
  std::vector<bool> pinched(fan_of.size(), false);
  for (Index corner = 0; corner < 3 * mesh.face_count(); ++corner) {
    const auto vertex = static_cast<std::size_t>(mesh.faces(corner % 3, corner / 3));
    const Index fan = corners.find(corner);
    if (fan_of[vertex] < 0) fan_of[vertex] = fan;
    if (fan_of[vertex] != fan) pinched[vertex] = true;
  }
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (pinched[static_cast<std::size_t>(v)]) report.pinched_vertices.add(v);
  }
}

static void inspect_edges(const std::vector<HalfEdge>& half_edges, MeshReport& report, Index& edge_count) {
  for_each_edge(half_edges, [&](std::span<const HalfEdge> sides) {
    ++edge_count;
    if (sides.size() == 1) report.open_edges.add(sides[0].face);
    if (sides.size() > 2) report.non_manifold_edges.add(sides[0].face);
    if (sides.size() == 2 && sides[0].forward == sides[1].forward) report.inconsistent_edges.add(sides[0].face);
  });
}

MeshReport inspect_mesh(const TriangleMesh& mesh) {
  MeshReport report;
  report.vertex_count = mesh.vertex_count();
  report.face_count = mesh.face_count();
  inspect_indices_and_coordinates(mesh, report);
  if (!report.is_finite() || report.vertex_count == 0) return report;

  report.low = mesh.vertices.rowwise().minCoeff();
  report.high = mesh.vertices.rowwise().maxCoeff();
  inspect_vertices(mesh, report);
  for (Index f = 0; f < mesh.face_count(); ++f) {
    if (is_degenerate(mesh, f)) report.degenerate_faces.add(f);
  }
  const std::vector<HalfEdge> half_edges = sorted_half_edges(mesh.faces);
  Index edge_count = 0;
  inspect_edges(half_edges, report, edge_count);
  inspect_vertex_faces(mesh, half_edges, report);
  report.area = surface_area(mesh.vertices, mesh.faces);
  report.volume = enclosed_volume(mesh.vertices, mesh.faces);
  if (report.is_closed() && report.is_manifold()) {
    // Euler: V - E + F = 2 (components - genus)
    const Index used_vertices = report.vertex_count - report.unreferenced_vertices.count;
    report.genus = report.components - (used_vertices - edge_count + report.face_count) / 2;
  }
  return report;
}

}  // namespace gracilis
