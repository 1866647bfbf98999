#include <gracilis/geometry/half_edges.hpp>

#include <algorithm>
#include <tuple>

namespace gracilis {

std::vector<HalfEdge> sorted_half_edges(const Eigen::Matrix3Xi& faces) {
  std::vector<HalfEdge> half_edges;
  half_edges.reserve(static_cast<std::size_t>(faces.size()));
  for (Index f = 0; f < static_cast<Index>(faces.cols()); ++f) {
    for (Index k = 0; k < 3; ++k) {
      const Index a = faces(k, f);
      const Index b = faces((k + 1) % 3, f);
      if (a != b) half_edges.push_back({std::min(a, b), std::max(a, b), f, a < b});
    }
  }
  std::sort(half_edges.begin(), half_edges.end(), [](const HalfEdge& x, const HalfEdge& y) {
    return std::tie(x.low, x.high, x.face, x.forward) < std::tie(y.low, y.high, y.face, y.forward);
  });
  return half_edges;
}

}  // namespace gracilis
