#pragma once

#include <gracilis/core/errors.hpp>
#include <gracilis/scene/preparation.hpp>
#include <gracilis/scene/settings.hpp>

#include <string>
#include <vector>

namespace gracilis {

/// Throws InputError where preparation of the muscles would take hours or all memory, which is seen before it begins: a
/// coordinate that is not finite, or a surface so large, or with edges so long, that triangles of
/// `PrepareSettings::edge_length` were more than two million, or took longer than `PrepareSettings::time_limit`.
void require_affordable(const std::vector<NamedSurface>& muscles, const std::vector<NamedSurface>& bones,
                        const PrepareSettings& settings);

/// What to say of a muscle whose preparation took longer than it may.
Problem out_of_time(const std::string& name, const PrepareSettings& settings);

/// Throws InputError naming two surfaces where more than half of a muscle lies in another muscle or a bone: then its
/// place or unit is wrong, and there is nothing to pull apart. Muscles are closed and oriented outwards.
void require_apart(const std::vector<NamedSurface>& muscles, const std::vector<NamedSurface>& bones);

}  // namespace gracilis
