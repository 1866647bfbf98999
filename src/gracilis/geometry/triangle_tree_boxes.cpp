// Stands in for triangle_tree.cpp where there is no Embree (WebAssembly).
#include <gracilis/geometry/triangle_tree.hpp>

#include <gracilis/geometry/box_tree.hpp>

namespace gracilis {

struct TriangleTree::Tree {
  BoxTree boxes;
};

TriangleTree::TriangleTree(const TriangleMesh& mesh) : tree_(new Tree{BoxTree(mesh)}) {}

TriangleTree::~TriangleTree() = default;
TriangleTree::TriangleTree(TriangleTree&&) noexcept = default;
TriangleTree& TriangleTree::operator=(TriangleTree&&) noexcept = default;

void TriangleTree::near(const Vec3& p, float radius, Near near, void* query) const {
  tree_->boxes.near(p, radius, [&](Index face) { return near(face, query); });
}

bool TriangleTree::cut(const Vec3& a, const Vec3& b) const { return first(a, b).has_value(); }

std::optional<TriangleTree::Hit> TriangleTree::first(const Vec3& a, const Vec3& b) const {
  Index first = -1;
  float before = 1;
  tree_->boxes.along(a, b, [&](Index face, float share) {
    if (first < 0 || share < before || (share == before && face < first)) first = face, before = share;
    return before;
  });
  if (first < 0) return std::nullopt;
  return Hit{first, a + static_cast<Real>(before) * (b - a)};
}

void TriangleTree::all(const Vec3& a, const Vec3& b, Met met, void* query) const {
  tree_->boxes.along(a, b, [&](Index face, float) {
    met(face, query);
    return 1.f;
  });
}

}  // namespace gracilis
