#include <gracilis/transfer/similarity.hpp>

#include <gracilis/geometry/principal_axes.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis {
namespace {

Points joined(const std::vector<const PairedBone*>& bones, const Points& (PairedBone::*points)() const) {
  Index count = 0;
  for (const PairedBone* bone : bones) count += static_cast<Index>((bone->*points)().cols());
  Points all(3, count);
  Index at = 0;
  for (const PairedBone* bone : bones) {
    const Points& some = (bone->*points)();
    all.middleCols(at, some.cols()) = some;
    at += static_cast<Index>(some.cols());
  }
  return all;
}

/// As right-handed columns, the longest first.
Eigen::Matrix3d principal_frame(const Points& points) {
  Eigen::Matrix3d axes = spread_of(points).directions.rowwise().reverse();
  if (axes.determinant() < 0) axes.col(2) = -axes.col(2);
  return axes;
}

/// Of all pairs those nearest to each other.
struct Kept {
  Points from, to;
  Real error = 0;  ///< m
};

Kept nearest_pairs(const std::vector<PlacePairs>& all, bool facing) {
  struct Ranked {
    Real distance;
    std::size_t bone;
    Index pair;
  };
  std::vector<Ranked> ranked;
  std::size_t total = 0;
  for (std::size_t b = 0; b < all.size(); ++b)
    for (Index i = 0; i < all[b].count(); ++i) {
      ++total;
      if (!facing || all[b].faces_alike(i, 0)) ranked.push_back({all[b].distances[i], b, i});
    }
  std::stable_sort(ranked.begin(), ranked.end(), [](auto& a, auto& b) { return a.distance < b.distance; });
  ranked.resize(std::min(ranked.size(), static_cast<std::size_t>(counted_share * static_cast<Real>(total))));
  const auto n = static_cast<Index>(ranked.size());
  Kept kept{Points(3, n), Points(3, n)};
  for (Index i = 0; i < n; ++i) {
    const Ranked& each = ranked[static_cast<std::size_t>(i)];
    kept.from.col(i) = all[each.bone].from.col(each.pair);
    kept.to.col(i) = all[each.bone].to.col(each.pair);
    kept.error += each.distance * each.distance;
  }
  kept.error = std::sqrt(kept.error / std::max<Index>(n, 1));
  return kept;
}

std::vector<PlacePairs> pairs_of(const std::vector<const PairedBone*>& bones, const Similarity& at) {
  std::vector<PlacePairs> all;
  for (const PairedBone* bone : bones) all.push_back(bone->pairs(at.linear(), at.shift));
  return all;
}

/// Umeyama 1991; named points repeated until they are as many as the others.
Similarity least_squares(const Kept& kept, const NamedPoints& named) {
  const Index n = static_cast<Index>(kept.from.cols());
  const Index times = named.count() > 0 ? std::max<Index>(1, n / named.count()) : 0;
  Points from(3, n + times * named.count()), to(3, from.cols());
  from << kept.from, named.from.replicate(1, times);
  to << kept.to, named.to.replicate(1, times);
  const Eigen::Matrix4d motion = Eigen::umeyama(from, to, true);
  Similarity result;
  result.scale = std::cbrt(motion.topLeftCorner<3, 3>().determinant());
  result.rotation = motion.topLeftCorner<3, 3>() / result.scale;
  result.shift = motion.topRightCorner<3, 1>();
  return result;
}

}  // namespace

SimilarityFit closest_similarity(const std::vector<const PairedBone*>& bones, const NamedPoints& named,
                                 const Similarity& start) {
  constexpr int rounds = 60;
  constexpr Real least_gain = 1e-3;
  const Real size = extent_of(joined(bones, &PairedBone::to_points));
  Similarity now = start;
  Real last = std::numeric_limits<Real>::infinity();
  for (int round = 0; round < rounds; ++round) {
    const Kept kept = nearest_pairs(pairs_of(bones, now), true);
    if (kept.from.cols() < 12 || kept.error > (1 - least_gain) * last) break;
    last = kept.error;
    now = least_squares(kept, named);
    if (!(now.scale > 0)) return {start, std::numeric_limits<Real>::infinity()};
  }
  return {now, nearest_pairs(pairs_of(bones, now), false).error / size};
}

Similarity turned(const std::vector<const PairedBone*>& bones, const Eigen::Matrix3d& turn) {
  const Points from = joined(bones, &PairedBone::from_points), to = joined(bones, &PairedBone::to_points);
  Similarity result;
  result.rotation = turn;
  result.scale = extent_of(to) / extent_of(from);
  result.shift = to.rowwise().mean() - result.linear() * from.rowwise().mean();
  return result;
}

std::vector<Eigen::Matrix3d> principal_turns(const std::vector<const PairedBone*>& bones) {
  const Eigen::Matrix3d from = principal_frame(joined(bones, &PairedBone::from_points));
  const Eigen::Matrix3d to = principal_frame(joined(bones, &PairedBone::to_points));
  std::vector<Eigen::Matrix3d> turns;
  for (const Vec3& signs : {Vec3(1, 1, 1), Vec3(1, -1, -1), Vec3(-1, 1, -1), Vec3(-1, -1, 1)})
    turns.push_back(to * signs.asDiagonal() * from.transpose());
  return turns;
}

}  // namespace gracilis
