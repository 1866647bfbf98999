#pragma once

#include <gracilis/scene/scene.hpp>

#include <string>
#include <string_view>

namespace gracilis {

/// The surfaces of a scene's bones and muscles and which vertices are attached, bit by bit as this machine has them in
/// memory. So that a built-in scene need be shaped but once: this program's build does it (src/CMakeLists.txt).
std::string written_surfaces(const Scene& scene);

/// Puts them into a scene of the same bones, muscles and attachments. Precondition: `bytes` were written for such a
/// scene.
void put_surfaces(std::string_view bytes, Scene& scene);

}  // namespace gracilis
