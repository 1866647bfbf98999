#pragma once

#include <gracilis/opensim/export/arm_courses.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace gracilis {

/// A page that stands alone: by coordinate, arms of each muscle by the model's own paths and by the exported ones, as
/// charts under a table of their differences. `lines` are said under the heading. Throws InputError.
void write_arm_page(const std::filesystem::path& path, const std::string& heading,
                    const std::vector<std::string>& lines, const std::vector<opensim::ArmCourse>& courses);

}  // namespace gracilis
