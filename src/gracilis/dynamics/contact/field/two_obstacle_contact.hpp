#pragma once

#include <gracilis/dynamics/contact/field/near_field.hpp>
#include <gracilis/dynamics/particles.hpp>

#include <vector>

namespace gracilis {

/// Particles near two obstacles or more move to where both gaps are kept: along the direction in which both distances
/// grow, out of the gap between them; between parallel surfaces, to the middle. Call after the particles' contacts.
/// Returns how many moved.
Index project_two_obstacle_contact(const std::vector<FieldContactSet>& sets,
                                   const std::vector<FieldPlacement>& placements, const std::vector<NearField>& near,
                                   Particles& particles);

}  // namespace gracilis
