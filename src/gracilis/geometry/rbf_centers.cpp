#include <gracilis/geometry/rbf_centers.hpp>

#include <gracilis/geometry/halton.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace gracilis {

namespace {

Points points_of(const std::vector<Vec3>& list) {
  Points points(3, static_cast<Eigen::Index>(list.size()));
  for (std::size_t i = 0; i < list.size(); ++i) points.col(static_cast<Index>(i)) = list[i];
  return points;
}

/// Takes, one after the other, the candidate farthest from all taken so far.
class Spreading {
 public:
  explicit Spreading(const Points& candidates)
      : candidates_(candidates),
        squares_(Eigen::VectorXd::Constant(candidates.cols(), std::numeric_limits<Real>::infinity())) {}

  void take(const Vec3& point) {
    taken_.push_back(point);
    squares_ = squares_.cwiseMin((candidates_.colwise() - point).colwise().squaredNorm().transpose());
  }
  /// False where all candidates are taken.
  bool take_next() {
    if (candidates_.cols() == 0) return false;
    const Real most = squares_.maxCoeff();
    if (!(most > 0)) return false;
    // The first of those that are as far: on regular surfaces rounding must not choose.
    constexpr Real as_far = 1 - 1e-6;
    Eigen::Index next = 0;
    while (!(squares_[next] >= as_far * most)) ++next;
    take(candidates_.col(next));
    return true;
  }
  const std::vector<Vec3>& taken() const { return taken_; }

 private:
  const Points& candidates_;
  Eigen::VectorXd squares_;  ///< to the nearest taken one
  std::vector<Vec3> taken_;
};

}  // namespace

Points grid_centers(const Eigen::AlignedBox3d& box, const Eigen::Vector3i& counts) {
  std::vector<Vec3> centers;
  for (Index k = 0; k < counts.z(); ++k)
    for (Index j = 0; j < counts.y(); ++j)
      for (Index i = 0; i < counts.x(); ++i) {
        Vec3 share;
        const Eigen::Vector3i at(i, j, k);
        for (int axis = 0; axis < 3; ++axis)
          share[axis] = counts[axis] > 1 ? static_cast<Real>(at[axis]) / (counts[axis] - 1) : 0.5;
        centers.push_back(box.min() + share.cwiseProduct(box.sizes()));
      }
  return points_of(centers);
}

Points halton_centers(const Eigen::AlignedBox3d& box, Index count) {
  const Points shares = halton_points(count, 3).transpose();
  Points centers(3, count);
  for (Index i = 0; i < count; ++i) centers.col(i) = box.min() + shares.col(i).cwiseProduct(box.sizes());
  return centers;
}

Points spread_out(const Points& points, Index count) {
  Spreading spreading(points);
  if (points.cols() > 0 && count > 0) spreading.take(points.col(0));
  while (static_cast<Index>(spreading.taken().size()) < count && spreading.take_next()) {
  }
  return points_of(spreading.taken());
}

Points filled_up(const Points& points, Index count, const Eigen::AlignedBox3d& box) {
  const Points given = spread_out(points, count);
  const Points more = halton_centers(box, 4 * count);
  Spreading spreading(more);
  for (Index i = 0; i < static_cast<Index>(given.cols()); ++i) spreading.take(given.col(i));
  while (static_cast<Index>(spreading.taken().size()) < count && spreading.take_next()) {
  }
  return points_of(spreading.taken());
}

RadialFit fit_greedily(const RadialFitSettings& settings, const Points& points, const Eigen::VectorXd& values,
                       const std::vector<Real>& reaches, Index count) {
  assert(!reaches.empty() && count > 0);
  RadialFit fit;
  Points centers(3, 0);
  Eigen::VectorXd chosen(0), left = values;
  std::vector<char> taken(static_cast<std::size_t>(points.cols()), 0);
  for (Index n = 0; n < count; ++n) {
    Index worst = -1;
    for (Index i = 0; i < static_cast<Index>(points.cols()); ++i)
      if (!taken[static_cast<std::size_t>(i)] && (worst < 0 || std::abs(left[i]) > std::abs(left[worst]))) worst = i;
    taken[static_cast<std::size_t>(worst)] = 1;
    Real best_reach = reaches.front(), most = -1;
    for (const Real reach : reaches) {
      Eigen::VectorXd column(points.cols());
      for (Index i = 0; i < static_cast<Index>(points.cols()); ++i)
        column[i] = radial_value(settings.kernel, reach, (points.col(i) - points.col(worst)).norm());
      const Real along = column.dot(left), takes = along * along / column.squaredNorm();
      if (takes > most) most = takes, best_reach = reach;
    }
    centers.conservativeResize(3, n + 1);
    chosen.conservativeResize(n + 1);
    centers.col(n) = points.col(worst);
    chosen[n] = best_reach;
    fit = fit_least_squares(settings, centers, chosen, points, values);
    left = -errors_at(fit.basis, points, values);
  }
  return fit;
}

Real mean_squared_error(const RadialBasis& basis, const Points& points, const Eigen::VectorXd& values) {
  return errors_at(basis, points, values).squaredNorm() / static_cast<Real>(values.size());
}

}  // namespace gracilis
