#include <gracilis/transfer/bone_registration.hpp>

#include <gracilis/core/median.hpp>
#include <gracilis/geometry/rbf_centers.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace gracilis {
namespace {

/// A level of the deformation: how many places steer it, what bending costs, and what a distance along the surface does
/// in comparison with one across it. Coarse levels let surfaces slide along each other; fine ones, where everything is
/// about at its place, do not, and their three coordinates are solved one by one.
struct Level {
  Index centers;
  Real stiffness, along_surface;
  int rounds;
};
constexpr std::array<Level, 5> levels = {
    {{20, 1e-2, 0.05, 10}, {40, 1e-3, 0.05, 10}, {80, 1e-4, 0.05, 10}, {160, 1e-5, 1, 8}, {240, 1e-6, 1, 8}}};

constexpr Real facing = 0.5;       // cosine
constexpr Real least_gain = 0.98;  // of a round; with less the next level begins

/// The middle one of those between surfaces that face the same way.
Real typical_distance(const PlacePairs& pairs) {
  std::vector<Real> distances;
  for (Index i = 0; i < pairs.count(); ++i)
    if (pairs.faces_alike(i, facing)) distances.push_back(pairs.distances[i]);
  return median(std::move(distances));
}

/// Where distances become outliers: Tukey's 4.685 times what the deviation of a normal distribution would be (Huber
/// 1981); never below a thousandth of the size, which is no distance of bones.
Real outlier_distance(const PlacePairs& pairs, Real size) {
  return std::max(4.685 * 1.4826 * typical_distance(pairs), 1e-3 * size);
}

/// Each with Tukey's weight, named points together half of all.
PlaceTargets targets_of(const PlacePairs& pairs, const NamedPoints& named, Real size, Real along_surface) {
  const Index n = pairs.count(), all = n + named.count();
  PlaceTargets targets{Points(3, all), Points(3, all), Points::Zero(3, all), Eigen::VectorXd::Zero(all), along_surface};
  targets.points << pairs.from, named.from;
  targets.places << pairs.to, named.to;
  targets.normals.leftCols(n) = pairs.to_normals;
  const Real far = outlier_distance(pairs, size);
  for (Index i = 0; i < n; ++i) {
    const Real share = pairs.distances[i] / far;
    if (share < 1 && pairs.faces_alike(i, facing)) targets.weights[i] = std::pow(1 - share * share, 2);
  }
  if (named.count() > 0) targets.weights.tail(named.count()).setConstant(targets.weights.sum() / named.count());
  return targets;
}

}  // namespace

BoneFit measure_fit(const PairedBone& bone, const Points& moved) {
  const PlacePairs pairs = bone.pairs(moved);
  const Real far = std::max(outlier_distance(pairs, extent_of(bone.to_points())), 1e-2 * extent_of(bone.to_points()));
  BoneFit fit;
  std::array<Real, 2> squares = {0, 0};
  std::array<Index, 2> counted = {0, 0}, total = {0, 0};
  std::vector<Real> kept;
  for (Index i = 0; i < pairs.count(); ++i) {
    const std::size_t way = i < pairs.of_template ? 0 : 1;
    const Real distance = pairs.distances[i];
    ++total[way];
    fit.all += distance * distance / pairs.count();
    if (distance > far) continue;
    ++counted[way];
    squares[way] += distance * distance;
    kept.push_back(distance);
  }
  const auto mean = [&](std::size_t way) { return std::sqrt(squares[way] / std::max<Index>(1, counted[way])); };
  const auto lacking = [&](std::size_t way) {
    return 1 - static_cast<Real>(counted[way]) / std::max<Index>(1, total[way]);
  };
  std::sort(kept.begin(), kept.end());
  fit.to_subject = mean(0);
  fit.to_template = mean(1);
  fit.all = std::sqrt(fit.all);
  fit.trimmed_template = lacking(0);
  fit.trimmed_subject = lacking(1);
  if (kept.empty()) return fit;
  fit.p95 = kept[static_cast<std::size_t>(0.95 * static_cast<Real>(kept.size() - 1))];
  fit.worst = kept.back();
  return fit;
}

RegisteredBone register_bone(const PairedBone& bone, const NamedPoints& named, const Similarity& start) {
  RegisteredBone result;
  const SimilarityFit similar = closest_similarity({&bone}, named, start);
  const Real size = extent_of(bone.to_points());
  result.similarity = similar.similarity;
  result.similar = similar.error * size;
  result.map = ThinPlateMap::affine(result.similarity.linear(), result.similarity.shift);
  Points moved = result.map.at(bone.from().vertices);
  for (const Level& level : levels) {
    const Points centers = spread_out(bone.from_points(), level.centers);
    const ThinPlateBasis basis(centers);
    Real last = std::numeric_limits<Real>::infinity();
    for (int round = 0; round < level.rounds; ++round) {
      const PlacePairs pairs = bone.pairs(moved);
      const Real distance = typical_distance(pairs);
      if (distance > least_gain * last) break;
      last = distance;
      result.map = fit_thin_plate(basis, targets_of(pairs, named, size, level.along_surface), level.stiffness);
      moved = result.map.at(bone.from().vertices);
    }
  }
  result.fit = measure_fit(bone, moved);
  return result;
}

}  // namespace gracilis
