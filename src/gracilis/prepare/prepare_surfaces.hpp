#pragma once

#include <gracilis/core/errors.hpp>
#include <gracilis/scene/preparation.hpp>

namespace gracilis {

/// Repairs, remeshes and pulls apart: a PrepareFunction (scene/preparation.hpp). Bones stay as they are. Throws
/// InputError when a surface cannot be repaired.
PreparedSurfaces prepare_surfaces(const std::vector<NamedSurface>& muscles, const std::vector<NamedSurface>& bones,
                                  const PrepareSettings& settings, const std::function<void(const std::string&)>& say);

/// The same for those muscles that can be prepared, which the result's report names; what is wrong with the others is
/// added to `problems`. Throws InputError only where a bone is at fault.
PreparedSurfaces prepare_possible(const std::vector<NamedSurface>& muscles, const std::vector<NamedSurface>& bones,
                                  const PrepareSettings& settings, const std::function<void(const std::string&)>& say,
                                  std::vector<Problem>& problems);

}  // namespace gracilis
