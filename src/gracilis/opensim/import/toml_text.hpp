#pragma once

#include <gracilis/core/types.hpp>

#include <fmt/format.h>

#include <string>

namespace gracilis::opensim {

/// As TOML has it. What is no character to see becomes a space.
inline std::string toml_text(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? ' ' : c;
  }
  return result + "\"";
}

/// [x, y, z] with the shortest numbers that read back as the same bits.
inline std::string toml_vector(const Vec3& v) { return fmt::format("[{}, {}, {}]", v.x(), v.y(), v.z()); }

}  // namespace gracilis::opensim
