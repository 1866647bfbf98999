#pragma once

#include <gracilis/io/cache_file.hpp>
#include <gracilis/scene/preparation.hpp>

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gracilis {

/// The prepared muscles, read from `folder` when they were prepared before from the same surfaces with the same
/// settings by the same version (by the hash of their bytes), otherwise made by `prepare` and kept there with their
/// report. A folder that cannot be written costs only the time, and so does a damaged file, of which `warn` is told.
/// Lines about it go to `say`. Throws ConfigurationError when they are not there and `prepare` is empty, and what
/// `prepare` throws.
std::vector<TriangleMesh> cached_preparation(const std::vector<NamedSurface>& muscles,
                                             const std::vector<NamedSurface>& bones, const PrepareSettings& settings,
                                             const PrepareFunction& prepare,
                                             const std::function<void(const std::string&)>& say,
                                             const std::filesystem::path& folder, const WarnFunction& warn = {});

/// The surfaces of so many muscles that a file of the cache holds behind its seal; nothing where these bytes are none.
std::optional<std::vector<TriangleMesh>> parse_prepared(std::string_view content, std::size_t count);

}  // namespace gracilis
