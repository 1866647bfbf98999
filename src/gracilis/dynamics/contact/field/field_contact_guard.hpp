#pragma once

#include <gracilis/dynamics/contact/field/field_contact.hpp>

namespace gracilis {

/// Where a particle may be that wants to be at `q` (obstacle's frame) and was at `last`, by the set's guard; `gap` is
/// its gap now.
Eigen::Vector3f guarded(const FieldContactSet& set, const Sighting& last, const Eigen::Vector3f& q, float gap);

}  // namespace gracilis
