#pragma once

#include <gracilis/methods/method_entry.hpp>

#include <memory>

namespace gracilis {

/// The method `tissue`: muscles as volumes whose fibers are under tension.
MethodEntry tissue_entry();

/// Each muscle alone is a lattice of tetrahedra at the least of its energy: fibers that pull, the matrix between them,
/// volume, springs at attachments, fascia and contact with bones (docs/mathematics.md). In the capture pose the input
/// is given as it is; in the frames after it the fibers' tension comes up. `fields` has one distance field per bone.
/// Precondition: the scene is valid.
std::unique_ptr<DeformationMethod> make_tissue_method(const Scene& scene, std::vector<DistanceField> fields);

}  // namespace gracilis
