#pragma once

#include <gracilis/dynamics/surface_contact.hpp>
#include <gracilis/methods/xpbd/preparation.hpp>
#include <gracilis/scene/settings.hpp>

#include <vector>

namespace gracilis::xpbd {

/// Which muscles may meet and with what gaps, measured at rest. No pairs when contact is switched off.
SurfaceCrowd prepare_crowd(const ContactSettings& settings, const std::vector<PreparedMuscle>& muscles);

}  // namespace gracilis::xpbd
