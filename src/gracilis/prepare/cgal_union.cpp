#include <gracilis/geometry/mesh_pieces.hpp>
#include <gracilis/prepare/cgal.hpp>
#include <gracilis/prepare/cgal_mesh.hpp>
#include <gracilis/prepare/solids.hpp>

#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Side_of_triangle_mesh.h>

#include <Eigen/Geometry>

#include <cmath>
#include <exception>
#include <vector>

namespace gracilis {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;

using Cuts = CgalMesh::Property_map<CgalMesh::Edge_index, bool>;
using Solid = CGAL::Side_of_triangle_mesh<CgalMesh, CgalKernel>;

struct WatchedCutting : pmp::Corefinement::Default_visitor<CgalMesh> {
  explicit WatchedCutting(const TimeLimit& until) : limit(&until) {}
  void triangulating_faces_step() const { limit->check(); }
  void edge_face_intersections_step() const { limit->check(); }
  void intersection_of_coplanar_faces_step() const { limit->check(); }
  const TimeLimit* limit;
};

bool encloses_something(const TriangleMesh& mesh) {
  const MeshReport report = inspect_mesh(mesh);
  return bounds_a_solid(report) && report.volume > 0;
}

/// What a part of a surface is judged by: the middle of its largest face, and a small step outwards from there.
struct Sample {
  Vec3 middle, step;
  Real area = -1;
};

/// The parts of a surface between its cuts, as a number of each face, and a sample of each part.
struct Parts {
  std::vector<std::size_t> of;
  std::vector<Sample> samples;
};

Parts parts_between(CgalMesh& surface, const Cuts& cuts, const TriangleMesh& mesh) {
  const auto part = surface.add_property_map<CgalMesh::Face_index, std::size_t>("f:part", 0).first;
  Parts parts;
  parts.samples.resize(pmp::connected_components(surface, part, CGAL::parameters::edge_is_constrained_map(cuts)));
  for (const CgalMesh::Face_index f : surface.faces()) {
    const Eigen::Vector3i face = mesh.faces.col(static_cast<Index>(parts.of.size()));
    parts.of.push_back(part[f]);
    const Vec3 a = mesh.vertices.col(face[0]), b = mesh.vertices.col(face[1]), c = mesh.vertices.col(face[2]);
    const Vec3 across = (b - a).cross(c - a);
    const Real area = across.norm();
    if (area > parts.samples[part[f]].area)
      parts.samples[part[f]] = {(a + b + c) / 3, 1e-6 * std::sqrt(area) * across.normalized(), area};
  }
  return parts;
}

/// The parts of a surface that lie outside of the other solid. Of walls on which both lie, those are left that look
/// the same way, of `first` alone.
TriangleMesh outer_parts(CgalMesh& surface, const Cuts& cuts, const Solid& other, bool first) {
  TriangleMesh mesh = from_cgal(surface);
  const Parts parts = parts_between(surface, cuts, mesh);
  const auto is_outside = [&](const Vec3& p) { return other(to_cgal(p)) == CGAL::ON_UNBOUNDED_SIDE; };
  std::vector<char> kept;
  for (const Sample& sample : parts.samples)
    kept.push_back(is_outside(sample.middle + sample.step) && (first || is_outside(sample.middle - sample.step)));
  Index count = 0;
  for (Index f = 0; f < mesh.face_count(); ++f)
    if (kept[parts.of[static_cast<std::size_t>(f)]]) mesh.faces.col(count++) = Eigen::Vector3i(mesh.faces.col(f));
  mesh.faces.conservativeResize(3, count);
  return mesh;
}

}  // namespace

std::optional<TriangleMesh> exact_union(const TriangleMesh& a, const TriangleMesh& b, const TimeLimit& limit) {
  if (!encloses_something(a) || !encloses_something(b)) return std::nullopt;
  std::optional<CgalMesh> first = to_cgal(a), second = to_cgal(b);
  if (!first || !second) return std::nullopt;
  try {
    const Cuts of_first = first->add_property_map<CgalMesh::Edge_index, bool>("e:cut", false).first;
    const Cuts of_second = second->add_property_map<CgalMesh::Edge_index, bool>("e:cut", false).first;
    // What CGAL itself makes of the parts ends in a loop for ever where the solids touch in a point or an edge.
    pmp::corefine(*first, *second,
                  CGAL::parameters::visitor(WatchedCutting(limit))
                      .throw_on_self_intersection(true)
                      .edge_is_constrained_map(of_first),
                  CGAL::parameters::edge_is_constrained_map(of_second));
    const TriangleMesh both = merged(
        {outer_parts(*first, of_first, Solid(*second), true), outer_parts(*second, of_second, Solid(*first), false)});
    return manifold_of_soup(both);
  } catch (const Error&) {
    throw;
  } catch (const std::exception&) {
    return std::nullopt;  // CGAL says that it cannot
  }
}

}  // namespace gracilis
