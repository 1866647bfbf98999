#pragma once

#include <gracilis/geometry/distance_field.hpp>
#include <gracilis/methods/method.hpp>
#include <gracilis/scene/scene.hpp>

#include <functional>
#include <memory>
#include <vector>

namespace gracilis {

/// Gives the distance fields of all bones of a scene, one each, with the settings asked for.
using BoneFieldSource = std::function<std::vector<DistanceField>(const DistanceFieldSettings&)>;

/// The method that a scene asks for. `fields` are called for only where it looks at bones. Precondition: the scene is
/// valid.
std::unique_ptr<DeformationMethod> make_scene_method(const Scene& scene, const BoneFieldSource& fields);

}  // namespace gracilis
