#include <gracilis/transfer/space_warp.hpp>

#include <gracilis/geometry/area_samples.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/rbf_centers.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis {
namespace {

constexpr Index most_centers = 900, least_of_bone = 40;
/// Bones' maps disagree in joints, where their surfaces nearly touch: what bends less than this does not follow them.
constexpr Real stiffness = 1e-6;

/// Centers of one bone, by its share of all bones' area.
Points centers_of(const TriangleMesh& bone, Real share) {
  const Index count = std::max(least_of_bone, static_cast<Index>(std::lround(share * most_centers)));
  const AreaSamples samples = area_samples(bone, 4 * count);
  return spread_out(samples.points(bone.vertices, bone.faces), count);
}

}  // namespace

ThinPlateMap space_warp(const Scene& scene, const SkeletonFit& fit) {
  const auto surface = [&](const FittedBone& bone) -> const TriangleMesh& {
    return scene.bones[static_cast<std::size_t>(bone.match.of_template)].surface;
  };
  Real area = 0;
  for (const FittedBone& bone : fit.bones) area += surface_area(surface(bone).vertices, surface(bone).faces);
  PlaceTargets targets;
  for (const FittedBone& bone : fit.bones) {
    const Points centers = centers_of(surface(bone), surface_area(surface(bone).vertices, surface(bone).faces) / area);
    const Index before = static_cast<Index>(targets.points.cols()), n = static_cast<Index>(centers.cols());
    targets.points.conservativeResize(3, before + n);
    targets.places.conservativeResize(3, before + n);
    targets.points.rightCols(n) = centers;
    targets.places.rightCols(n) = bone.registered.map.at(centers);
  }
  targets.normals = Points::Zero(3, targets.points.cols());
  targets.weights = Eigen::VectorXd::Ones(targets.points.cols());
  return fit_thin_plate(ThinPlateBasis(targets.points), targets, stiffness);
}

}  // namespace gracilis
