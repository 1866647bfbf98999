#pragma once

#include <gracilis/scene/scene.hpp>

#include <utility>

namespace gracilis {

/// What a slider of a coordinate goes through (rad, m): its range, but 120 degrees or 100 mm each way at most;
/// the capture pose always.
std::pair<Real, Real> slider_range(const JointAxis& axis);

}  // namespace gracilis
