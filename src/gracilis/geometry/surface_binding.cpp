#include <gracilis/geometry/surface_binding.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/mean_value_coordinates.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/principal_axes.hpp>

#include <algorithm>
#include <numeric>

namespace gracilis {

SurfaceBinding::SurfaceBinding(const TriangleMesh& surface, const Points& points, Real openness)
    : rest_(surface.vertices), points_(points), shares_(vertex_areas(surface.vertices, surface.faces)) {
  shares_ /= shares_.sum();
  center_ = rest_ * shares_;
  const Points centered = rest_.colwise() - center_;
  inverse_ = (centered * shares_.asDiagonal() * centered.transpose()).inverse();
  order_.resize(static_cast<std::size_t>(rest_.cols()));
  std::iota(order_.begin(), order_.end(), 0);
  build_groups(surface, 0, surface.vertex_count());

  const MeanValueCoordinates coordinates(surface);
  std::vector<std::vector<Term>> per_point(static_cast<std::size_t>(points.cols()));
  parallel_for(static_cast<Index>(points.cols()), 8, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i)
      add_terms(points.col(i), coordinates.weights(points.col(i)), openness, per_point[static_cast<std::size_t>(i)]);
  });
  offsets_ = {0};
  for (const std::vector<Term>& terms : per_point) {
    terms_.insert(terms_.end(), terms.begin(), terms.end());
    offsets_.push_back(terms_.size());
  }
}

/// Directions in which vertices spread less than this share of their largest spread tell nothing about the gradient.
static constexpr Real flat = 0.1;

Eigen::Matrix3f SurfaceBinding::inverse_spread(Index begin, Index end, const Vec3& mean) const {
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (Index i = begin; i < end; ++i) {
    const Vec3 r = rest_.col(order_[static_cast<std::size_t>(i)]) - mean;
    spread += r * r.transpose();
  }
  const PrincipalAxes axes = principal_axes(spread);
  Vec3 inverse = Vec3::Zero();
  for (int k = 0; k < 3; ++k)
    if (axes.values[k] > flat * flat * axes.values[2]) inverse[k] = 1 / axes.values[k];
  return (axes.directions * inverse.asDiagonal() * axes.directions.transpose()).cast<float>();
}

void SurfaceBinding::build_groups(const TriangleMesh& surface, Index begin, Index end) {
  const std::size_t self = groups_.size();
  groups_.push_back({begin, end, 0, Vec3::Zero(), 0, Vec3::Zero(), Eigen::Matrix3f::Zero()});
  Vec3 low = rest_.col(order_[static_cast<std::size_t>(begin)]), high = low;
  for (Index i = begin; i < end; ++i) {
    const Vec3 x = rest_.col(order_[static_cast<std::size_t>(i)]);
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  Eigen::Index axis = 0;
  (high - low).maxCoeff(&axis);
  groups_[self].center = (low + high) / 2;
  groups_[self].radius = (high - low).norm() / 2;
  Vec3 mean = Vec3::Zero();
  for (Index i = begin; i < end; ++i) mean += rest_.col(order_[static_cast<std::size_t>(i)]) / (end - begin);
  groups_[self].mean = mean;
  groups_[self].inverse_spread = inverse_spread(begin, end, mean);
  if (end - begin < 2) return;
  const Index middle = begin + (end - begin) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end, [&](Index a, Index b) {
    return rest_(axis, a) != rest_(axis, b) ? rest_(axis, a) < rest_(axis, b) : a < b;
  });
  build_groups(surface, begin, middle);
  groups_[self].second_child = static_cast<Index>(groups_.size());
  build_groups(surface, middle, end);
}

void SurfaceBinding::add_terms(const Vec3& p, const Eigen::VectorXd& weights, Real openness,
                               std::vector<Term>& terms) const {
  std::vector<Index> open = {0};
  while (!open.empty()) {
    const Index index = open.back();
    open.pop_back();
    const Group& group = groups_[static_cast<std::size_t>(index)];
    if (group.second_child > 0 && group.radius > openness * (group.center - p).norm()) {
      open.push_back(group.second_child);
      open.push_back(index + 1);
      continue;
    }
    Real weight = 0;
    Vec3 moment = Vec3::Zero();
    for (Index i = group.begin; i < group.end; ++i) {
      const Index v = order_[static_cast<std::size_t>(i)];
      weight += weights[v];
      moment += weights[v] * (rest_.col(v) - group.mean);
    }
    terms.push_back({index, static_cast<float>(weight), moment.cast<float>()});
  }
}

Points SurfaceBinding::evaluate(const Points& vertices) const {
  const Vec3 center = vertices * shares_;
  const Eigen::Matrix3d affine =
      (vertices.colwise() - center) * shares_.asDiagonal() * (rest_.colwise() - center_).transpose() * inverse_;
  const auto moved = [&](const Points& points) -> Points {
    return (affine * (points.colwise() - center_)).colwise() + center;
  };
  const Eigen::Matrix3Xf left = (vertices - moved(rest_)).cast<float>();

  // Means of d and its moments with r over groups, children before parents; then mean and gradient as four columns.
  std::vector<Eigen::Vector3f> means(groups_.size());
  std::vector<Eigen::Matrix3f> moments(groups_.size());
  Eigen::Matrix4Xf fits(4, 4 * static_cast<Index>(groups_.size()));
  for (std::size_t g = groups_.size(); g-- > 0;) {
    const Group& group = groups_[g];
    if (group.second_child == 0) {
      means[g] = left.col(order_[static_cast<std::size_t>(group.begin)]);
      moments[g].setZero();
    } else {
      const std::size_t children[] = {g + 1, static_cast<std::size_t>(group.second_child)};
      means[g].setZero();
      moments[g].setZero();
      for (const std::size_t child : children)
        means[g] += means[child] * (static_cast<float>(groups_[child].end - groups_[child].begin) /
                                    static_cast<float>(group.end - group.begin));
      for (const std::size_t child : children)
        moments[g] += moments[child] + static_cast<float>(groups_[child].end - groups_[child].begin) *
                                           (means[child] - means[g]) *
                                           (groups_[child].mean - group.mean).cast<float>().transpose();
    }
    const auto column = 4 * static_cast<Index>(g);
    fits.col(column) << means[g], 0;
    fits.block<3, 3>(0, column + 1) = moments[g] * group.inverse_spread;
    fits.block<1, 3>(3, column + 1).setZero();
  }
  Points result = moved(points_);
  parallel_for(static_cast<Index>(result.cols()), 256, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) {
      Eigen::Vector4f sum = Eigen::Vector4f::Zero();
      for (std::size_t t = offsets_[static_cast<std::size_t>(i)]; t < offsets_[static_cast<std::size_t>(i) + 1]; ++t) {
        const Term& term = terms_[t];
        const Index column = 4 * term.group;
        sum += term.weight * fits.col(column) + term.moment[0] * fits.col(column + 1) +
               term.moment[1] * fits.col(column + 2) + term.moment[2] * fits.col(column + 3);
      }
      result.col(i) += sum.head<3>().cast<Real>();
    }
  });
  return result;
}

}  // namespace gracilis
