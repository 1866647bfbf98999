#include <gracilis/geometry/smoothing.hpp>

namespace gracilis {

/// Where vertex v goes from `before` by `factor` of the way to the mean of its neighbors.
template <class Matrix>
static auto towards_mean(const Matrix& before, const VertexStars& stars, Index v, Real factor) {
  using Number = typename Matrix::Scalar;
  using Place = Eigen::Vector<Number, Matrix::RowsAtCompileTime>;
  const Index begin = stars.offsets[static_cast<std::size_t>(v)], end = stars.offsets[static_cast<std::size_t>(v) + 1];
  Place here = before.col(v);
  if (begin == end) return here;
  Place mean = Place::Zero();
  for (Index i = begin; i < end; ++i) mean += before.col(stars.neighbors[static_cast<std::size_t>(i)]);
  return Place(here + static_cast<Number>(factor) * (mean / static_cast<Number>(end - begin) - here));
}

template <class Matrix>
static void smooth(Matrix& vertices, const VertexStars& stars, int rounds) {
  Matrix forth(vertices.rows(), vertices.cols());
  for (int round = 0; round < rounds; ++round) {
    for (Index v = 0; v < vertices.cols(); ++v) forth.col(v) = towards_mean(vertices, stars, v, smoothing_forth);
    for (Index v = 0; v < vertices.cols(); ++v) vertices.col(v) = towards_mean(forth, stars, v, smoothing_back);
  }
}

void move_to_means(Points& vertices, const VertexStars& stars, const Eigen::VectorXd& weights, Real factor) {
  const Points before = vertices;
  for (Index v = 0; v < vertices.cols(); ++v)
    if (weights[v] != 0) vertices.col(v) = towards_mean(before, stars, v, factor * weights[v]);
}

void smooth_points(Points& vertices, const VertexStars& stars, int rounds) { smooth(vertices, stars, rounds); }

void smooth_points(Eigen::Matrix4Xf& vertices, const VertexStars& stars, int rounds) {
  smooth(vertices, stars, rounds);
}

void keep_within(Real farthest, const Points& start, Points& vertices) {
  for (Index v = 0; v < vertices.cols(); ++v) {
    const Vec3 moved = vertices.col(v) - start.col(v);
    if (moved.norm() > farthest) vertices.col(v) = start.col(v) + moved.normalized() * farthest;
  }
}

}  // namespace gracilis
