#include <gracilis/prepare/cgal.hpp>
#include <gracilis/prepare/cgal_mesh.hpp>

#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <tuple>

namespace gracilis {
namespace {

struct Corner {
  Index mesh = 0, face = 0;
};
using Box = CGAL::Box_intersection_d::Box_with_handle_d<double, 3, const Corner*>;

class Soup {
 public:
  explicit Soup(std::span<const TriangleMesh* const> meshes) : meshes_(meshes) {}

  Eigen::Vector3i corners(const Corner& f) const {
    return meshes_[static_cast<std::size_t>(f.mesh)]->faces.col(f.face);
  }
  CgalPoint point(Index mesh, Index vertex) const {
    return to_cgal(meshes_[static_cast<std::size_t>(mesh)]->vertices.col(vertex));
  }
  CgalKernel::Triangle_3 triangle(const Corner& f) const {
    const Eigen::Vector3i c = corners(f);
    return {point(f.mesh, c[0]), point(f.mesh, c[1]), point(f.mesh, c[2])};
  }

  bool intersect(const Corner& a, const Corner& b) const {
    const CgalKernel::Triangle_3 s = triangle(a), t = triangle(b);
    if (s.is_degenerate() || t.is_degenerate()) return false;  // a line or point bounds no tissue
    const Eigen::Vector3i ca = corners(a), cb = corners(b);
    // Turned so that the shared vertices come first in both.
    std::vector<std::pair<int, int>> shared;
    if (a.mesh == b.mesh)
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          if (ca[i] == cb[j]) shared.emplace_back(i, j);
    if (shared.empty()) return CGAL::do_intersect(s, t);
    if (shared.size() == 1) {
      const auto [i, j] = shared[0];
      const CgalKernel::Segment_3 opposite_a(s.vertex(i + 1), s.vertex(i + 2));
      const CgalKernel::Segment_3 opposite_b(t.vertex(j + 1), t.vertex(j + 2));
      return CGAL::do_intersect(opposite_a, t) || CGAL::do_intersect(opposite_b, s);
    }
    if (shared.size() == 3) return true;  // the same face twice
    // Across a shared edge two triangles overlap only when folded flat onto each other.
    const CgalPoint p = s.vertex(shared[0].first), q = s.vertex(shared[1].first);
    const CgalPoint r = s.vertex(3 - shared[0].first - shared[1].first);
    const CgalPoint u = t.vertex(3 - shared[0].second - shared[1].second);
    return CGAL::coplanar(p, q, r, u) && CGAL::coplanar_orientation(p, q, r, u) == CGAL::POSITIVE;
  }

 private:
  std::span<const TriangleMesh* const> meshes_;
};

}  // namespace

std::vector<FacePair> intersecting_faces(std::span<const TriangleMesh* const> meshes, bool between_only,
                                         const TimeLimit& limit) {
  std::vector<Corner> faces;
  for (std::size_t m = 0; m < meshes.size(); ++m)
    for (Index f = 0; f < meshes[m]->face_count(); ++f) faces.push_back({static_cast<Index>(m), f});
  const Soup soup(meshes);
  std::vector<Box> boxes;
  boxes.reserve(faces.size());
  for (const Corner& face : faces) boxes.emplace_back(soup.triangle(face).bbox(), &face);
  std::vector<FacePair> pairs;
  std::size_t looks = 0;
  const auto consider = [&](const Box& one, const Box& other) {
    const Corner *a = one.handle(), *b = other.handle();
    if (between_only && a->mesh == b->mesh) return;
    if (std::tie(b->mesh, b->face) < std::tie(a->mesh, a->face)) std::swap(a, b);
    if (++looks % 4096 == 0) limit.check();
    if (soup.intersect(*a, *b)) pairs.push_back({a->mesh, a->face, b->mesh, b->face});
  };
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), consider);
  std::sort(pairs.begin(), pairs.end(), [](const FacePair& l, const FacePair& r) {
    return std::tie(l.mesh_a, l.face_a, l.mesh_b, l.face_b) < std::tie(r.mesh_a, r.face_a, r.mesh_b, r.face_b);
  });
  return pairs;
}

}  // namespace gracilis
