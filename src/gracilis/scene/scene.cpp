#include <gracilis/scene/scene.hpp>

namespace gracilis {

template <>
std::span<const Setting<Sequence>> setting_table() {
  using S = Sequence;
  static const Setting<S> table[] = {
      {"ramp_frames", &S::ramp_frames, "", 0, 100000,
       "Frames from the capture pose to the motion's first pose; 0 takes as many as steps of 1 degree need."},
      {"settle_frames", &S::settle_frames, "", 0, 100000,
       "Frames that repeat the motion's first pose before it begins, in which muscles come to rest. 'gracilis rom' "
       "holds 30 where this is 0."},
      {"hold_frames", &S::hold_frames, "", 0, 100000, "Frames that repeat the motion's last pose."},
      {"return_to_capture", &S::return_to_capture, "", 0, 0, "Ends with a ramp back to the capture pose."},
  };
  return table;
}

const MuscleBody* muscle_body(const Scene& scene, Index body) {
  for (const MuscleBody& each : scene.muscle_bodies)
    if (each.body == body) return &each;
  return nullptr;
}

}  // namespace gracilis
