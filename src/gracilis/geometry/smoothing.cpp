#include <gracilis/geometry/smoothing.hpp>

namespace gracilis {

void move_to_means(Points& vertices, const VertexStars& stars, const Eigen::VectorXd& weights, Real factor) {
  const Points before = vertices;
  for (Index v = 0; v < vertices.cols(); ++v) {
    const Index begin = stars.offsets[static_cast<std::size_t>(v)],
                end = stars.offsets[static_cast<std::size_t>(v) + 1];
    if (weights[v] == 0 || begin == end) continue;
    Vec3 mean = Vec3::Zero();
    for (Index i = begin; i < end; ++i) mean += before.col(stars.neighbors[static_cast<std::size_t>(i)]);
    vertices.col(v) += factor * weights[v] * (mean / (end - begin) - before.col(v));
  }
}

void smooth_points(Points& vertices, const VertexStars& stars, int rounds) {
  const Eigen::VectorXd all = Eigen::VectorXd::Ones(vertices.cols());
  for (int round = 0; round < rounds; ++round) {
    move_to_means(vertices, stars, all, smoothing_forth);
    move_to_means(vertices, stars, all, smoothing_back);
  }
}

void keep_within(Real farthest, const Points& start, Points& vertices) {
  for (Index v = 0; v < vertices.cols(); ++v) {
    const Vec3 moved = vertices.col(v) - start.col(v);
    if (moved.norm() > farthest) vertices.col(v) = start.col(v) + moved.normalized() * farthest;
  }
}

}  // namespace gracilis
