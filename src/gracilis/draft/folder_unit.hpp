#pragma once

#include <gracilis/draft/found_surfaces.hpp>

namespace gracilis {

/// Sets the unit of a folder's files and the size of its bones: `unit` ("m", "cm" or "mm"), or, without one, that in
/// which the known bones are about as large as a grown person's. Throws InputError, in which `subject` names the files,
/// where no unit is given and no bone is known, or in none of them the bones are as large as bones are.
void set_unit(const FolderFiles& files, const std::filesystem::path& subject, const std::string& unit,
              FoundFolder& found);

}  // namespace gracilis
