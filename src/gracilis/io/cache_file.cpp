#include <gracilis/io/cache_file.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/io/atomic_file.hpp>
#include <gracilis/io/content_hash.hpp>
#include <gracilis/io/input_file.hpp>

namespace gracilis {

namespace fs = std::filesystem;

/// Over the name too, which is the hash of what the content was made of.
static std::string seal(const fs::path& path, std::string_view content) {
  return content_hash_of(path.stem().string() + content_hash_of(content));
}

void write_cache_file(const fs::path& path, std::string_view format, const std::string& content) {
  remove_left_temporaries(path.parent_path(), LeftBy::own_machine);
  write_text_atomically(path, std::string(format) + "\n" + seal(path, content) + "\n" + content);
}

void warn_of_cache_file(const fs::path& path, const std::string& why, const WarnFunction& warn) {
  if (warn) warn(path.string() + ": " + why + "; made anew");
}

std::optional<std::string> read_cache_file(const fs::path& path, std::string_view format, const WarnFunction& warn) {
  std::string bytes;
  try {
    if (!is_there(path)) return std::nullopt;
    bytes = read_text(path);
  } catch (const InputError& error) {
    warn_of_cache_file(path, "cannot be read", warn);
    return std::nullopt;
  }
  const std::size_t seal_at = format.size() + 1, content_at = seal_at + seal(path, "").size() + 1;
  const std::string_view view(bytes);
  const bool is_whole = bytes.size() >= content_at && view.starts_with(format) && bytes[seal_at - 1] == '\n' &&
                        view.substr(seal_at, content_at - seal_at - 1) == seal(path, view.substr(content_at)) &&
                        bytes[content_at - 1] == '\n';
  if (!is_whole) {
    warn_of_cache_file(path, "is damaged", warn);
    return std::nullopt;
  }
  return bytes.substr(content_at);
}

}  // namespace gracilis
