#include <gracilis/geometry/box_tree.hpp>

#include <gracilis/geometry/measures.hpp>

#include <numeric>

namespace gracilis {

BoxTree::BoxTree(const TriangleMesh& mesh)
    : place_(bounding_box(mesh.vertices).center()),
      vertices_((mesh.vertices.colwise() - place_).cast<float>()),
      faces_(mesh.faces),
      order_(static_cast<std::size_t>(mesh.face_count())) {
  std::iota(order_.begin(), order_.end(), 0);
  std::vector<Box> of_faces(order_.size());
  for (std::size_t f = 0; f < of_faces.size(); ++f)
    for (const Index corner : faces_.col(static_cast<Index>(f))) {
      Box point;
      point.low = point.high = vertices_.col(corner);
      of_faces[f].add(point);
    }
  split(0, order_.size(), of_faces);
  for (const Index face : order_) boxes_.push_back(of_faces[static_cast<std::size_t>(face)]);
}

/// Appends the node of these triangles and all below it: halves by the middles of boxes, across the longest side.
void BoxTree::split(std::size_t begin, std::size_t end, const std::vector<Box>& of_faces) {
  constexpr std::size_t leaf = 4;
  const std::size_t number = nodes_.size();
  nodes_.emplace_back();
  const auto box = [&](Index face) -> const Box& { return of_faces[static_cast<std::size_t>(face)]; };
  for (std::size_t i = begin; i < end; ++i) nodes_[number].add(box(order_[i]));
  if (end - begin <= leaf) {
    nodes_[number].first = begin;
    nodes_[number].count = end - begin;
    return;
  }
  Eigen::Index side = 0;
  (nodes_[number].high - nodes_[number].low).maxCoeff(&side);
  const std::size_t middle = begin + (end - begin) / 2;
  const auto at = [&](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(begin), at(middle), at(end), [&](Index a, Index b) {
    const float of_a = box(a).low[side] + box(a).high[side], of_b = box(b).low[side] + box(b).high[side];
    return of_a < of_b || (of_a == of_b && a < b);
  });
  split(begin, middle, of_faces);
  nodes_[number].first = nodes_.size();
  split(middle, end, of_faces);
}

bool BoxTree::Box::meets(const Eigen::Vector3f& from, const Eigen::Vector3f& way, float end) const {
  float enters = 0, leaves = end;
  for (Index k = 0; k < 3; ++k) {
    if (way[k] == 0) {
      if (from[k] < low[k] || from[k] > high[k]) return false;
      continue;
    }
    const float a = (low[k] - from[k]) / way[k], b = (high[k] - from[k]) / way[k];
    constexpr float rounding = 4 * std::numeric_limits<float>::epsilon();
    enters = std::max(enters, std::min(a, b) - rounding * std::abs(std::min(a, b)));
    leaves = std::min(leaves, std::max(a, b) + rounding * std::abs(std::max(a, b)));
  }
  return enters <= leaves;
}

/// Which share of the segment lies before the triangle; infinity where they do not meet. By signed volumes about the
/// segment's beginning, whose edges neighbors see alike, so that nothing slips through between them.
float BoxTree::where_met(Index face, const Eigen::Vector3f& from, const Eigen::Vector3f& way) const {
  constexpr float nowhere = std::numeric_limits<float>::infinity();
  const Eigen::Vector3f a = vertices_.col(faces_(0, face)) - from, b = vertices_.col(faces_(1, face)) - from,
                        c = vertices_.col(faces_(2, face)) - from;
  // The cross product of p and q is, to the last bit, the opposite of that of q and p.
  const float of_a = way.dot(c.cross(b)), of_b = way.dot(a.cross(c)), of_c = way.dot(b.cross(a));
  if ((of_a < 0 || of_b < 0 || of_c < 0) && (of_a > 0 || of_b > 0 || of_c > 0)) return nowhere;
  const Eigen::Vector3f normal = (b - a).cross(c - a);
  const float towards = way.dot(normal);
  if (towards == 0) return nowhere;
  const float share = a.dot(normal) / towards;
  return share >= 0 && share <= 1 ? share : nowhere;
}

}  // namespace gracilis
