#pragma once

#include <gracilis/geometry/distance_field.hpp>
#include <gracilis/methods/method.hpp>
#include <gracilis/scene/scene.hpp>

#include <functional>
#include <memory>
#include <vector>

namespace gracilis {

/// A method for a scene that stands at `place` in its frame, from one that was prepared for the same scene shifted by
/// -place: near the origin, where single precision is fine enough.
std::unique_ptr<DeformationMethod> placed_method(const Vec3& place, std::unique_ptr<DeformationMethod> method);

/// What `make` makes of the scene and its bones' fields, brought near the origin for it where they are far.
std::unique_ptr<DeformationMethod> made_near_origin(
    const Scene& scene, std::vector<DistanceField> fields,
    const std::function<std::unique_ptr<DeformationMethod>(const Scene&, std::vector<DistanceField>)>& make);

}  // namespace gracilis
