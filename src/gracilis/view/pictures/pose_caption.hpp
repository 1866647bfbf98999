#pragma once

#include <gracilis/io/run/recorded_run.hpp>
#include <gracilis/scene/frame.hpp>
#include <gracilis/scene/scene.hpp>

#include <string>
#include <vector>

namespace gracilis {

/// What captions tell of a run's frames, the first of which is the capture pose.
struct CaptionedFrames {
  std::vector<CoordinateLabel> coordinates;
  Eigen::MatrixXd values;      ///< frames × coordinates, as people read them
  std::vector<Real> times;     ///< s, per frame
  int first_motion_frame = 0;  ///< those before it lead from the capture pose to the motion
};

/// Of all frames of a run.
CaptionedFrames captioned_frames(const RecordedRun& run);

/// Of the poses of all frames of a scene.
CaptionedFrames captioned_frames(const Scene& scene, const std::vector<Pose>& poses);

/// "capture pose" for frame 0; else the coordinate that moves most and what else has left the capture pose, as in
/// "hip flexion r 45°"; "0.15 s" in runs in which more move than a caption has room for.
std::string pose_words(const CaptionedFrames& frames, int frame);

/// The same with the frame's number before a time, as in "frame 9, 0.15 s": for pictures, which tell it nowhere else.
std::string pose_caption(const CaptionedFrames& frames, int frame);

/// The same of a scene that is moved live, whose end nobody knows: the first coordinate and all that have left the
/// capture pose.
std::string pose_caption(const Scene& scene, const Frame& frame);

}  // namespace gracilis
