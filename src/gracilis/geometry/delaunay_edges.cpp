#include <gracilis/geometry/delaunay_edges.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/core/sort_unique.hpp>

#include <libqhull_r/qhull_ra.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>

namespace gracilis {

namespace {

/// Qhull's state and what it prints of troubles, which errors here say in their own words.
class Hull {
 public:
  Hull() : messages_(std::tmpfile(), &std::fclose) { qh_zero(&state_, messages_ ? messages_.get() : stderr); }
  ~Hull() {
    int left_blocks = 0, left_bytes = 0;
    qh_freeqhull(&state_, !qh_ALL);
    qh_memfreeshort(&state_, &left_blocks, &left_bytes);
  }
  Hull(const Hull&) = delete;
  Hull& operator=(const Hull&) = delete;

  /// Whether the tetrahedra of the points were found. `points` must outlive this.
  bool divide(Points& points) {
    // Triangulated, with the last coordinate scaled, and a point at infinity so that spheres of points are welcome.
    char command[] = "qhull d Qt Qbb Qc Qz";
    return qh_new_qhull(&state_, 3, static_cast<int>(points.cols()), points.data(), False, command, nullptr,
                        messages_.get()) == 0;
  }

  /// Calls act(number of a corner) for all corners of a tetrahedron, for every tetrahedron.
  template <class Act>
  void for_each_tetrahedron(const Act& act) {
    for (facetT* facet = state_.facet_list; facet && facet->next; facet = facet->next) {
      if (facet->upperdelaunay) continue;
      std::vector<Index> corners;
      const int count = qh_setsize(&state_, facet->vertices);
      for (int i = 0; i < count; ++i) {
        auto* vertex = static_cast<vertexT*>(facet->vertices->e[i].p);
        corners.push_back(qh_pointid(&state_, vertex->point));
      }
      act(corners);
    }
  }

 private:
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> messages_;
  qhT state_;
};

}  // namespace

std::vector<std::array<Index, 2>> delaunay_edges(const Points& points) {
  const auto refuse = [](const std::string& what) {
    throw InputError({"", "", "points have no Delaunay tetrahedra: " + what, ""});
  };
  if (points.cols() < 4) refuse("there are fewer than four");
  if (!points.allFinite()) refuse("a coordinate is not finite");
  Points own = points;  // Qhull asks for memory that it may write to
  Hull hull;
  if (!hull.divide(own)) refuse("they lie in a plane, or nearly");
  std::vector<std::array<Index, 2>> edges;
  const auto count = static_cast<Index>(points.cols());
  hull.for_each_tetrahedron([&](const std::vector<Index>& corners) {
    for (std::size_t i = 0; i < corners.size(); ++i)
      for (std::size_t j = i + 1; j < corners.size(); ++j)
        if (const auto [a, b] = std::minmax(corners[i], corners[j]); a >= 0 && b < count) edges.push_back({a, b});
  });
  sort_unique(edges);
  if (edges.empty()) refuse("they lie in a plane, or nearly");
  return edges;
}

}  // namespace gracilis
