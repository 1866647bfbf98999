#include <gracilis/geometry/nearest_points.hpp>

#include <nanoflann.hpp>

#include <algorithm>

namespace gracilis {

struct NearestPoints::Tree {
  using Rows = Eigen::Matrix<Real, Eigen::Dynamic, 3>;

  explicit Tree(const Points& points) : rows(points.transpose()), index(3, std::cref(rows)) {}

  Rows rows;
  nanoflann::KDTreeEigenMatrixAdaptor<Rows, 3> index;
};

NearestPoints::NearestPoints(const Points& points) : tree_(std::make_unique<Tree>(points)) {}

NearestPoints::~NearestPoints() = default;
NearestPoints::NearestPoints(NearestPoints&&) noexcept = default;
NearestPoints& NearestPoints::operator=(NearestPoints&&) noexcept = default;

std::vector<Index> NearestPoints::query(const Vec3& p, std::size_t count) const {
  count = std::min(count, static_cast<std::size_t>(tree_->rows.rows()));
  std::vector<Eigen::Index> found(count);
  std::vector<Real> squares(count);
  tree_->index.query(p.data(), count, found.data(), squares.data());
  return {found.begin(), found.end()};
}

std::vector<Index> NearestPoints::within(const Vec3& p, Real reach) const {
  std::vector<std::pair<Eigen::Index, Real>> matches;
  tree_->index.index->radiusSearch(p.data(), reach * reach, matches, nanoflann::SearchParams(32, 0, false));
  std::vector<Index> found;
  found.reserve(matches.size());
  for (const auto& match : matches) found.push_back(static_cast<Index>(match.first));
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace gracilis
