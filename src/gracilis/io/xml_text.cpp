#include <gracilis/io/xml_text.hpp>

#include <gracilis/core/errors.hpp>

#include <algorithm>
#include <new>

namespace gracilis {

void parse_xml(const std::filesystem::path& path, const std::string& text, const std::string& what,
               const std::string& remedy, pugi::xml_document& document) {
  const pugi::xml_parse_result result =
      document.load_buffer(text.data(), text.size(), pugi::parse_default, pugi::encoding_utf8);
  if (result) return;
  if (result.status == pugi::status_out_of_memory) throw std::bad_alloc();
  const auto line = 1 + std::count(text.begin(), text.begin() + result.offset, '\n');
  throw InputError({path.string(), std::to_string(line), what + ": " + result.description(), remedy});
}

}  // namespace gracilis
