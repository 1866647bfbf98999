#pragma once

#include <string>
#include <string_view>

namespace gracilis {

/// Bytes as text (RFC 4648).
std::string base64(std::string_view bytes);

/// Text as it may stand inside of an element.
std::string in_element(std::string_view text);

/// Puts a text where the template says {{name}}. Precondition: it says so.
void fill(std::string& page, const std::string& name, std::string_view text);

}  // namespace gracilis
