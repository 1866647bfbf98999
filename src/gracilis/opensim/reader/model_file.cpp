#include <gracilis/opensim/reader/model_file.hpp>

#include <gracilis/core/errors.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace gracilis::opensim {

std::filesystem::path file_beside(const std::filesystem::path& file, std::string named) {
  std::replace(named.begin(), named.end(), '\\', '/');
  if (named.empty()) throw InputError({file.string(), "", "names no file where one is needed", "name it"});
  const std::filesystem::path relative = std::filesystem::path(named).lexically_normal();
  if (relative.is_absolute() || named.find(':') != std::string::npos || *relative.begin() == "..")
    throw InputError({file.string(), "", fmt::format("names the file '{}', which lies outside its folder", named),
                      "put it beside, and name it without its folder"});
  return file.parent_path() / relative;
}

}  // namespace gracilis::opensim
