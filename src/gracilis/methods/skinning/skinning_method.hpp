#pragma once

#include <gracilis/methods/method_entry.hpp>

#include <memory>

namespace gracilis {

/// The method `skinning`: what other methods are compared with.
MethodEntry skinning_entry();

/// Each vertex follows the blend of its bodies' motions by its skinning weights (anatomy/attachments/skinning_weights.hpp), and
/// nothing else: no contact, no volume, no memory. Muscles that are attached to nothing stay where they are.
/// Precondition: the scene is valid.
std::unique_ptr<DeformationMethod> make_skinning_method(const Scene& scene);

}  // namespace gracilis
