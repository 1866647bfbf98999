#pragma once

#include <gracilis/geometry/distance_field.hpp>
#include <gracilis/methods/method_entry.hpp>
#include <gracilis/scene/scene.hpp>

#include <memory>
#include <vector>

namespace gracilis {

/// The method `xpbd`: extended position based dynamics on muscle surfaces.
MethodEntry xpbd_entry();

/// Extended position based dynamics on muscle surfaces (Havlíček 2024, with the additions that docs/architecture.md
/// lists). `fields` has one distance field per bone, `far_fields` those by strings::far_field_settings, which are built
/// where none are given and needs_far_fields says so. Precondition: the scene is valid.
std::unique_ptr<DeformationMethod> make_xpbd_method(const Scene& scene, std::vector<DistanceField> fields,
                                                    std::vector<DistanceField> far_fields = {});

/// Whether any muscle of the scene is carried by strings, which look further around bones than contact does.
bool needs_far_fields(const Scene& scene);

}  // namespace gracilis
