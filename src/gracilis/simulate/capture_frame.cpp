#include <gracilis/simulate/capture_frame.hpp>

#include <cstddef>
#include <utility>

namespace gracilis {

Frame capture_frame(const Scene& scene, const Pose& pose) {
  Frame frame;
  frame.pose = pose;
  for (const Muscle& muscle : scene.muscles) frame.muscles.push_back({muscle.surface.vertices});
  return frame;
}

Frame capture_frame(const Scene& scene, const Pose& pose, const DeformationMethod& method) {
  Frame frame = capture_frame(scene, pose), written;
  written.pose = pose;
  method.write(written);
  for (std::size_t m = 0; m < frame.muscles.size(); ++m) frame.muscles[m].fibers = std::move(written.muscles[m].fibers);
  return frame;
}

}  // namespace gracilis
