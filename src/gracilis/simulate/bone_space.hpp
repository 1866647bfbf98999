#pragma once

#include <gracilis/geometry/lazy_field.hpp>
#include <gracilis/scene/scene.hpp>

#include <vector>

namespace gracilis {

/// The space around a scene's bones as the measures of a muscle's way see it. Cells are 3 mm, so bones thinner than
/// that are not seen well.
class BoneSpace {
 public:
  /// `exact` are the distances to the scene's bones in their order. Both must outlive this.
  BoneSpace(const Scene& scene, const std::vector<SignedDistance>& exact);

  std::size_t count() const { return fields_.size(); }                ///< of bones
  std::size_t body(std::size_t bone) const { return bodies_[bone]; }  ///< number of its body in the scene

  /// See LazyField; at a point in the bone's frame, that of the capture pose.
  FieldSample sample(std::size_t bone, const Vec3& local) const { return fields_[bone].sample(local); }

 private:
  std::vector<LazyField> fields_;
  std::vector<std::size_t> bodies_;
};

}  // namespace gracilis
