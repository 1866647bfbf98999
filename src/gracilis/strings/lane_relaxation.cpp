#include <gracilis/strings/lane_relaxation.hpp>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "gracilis/strings/lane_relaxation.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, as Highway asks.
#include <gracilis/strings/lane_step-inl.hpp>

HWY_BEFORE_NAMESPACE();
namespace gracilis::HWY_NAMESPACE {

using strings::BoneDistances;
using strings::LanePlaces;
using strings::MuscleStrings;
using strings::Relaxation;

void relax_lanes(const MuscleStrings& muscle, const BoneDistances& bones, const std::vector<RigidTransform>& bodies,
                 const Relaxation& relaxation, LaneWorkspace& workspace, LanePlaces& places) {
  LanePose(muscle, bones, bodies, workspace).begin(places);
  LaneSteps(muscle, bones, workspace).relax(relaxation);
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t at = 0; at < places[axis].size(); ++at)
      places[axis][at] += static_cast<double>(workspace.moved[axis][at]);
}

}  // namespace gracilis::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gracilis {

HWY_EXPORT(relax_lanes);

namespace strings {

std::vector<float> relax_lanes(const MuscleStrings& muscle, const BoneDistances& bones,
                               const std::vector<RigidTransform>& bodies, const Relaxation& relaxation,
                               LanePlaces& places) {
  // Kept between calls: to ask for its memory each time takes as long as an iteration.
  static thread_local LaneWorkspace workspace;
  HWY_DYNAMIC_DISPATCH(relax_lanes)(muscle, bones, bodies, relaxation, workspace, places);
  return {workspace.last_move.begin(), workspace.last_move.begin() + muscle.strings};
}

}  // namespace strings
}  // namespace gracilis
#endif
