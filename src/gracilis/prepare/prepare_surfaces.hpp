#pragma once

#include <gracilis/scene/preparation.hpp>

namespace gracilis {

/// Repairs, remeshes and pulls apart: a PrepareFunction (scene/preparation.hpp). Bones stay as they are. Throws
/// InputError when a surface cannot be repaired.
PreparedSurfaces prepare_surfaces(const std::vector<NamedSurface>& muscles, const std::vector<NamedSurface>& bones,
                                  const PrepareSettings& settings, const std::function<void(const std::string&)>& say);

}  // namespace gracilis
