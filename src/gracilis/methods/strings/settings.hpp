#pragma once

#include <gracilis/scene/setting_table.hpp>
#include <gracilis/strings/string_settings.hpp>

namespace gracilis {

/// A row for each setting.
template <>
std::span<const Setting<strings::StringSettings>> setting_table();

}  // namespace gracilis
