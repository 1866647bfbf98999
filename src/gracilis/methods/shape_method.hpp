#pragma once

#include <gracilis/geometry/distance_field.hpp>
#include <gracilis/methods/method.hpp>
#include <gracilis/scene/scene.hpp>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace gracilis {

/// Where a muscle's vertices went in one frame.
struct ShapeStep {
  Points points;         ///< world, m
  Metrics metrics = {};  ///< with the names that the method's entry lists
};

/// A muscle whose next shape follows from its last one, from the pose of that and from the next pose, and from nothing
/// else.
struct ShapedMuscle {
  std::string name;
  Points rest;  ///< world, in the capture pose, m
  std::function<ShapeStep(const Pose& last, const Pose& now, const Points& before)> step;
};

/// Prepares one muscle; `fields` (of all bones of the scene) outlive what it makes.
using ShapedMuscleMaker =
    std::function<ShapedMuscle(const Scene& scene, const Muscle& muscle, const std::vector<DistanceField>& fields)>;

/// The method that takes each muscle by its own step, one after the other. `advice` is what to do where a vertex
/// position stops being finite. Precondition: the scene is valid.
std::unique_ptr<DeformationMethod> shape_method(const Scene& scene, std::vector<DistanceField> fields,
                                                const ShapedMuscleMaker& make, std::string advice = "check the pose");

}  // namespace gracilis
