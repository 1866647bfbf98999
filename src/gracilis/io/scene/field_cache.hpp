#pragma once

#include <gracilis/geometry/distance_field.hpp>
#include <gracilis/io/cache_file.hpp>
#include <gracilis/scene/scene.hpp>

#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

namespace gracilis {

/// $XDG_CACHE_HOME/gracilis, or ~/.cache/gracilis; empty where neither variable is set.
std::filesystem::path default_cache_folder();

/// The distance field of a bone, read from `folder` when it was built before from the same surface with the same
/// settings (by the hash of their bytes), otherwise built by `build_bone_field` and kept there. A folder that cannot be
/// written costs only the time to build, and so does a damaged file, of which `warn` is told. An empty folder keeps
/// nothing.
DistanceField cached_bone_field(const Bone& bone, const DistanceFieldSettings& settings,
                                const std::filesystem::path& folder, const WarnFunction& warn = {});
/// The field that a file of the cache holds behind its seal; nothing where these bytes are none.
std::optional<DistanceField> parse_field(std::string_view content);
/// Those of all bones of a scene, in their order, by the scene's settings or by others; kept in the default folder.
std::vector<DistanceField> cached_bone_fields(const Scene& scene);
/// The same by these settings; what is wrong with the cache goes to `warn`.
std::vector<DistanceField> cached_bone_fields(const Scene& scene, const DistanceFieldSettings& settings,
                                              const WarnFunction& warn = {});

}  // namespace gracilis
