#pragma once

#include <gracilis/methods/method_entry.hpp>

#include <memory>
#include <vector>

namespace gracilis {

/// The method `pbd` (Cervenka and Kohout 2020).
MethodEntry pbd_entry();

/// Position based dynamics of surfaces: edges keep their lengths, more softly along the fibers, triangles their angles,
/// the surface its volume, and vertices stay out of bones; muscles do not see each other. Bodies move first, and with
/// them what is attached. `fields` are those of the scene's bones; none are needed
/// where all muscles collide by voxels. Precondition: the scene is valid.
std::unique_ptr<DeformationMethod> make_pbd_method(const Scene& scene, std::vector<DistanceField> fields);

}  // namespace gracilis
