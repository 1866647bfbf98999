#include "intersections.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>

namespace gracilis::contact_check {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Triangle = Kernel::Triangle_3;
using Segment = Kernel::Segment_3;
using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, Index>;

static Point point_of(const Points& points, Index vertex) {
  return {points(0, vertex), points(1, vertex), points(2, vertex)};
}

static Triangle triangle_of(const TriangleMesh& mesh, Index face) {
  return {point_of(mesh.vertices, mesh.faces(0, face)), point_of(mesh.vertices, mesh.faces(1, face)),
          point_of(mesh.vertices, mesh.faces(2, face))};
}

/// The boxes of all faces with area that reach into `region`.
static std::vector<Box> face_boxes(const TriangleMesh& mesh, const CGAL::Bbox_3& region) {
  std::vector<Box> boxes;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const Triangle triangle = triangle_of(mesh, f);
    const CGAL::Bbox_3 box = triangle.bbox();
    if (CGAL::do_overlap(box, region) && !triangle.is_degenerate()) boxes.emplace_back(box, f);
  }
  return boxes;
}

static CGAL::Bbox_3 bounds(const Points& points) {
  if (points.cols() == 0) return {};
  const Vec3 low = points.rowwise().minCoeff(), high = points.rowwise().maxCoeff();
  return {low.x(), low.y(), low.z(), high.x(), high.y(), high.z()};
}

std::vector<IndexPair> intersecting_faces(const TriangleMesh& one, const TriangleMesh& other) {
  const CGAL::Bbox_3 box = bounds(one.vertices), other_box = bounds(other.vertices);
  if (!CGAL::do_overlap(box, other_box)) return {};
  std::vector<Box> ours = face_boxes(one, other_box), theirs = face_boxes(other, box);
  std::vector<IndexPair> found;
  CGAL::box_intersection_d(ours.begin(), ours.end(), theirs.begin(), theirs.end(), [&](const Box& a, const Box& b) {
    if (CGAL::do_intersect(triangle_of(one, a.info()), triangle_of(other, b.info())))
      found.push_back({a.info(), b.info()});
  });
  std::sort(found.begin(), found.end());
  return found;
}

/// Whether two faces of one surface meet in more than the vertices they share.
static bool faces_overlap(const TriangleMesh& mesh, Index one, Index other) {
  std::array<Index, 3> a, b;
  for (int i = 0; i < 3; ++i) a[static_cast<std::size_t>(i)] = mesh.faces(i, one);
  for (int i = 0; i < 3; ++i) b[static_cast<std::size_t>(i)] = mesh.faces(i, other);
  // Shared vertices to the front, in the same order in both.
  std::size_t shared = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto same = std::find(b.begin() + static_cast<std::ptrdiff_t>(shared), b.end(), a[i]);
    if (same == b.end()) continue;
    std::iter_swap(same, b.begin() + static_cast<std::ptrdiff_t>(shared));
    std::swap(a[i], a[shared]);
    ++shared;
  }
  const auto at = [&](Index vertex) { return point_of(mesh.vertices, vertex); };
  if (shared == 3) return true;
  if (shared == 2) {  // only when one lies folded onto the other
    return CGAL::coplanar(at(a[0]), at(a[1]), at(a[2]), at(b[2])) &&
           CGAL::coplanar_orientation(at(a[0]), at(a[1]), at(a[2]), at(b[2])) == CGAL::POSITIVE;
  }
  if (shared == 1) {
    return CGAL::do_intersect(Segment(at(a[1]), at(a[2])), triangle_of(mesh, other)) ||
           CGAL::do_intersect(Segment(at(b[1]), at(b[2])), triangle_of(mesh, one));
  }
  return CGAL::do_intersect(triangle_of(mesh, one), triangle_of(mesh, other));
}

std::vector<IndexPair> self_intersecting_faces(const TriangleMesh& mesh) {
  std::vector<Box> boxes = face_boxes(mesh, bounds(mesh.vertices));
  std::vector<IndexPair> found;
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& a, const Box& b) {
    if (faces_overlap(mesh, a.info(), b.info()))
      found.push_back({std::min(a.info(), b.info()), std::max(a.info(), b.info())});
  });
  std::sort(found.begin(), found.end());
  return found;
}

Edges edges_of(const TriangleMesh& mesh) {
  Edges edges;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    for (int i = 0; i < 3; ++i) {
      const Index a = mesh.faces(i, f), b = mesh.faces((i + 1) % 3, f);
      edges.push_back({std::min(a, b), std::max(a, b)});
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

std::vector<Index> crossing_edges(const Points& points, const Edges& edges, const TriangleMesh& other) {
  const auto segment = [&](Index edge) {
    const IndexPair& ends = edges[static_cast<std::size_t>(edge)];
    return Segment(point_of(points, ends[0]), point_of(points, ends[1]));
  };
  const CGAL::Bbox_3 box = bounds(points), region = bounds(other.vertices);
  if (!CGAL::do_overlap(box, region)) return {};
  std::vector<Box> ours, theirs = face_boxes(other, box);
  for (Index e = 0; e < static_cast<Index>(edges.size()); ++e) {
    const Segment side = segment(e);
    if (CGAL::do_overlap(side.bbox(), region) && !side.is_degenerate()) ours.emplace_back(side.bbox(), e);
  }
  std::vector<Index> found;
  CGAL::box_intersection_d(ours.begin(), ours.end(), theirs.begin(), theirs.end(), [&](const Box& a, const Box& b) {
    if (CGAL::do_intersect(segment(a.info()), triangle_of(other, b.info()))) found.push_back(a.info());
  });
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace gracilis::contact_check
