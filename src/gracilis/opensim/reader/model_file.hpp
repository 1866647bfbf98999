#pragma once

#include <filesystem>
#include <string>

namespace gracilis::opensim {

/// The file that an OpenSim file names, in its own folder or below it; Windows' separators are understood. Throws
/// InputError where no file is named, or one outside the folder.
std::filesystem::path file_beside(const std::filesystem::path& file, std::string named);

}  // namespace gracilis::opensim
