#pragma once

#include <gracilis/scene/frame.hpp>
#include <gracilis/scene/scene.hpp>
#include <gracilis/view/pictures/picture.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace gracilis {

/// The frames that tell a motion's story: the capture pose, the pose farthest from it (largest angle of any coordinate)
/// and the first one half way there; ascending, each once. `frame_count` limits them to those on disk.
std::vector<int> preview_frames(const std::vector<Pose>& poses, int frame_count);

/// A panel for each of these frames of all that are at `poses`. The camera looks from the outside along the axis about
/// which the bones turn most, or along the joint's first axis where that one is upright, with the moving bones down at
/// the capture pose.
Picture preview_picture(const Scene& scene, const std::vector<Pose>& poses, const std::vector<Frame>& frames);

/// Where a preview's camera looks, and what is up in it; the manifest keeps it, so that later pictures look the same
/// way.
struct CameraDirection {
  Vec3 looking = Vec3::UnitY(), up = Vec3::UnitZ();
};
/// Along the joint's axis about which these poses turn the bones most; see preview_picture.
CameraDirection preview_camera(const Scene& scene, const std::vector<Pose>& poses);

/// Reads the frames back from the run folder and writes its preview.png. Throws Error; exit code 4 says that this
/// machine offers no OpenGL.
void write_preview(const std::filesystem::path& run_folder, const Scene& scene, const std::vector<Pose>& poses);

}  // namespace gracilis
