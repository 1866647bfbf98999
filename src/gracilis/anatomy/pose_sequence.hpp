#pragma once

#include <gracilis/scene/motion.hpp>
#include <gracilis/scene/pose.hpp>
#include <gracilis/scene/scene.hpp>

#include <vector>

namespace gracilis {

/// The poses of all frames of a run: frame 0 is the capture pose; a ramp leads to the motion's first row; then come the
/// frames that hold it while muscles settle, the motion's rows, the frames that hold the last one, and, where the scene
/// asks for it, a ramp back to the capture pose.
///
/// A ramp moves all coordinates in equal steps. It takes `Sequence::ramp_frames` frames, the last of which is the pose
/// it leads to; 0 means as many as it takes for no coordinate to change by more than 1 degree in a frame, not counting
/// those of a joint that carries all bones and attachments, as the pelvis' on the ground; and none where the pose is
/// the capture pose already. The motion's rows keep their times; the frames before and after them follow at the
/// motion's mean spacing (1/60 s for a single row), so the capture pose usually has a negative time. Coordinates that
/// the motion does not name keep their capture value. Every pose says how active the muscles are. A motion without rows
/// leaves frame 0 alone. Requires a scene in which `validate` finds nothing. Throws ConfigurationError, before it makes
/// any, where there are more than `max_frames`.
std::vector<Pose> pose_sequence(const Scene& scene, int max_frames = default_max_frames);

/// How many frames of pose_sequence are what, in their order.
struct SequenceParts {
  int ramp = 0;    ///< from the capture pose (frame 0, counted here) to the motion's first row
  int settle = 0;  ///< that hold the first row before the motion begins
  int motion = 1;  ///< the motion's rows; 1 where there is no motion
  int hold = 0;    ///< that hold the last row
  int back = 0;    ///< back to the capture pose

  int first_of_motion() const { return ramp + settle; }               ///< the frame that shows the motion's first row
  int count() const { return ramp + settle + motion + hold + back; }  ///< of all frames
};
/// Throws ConfigurationError where there are more than `max_frames` in all.
SequenceParts sequence_parts(const Scene& scene, int max_frames = default_max_frames);

/// The frames of a sequence to record: every n-th (of the motion's rows, where the ramps are left out) and the last;
/// frame 0 always, since it is what all others are compared with. Precondition: every >= 1.
std::vector<int> recorded_frames(const SequenceParts& parts, int every, bool with_ramps);

}  // namespace gracilis
