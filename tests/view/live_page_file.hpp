#pragma once

#include <build_paths.hpp>

#include <filesystem>

namespace gracilis {

/// The page for the browser, which is there where clang compiles for WebAssembly (`ninja gracilis_web`).
inline std::filesystem::path live_page() {
  return std::filesystem::path(build_paths::program).parent_path().parent_path() / "gracilis.html";
}

}  // namespace gracilis
