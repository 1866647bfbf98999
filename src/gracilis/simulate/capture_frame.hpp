#pragma once

#include <gracilis/methods/method.hpp>
#include <gracilis/scene/frame.hpp>
#include <gracilis/scene/scene.hpp>

namespace gracilis {

/// Frame 0: the input surfaces at the capture pose.
Frame capture_frame(const Scene& scene, const Pose& pose);
/// The same, with the fibers that the method knows. Precondition: it stands at the capture pose.
Frame capture_frame(const Scene& scene, const Pose& pose, const DeformationMethod& method);

}  // namespace gracilis
