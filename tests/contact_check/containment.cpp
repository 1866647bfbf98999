#include "containment.hpp"

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>

#include <cmath>

namespace gracilis::contact_check {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using SurfaceMesh = CGAL::Surface_mesh<Point>;
using OneMesh = CGAL::Tag_true;
using TrianglesKept = CGAL::Tag_true;
using Primitive = CGAL::AABB_face_graph_triangle_primitive<SurfaceMesh, CGAL::Default, OneMesh, TrianglesKept>;
using FaceTree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;
using Side = CGAL::Side_of_triangle_mesh<SurfaceMesh, Kernel, CGAL::Default, FaceTree>;

/// Every face with three vertices of its own, so that surfaces which are no manifold can be asked, too.
static SurfaceMesh loose_faces(const TriangleMesh& mesh) {
  SurfaceMesh loose;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    SurfaceMesh::Vertex_index corners[3];
    for (int i = 0; i < 3; ++i) {
      const Vec3 p = mesh.vertices.col(mesh.faces(i, f));
      corners[i] = loose.add_vertex(Point(p.x(), p.y(), p.z()));
    }
    if (!CGAL::collinear(loose.point(corners[0]), loose.point(corners[1]), loose.point(corners[2])))
      loose.add_face(corners[0], corners[1], corners[2]);
  }
  return loose;
}

struct Solid::Tree {
  explicit Tree(const TriangleMesh& closed)
      : surface(loose_faces(closed)), tree(faces(surface).first, faces(surface).second, surface) {
    tree.build();
  }

  const SurfaceMesh surface;
  FaceTree tree;
};

Solid::Solid(const TriangleMesh& closed) : tree_(std::make_shared<const Tree>(closed)) {}

Eigen::VectorXd Solid::depths(const Points& points) const {
  Eigen::VectorXd depths = Eigen::VectorXd::Zero(points.cols());
  if (!tree_ || tree_->tree.empty()) return depths;
  const Side side(tree_->tree);
  for (Index i = 0; i < points.cols(); ++i) {
    const Point point(points(0, i), points(1, i), points(2, i));
    if (side(point) == CGAL::ON_BOUNDED_SIDE)
      depths[i] = std::sqrt(CGAL::to_double(tree_->tree.squared_distance(point)));
  }
  return depths;
}

}  // namespace gracilis::contact_check
