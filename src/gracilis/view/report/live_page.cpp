#include <gracilis/view/report/live_page.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/io/atomic_file.hpp>
#include <gracilis/io/input_file.hpp>
#include <gracilis/io/scene/scene_bytes.hpp>
#include <gracilis/view/report/html_text.hpp>

#include <string>

namespace gracilis {

void write_live_page(const std::filesystem::path& out, const std::filesystem::path& page, const Scene& scene) {
  const std::string place = "<script type=\"text/plain\" id=\"scene\">";
  std::string text = read_text(page);
  const std::size_t at = text.find(place);
  if (at == std::string::npos)
    throw InputError({page.string(), "", "is no page that takes a scene", "build it again: gracilis_web"});
  text.insert(at + place.size(), base64(scene_bytes(scene)));
  write_text_atomically(out, text);
}

}  // namespace gracilis
