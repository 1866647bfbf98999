#include <gracilis/geometry/half_edges.hpp>

#include <algorithm>
#include <tuple>

namespace gracilis {

namespace {

/// Calls act(half_edge) for all, face by face.
template <class Act>
void for_each_half_edge(const Eigen::Matrix3Xi& faces, const Act& act) {
  for (Index face = 0; face < static_cast<Index>(faces.cols()); ++face)
    for (int k = 0; k < 3; ++k) {
      const Index from = faces(k, face), to = faces((k + 1) % 3, face), apex = faces((k + 2) % 3, face);
      if (from != to) act(HalfEdge{std::min(from, to), std::max(from, to), face, apex, from < to});
    }
}

}  // namespace

std::vector<HalfEdge> sorted_half_edges(const Eigen::Matrix3Xi& faces) {
  if (faces.size() == 0) return {};
  // Dealt out by their lower vertex; then only those of one vertex are sorted.
  std::vector<Index> end(static_cast<std::size_t>(faces.maxCoeff()) + 2, 0);
  for_each_half_edge(faces, [&](const HalfEdge& each) { ++end[static_cast<std::size_t>(each.low) + 1]; });
  for (std::size_t v = 1; v < end.size(); ++v) end[v] += end[v - 1];
  std::vector<HalfEdge> half_edges(static_cast<std::size_t>(end.back()));
  for_each_half_edge(faces, [&](const HalfEdge& each) {
    half_edges[static_cast<std::size_t>(end[static_cast<std::size_t>(each.low)]++)] = each;
  });
  auto begin = half_edges.begin();
  for (std::size_t v = 0; v + 1 < end.size(); ++v) {
    const auto last = half_edges.begin() + end[v];
    std::sort(begin, last, [](const HalfEdge& l, const HalfEdge& r) {
      return std::tie(l.high, l.face, l.forward) < std::tie(r.high, r.face, r.forward);
    });
    begin = last;
  }
  return half_edges;
}

}  // namespace gracilis
