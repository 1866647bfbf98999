#pragma once

#include <gracilis/geometry/distance_field.hpp>
#include <gracilis/methods/method.hpp>
#include <gracilis/scene/scene.hpp>

#include <functional>
#include <memory>
#include <vector>

namespace gracilis {

/// The method that a scene asks for. `fields`, one distance field per bone, are called for only where it looks at
/// bones. Precondition: the scene is valid.
std::unique_ptr<DeformationMethod> make_scene_method(const Scene& scene,
                                                     const std::function<std::vector<DistanceField>()>& fields);

}  // namespace gracilis
