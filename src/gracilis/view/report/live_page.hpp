#pragma once

#include <gracilis/scene/scene.hpp>

#include <filesystem>

namespace gracilis {

/// Writes a page for the browser that moves a scene: a copy of `page`, which is gracilis.html (web/), with the scene
/// inside. Throws InputError where that is not such a page or cannot be read, or `out` cannot be written.
void write_live_page(const std::filesystem::path& out, const std::filesystem::path& page, const Scene& scene);

}  // namespace gracilis
