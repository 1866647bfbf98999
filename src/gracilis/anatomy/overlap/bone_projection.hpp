#pragma once

#include <gracilis/geometry/distance_field.hpp>
#include <gracilis/scene/pose.hpp>
#include <gracilis/scene/scene.hpp>

#include <vector>

namespace gracilis {

/// Keeps the free vertices of one muscle, or other points, out of bones, for methods that push points only: along the
/// gradient of the bone's distance field to the gap that each keeps.
class BoneProjection {
 public:
  /// Of no points.
  BoneProjection() = default;

  /// Gaps are `margin` (m) or, with `rest_gap`, what there is in the capture pose where that is less. `fixed_body` is
  /// -1 for free vertices; `fields` (of all bones of the scene) must outlive this.
  BoneProjection(const Scene& scene, const Muscle& muscle, const std::vector<Index>& fixed_body,
                 const std::vector<DistanceField>& fields, Real margin, bool rest_gap);

  /// The same for points that lie at `rest` in the capture pose (3 × n, m), each with a margin of its own.
  BoneProjection(const Scene& scene, const Points& rest, const std::vector<Index>& fixed_body,
                 const std::vector<DistanceField>& fields, const std::vector<Real>& margins, bool rest_gap);

  /// Pushes `points` out of the bones as they lie in `pose`, bone after bone. Returns how many pushes that took.
  Index push_out(const Pose& pose, Points& points) const;

  /// Takes `points` that are in bones back on the straight way to where they `began`, as far as they must; those that
  /// cannot be brought out so end where they began. Bone after bone; returns how many went back.
  Index take_back(const Pose& pose, const Points& began, Points& points) const;

  /// Where a bone has moved over a vertex: its place in `points` becomes that in `before`, moved as the bone is from
  /// pose `last` to pose `now`. Returns how many vertices were taken along.
  Index take_along(const Pose& last, const Pose& now, const Points& before, Points& points) const;

 private:
  struct PerBone {
    Index body = 0;
    FieldGrid field;
    std::vector<float> gap;  ///< m, per vertex; -infinity for fixed ones
  };
  std::vector<PerBone> bones_;
};

}  // namespace gracilis
