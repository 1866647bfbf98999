#include <gracilis/opensim/import/edge_clearance.hpp>

#include <algorithm>

namespace gracilis::opensim {

static constexpr int drawing_rounds = 30;
static constexpr Real least_drawn = 0.4;     // of a ray's length
static constexpr Real shortest_step = 1e-3;  // m, along an edge
static constexpr Real touching = 2e-4;       // m; an edge that is no deeper than this in a bone stays

namespace {

/// An edge's deepest point.
struct DeepPoint {
  Real share = 0;  ///< of the way from its begin to its end
  Real depth = 0;  ///< m, in a bone; 0 where it is in none
};

/// Goes as far as nothing can be deeper than what was found: distances change by no more than the way.
DeepPoint deepest_point(const Vec3& from, const Vec3& to, const std::vector<SolidBone>& bones) {
  const Real length = (to - from).norm();
  DeepPoint deepest;
  for (Real way = 0; way < length;) {
    const Real depth = -distance_to(bones, from + way / length * (to - from), length);
    if (depth > deepest.depth) deepest = {way / length, depth};
    way += std::max(deepest.depth - depth, shortest_step);
  }
  return deepest;
}

}  // namespace

Eigen::MatrixXd drawn_off_ridges(const SectionRays& rays, Eigen::MatrixXd lengths,
                                 const std::vector<SolidBone>& bones) {
  const Eigen::Index count = lengths.rows(), sections = lengths.cols();
  const Eigen::MatrixXd shortest = least_drawn * lengths;
  Eigen::MatrixXd moved = Eigen::MatrixXd::Ones(count, sections);
  for (int round = 0; round < drawing_rounds && !moved.isZero(0); ++round) {
    const Points corners = SectionRays{rays.feet, rays.directions, lengths}.corners();
    Eigen::VectorXd by = Eigen::VectorXd::Zero(corners.cols());
    // The shortest way in of both ends that brings an edge out, were they to go straight away from the bone.
    const auto look = [&](Eigen::Index a, Eigen::Index b) {
      if (moved(a) == 0 && moved(b) == 0) return;
      const DeepPoint deep = deepest_point(corners.col(a), corners.col(b), bones);
      if (!(deep.depth > touching)) return;
      const Real of_a = 1 - deep.share, of_b = deep.share, both = of_a * of_a + of_b * of_b;
      by[a] = std::max(by[a], of_a / both * deep.depth);
      by[b] = std::max(by[b], of_b / both * deep.depth);
    };
    for (Eigen::Index k = 1; k + 1 < sections; ++k)
      for (Eigen::Index i = 0; i < count; ++i) {
        const Eigen::Index corner = k * count + i, beside = k * count + (i + 1) % count;
        look(corner, beside);
        if (k + 2 == sections) continue;
        look(corner, corner + count);
        look(corner, beside + count);
      }
    const Eigen::MatrixXd before = lengths;
    lengths.middleCols(1, sections - 2) -= by.reshaped(count, sections).middleCols(1, sections - 2);
    lengths = lengths.cwiseMax(shortest);
    moved = before - lengths;
  }
  return lengths;
}

}  // namespace gracilis::opensim
