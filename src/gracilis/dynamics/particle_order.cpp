#include <gracilis/dynamics/particle_order.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <cstdint>

namespace gracilis {

namespace {

/// Particles of a cluster, whose positions fit into a core's first cache.
constexpr Index cluster_particles = 2048;
/// Up to so many clusters, bands are wide enough.
constexpr Index most_bands = 16;

/// Cuts vertices into clusters, those of each in the order of their ranks.
class ClusterCutter {
 public:
  ClusterCutter(const Points& vertices, std::vector<Index>& order)
      : vertices_(vertices), order_(order), rank_(order.size()), clusters_(cluster_count_of(count())) {
    for (std::size_t i = 0; i < order.size(); ++i) rank_[static_cast<std::size_t>(order[i])] = static_cast<Index>(i);
  }

  void cut() { cut(0, clusters_); }

 private:
  void cut(Index first, Index last) {
    const auto begin = at(first), end = at(last);
    if (last - first <= 1) {
      std::sort(begin, end, [this](Index l, Index r) { return rank(l) < rank(r); });
      return;
    }
    const Index middle = (first + last) / 2;
    const Index axis = longest_axis(begin, end);
    std::nth_element(begin, at(middle), end, [this, axis](Index l, Index r) {
      const Real left = vertices_(axis, l), right = vertices_(axis, r);
      return left < right || (left == right && rank(l) < rank(r));
    });
    cut(first, middle);
    cut(middle, last);
  }

  Index longest_axis(std::vector<Index>::iterator begin, std::vector<Index>::iterator end) const {
    Eigen::AlignedBox3d box;
    for (auto v = begin; v != end; ++v) box.extend(Vec3(vertices_.col(*v)));
    Index axis = 0;
    box.sizes().maxCoeff(&axis);
    return axis;
  }

  Index count() const { return static_cast<Index>(order_.size()); }
  Index rank(Index vertex) const { return rank_[static_cast<std::size_t>(vertex)]; }
  std::vector<Index>::iterator at(Index cluster) {
    return order_.begin() + begin_of_cluster(cluster, count(), clusters_);
  }

  const Points& vertices_;
  std::vector<Index>& order_;
  std::vector<Index> rank_;
  Index clusters_;
};

}  // namespace

Index cluster_count_of(Index particle_count) { return std::max<Index>(1, particle_count / cluster_particles); }

Index begin_of_cluster(Index cluster, Index particle_count, Index cluster_count) {
  return static_cast<Index>((std::int64_t{cluster} * particle_count + cluster_count - 1) / cluster_count);
}

Index cluster_of(Index particle, Index particle_count, Index cluster_count) {
  return static_cast<Index>(std::int64_t{particle} * cluster_count / std::max<Index>(particle_count, 1));
}

std::vector<Index> particle_order(const Points& vertices, const VertexStars& stars) {
  std::vector<Index> order = breadth_first_order(stars);
  if (cluster_count_of(static_cast<Index>(order.size())) > most_bands) ClusterCutter(vertices, order).cut();
  return order;
}

}  // namespace gracilis
