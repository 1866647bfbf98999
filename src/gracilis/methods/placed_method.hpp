#pragma once

#include <gracilis/methods/method.hpp>

#include <memory>

namespace gracilis {

/// A method for a scene that stands at `place` in its frame, from one that was prepared for the same scene shifted by
/// -place: near the origin, where single precision is fine enough.
std::unique_ptr<DeformationMethod> placed_method(const Vec3& place, std::unique_ptr<DeformationMethod> method);

}  // namespace gracilis
