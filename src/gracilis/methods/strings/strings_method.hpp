#pragma once

#include <gracilis/geometry/distance_field.hpp>
#include <gracilis/methods/method.hpp>
#include <gracilis/methods/method_entry.hpp>
#include <gracilis/scene/scene.hpp>

#include <memory>
#include <vector>

namespace gracilis {

/// Each muscle as its fibers, pulled tight among the bones (docs/mathematics.md, "Taut strings"), and the surface that
/// follows them with its volume at rest. Muscles know nothing of each other. Where strings have two ways around a bone
/// they stay on that of the poses before. A muscle that is attached to one body alone, or has no fibers from an origin
/// to an insertion, is carried by its bodies. `far_fields`: one distance field per bone, by
/// strings::far_field_settings. Precondition: the scene is valid.
std::unique_ptr<DeformationMethod> make_strings_method(const Scene& scene, std::vector<DistanceField> far_fields);

/// What others know of the method.
MethodEntry strings_entry();

}  // namespace gracilis
