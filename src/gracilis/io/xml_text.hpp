#pragma once

#include <pugixml.hpp>

#include <filesystem>
#include <string>

namespace gracilis {

/// The text of a file as XML, read as UTF-8 whatever it says: of another encoding pugixml parses a longer copy, and an
/// error's place in that is none in the text. Throws InputError at the line where it is none, `what` before the
/// reason, as in "is not XML"; and std::bad_alloc.
void parse_xml(const std::filesystem::path& path, const std::string& text, const std::string& what,
               const std::string& remedy, pugi::xml_document& document);

}  // namespace gracilis
