#include <gracilis/geometry/surface_binding.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/mean_value_coordinates.hpp>
#include <gracilis/geometry/measures.hpp>

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

void SurfaceBinding::build_groups(const TriangleMesh& surface, Index begin, Index end) {
  const std::size_t self = groups_.size();
  groups_.push_back({begin, end, 0, Vec3::Zero(), 0});
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
    for (Index i = group.begin; i < group.end; ++i) weight += weights[order_[static_cast<std::size_t>(i)]];
    terms.push_back({index, static_cast<float>(weight)});
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

  // Means over groups, children before parents.
  Eigen::Matrix4Xf means(4, static_cast<Index>(groups_.size()));  // one aligned load per term
  for (std::size_t g = groups_.size(); g-- > 0;) {
    const Group& group = groups_[g];
    const auto column = static_cast<Index>(g);
    if (group.second_child == 0) {
      means.col(column) << left.col(order_[static_cast<std::size_t>(group.begin)]), 0;
    } else {
      means.col(column) = (means.col(column + 1) + means.col(group.second_child)) / 2;
    }
  }
  Points result = moved(points_);
  parallel_for(static_cast<Index>(result.cols()), 256, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) {
      Eigen::Vector4f sum = Eigen::Vector4f::Zero();
      for (std::size_t t = offsets_[static_cast<std::size_t>(i)]; t < offsets_[static_cast<std::size_t>(i) + 1]; ++t)
        sum += terms_[t].weight * means.col(terms_[t].group);
      result.col(i) += sum.head<3>().cast<Real>();
    }
  });
  return result;
}

}  // namespace gracilis
