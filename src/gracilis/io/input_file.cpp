#include <gracilis/io/input_file.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/core/shell_word.hpp>
#include <gracilis/io/text_cells.hpp>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>

namespace gracilis {

namespace fs = std::filesystem;

std::string run_folder_advice(const fs::path& folder) {
  const std::string run = shell_word(folder.string());
  return "`gracilis report " + run + "`, `gracilis view " + run + "` and `gracilis render " + run + "` show it";
}

void require_readable_file(const fs::path& path) {
  const auto fail = [&](const std::string& what, const std::string& remedy) {
    throw InputError({path.string(), "", what, remedy});
  };
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found) fail("does not exist", "check the path and the data root");
  if (status.type() == fs::file_type::directory && fs::exists(path / "run.json", error))
    fail("is the folder of a run, not a file", run_folder_advice(path));
  if (status.type() == fs::file_type::directory) fail("is a folder where a file is needed", "name a file in it");
  if (error || status.type() != fs::file_type::regular) fail("is not a file that can be read", "check the path");
  if (!std::ifstream(path)) fail(std::string("cannot be opened: ") + std::strerror(errno), "check its permissions");
  if (fs::file_size(path, error) == 0) fail("is empty", "export it again");
}

std::string read_text(const fs::path& path) {
  require_readable_file(path);
  std::ifstream stream(path, std::ios::binary);
  std::error_code error;
  std::string bytes(fs::file_size(path, error), '\0');
  stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (stream.bad()) throw InputError({path.string(), "", "cannot be read to its end", "check the disk"});
  bytes.resize(static_cast<std::size_t>(stream.gcount()));  // it may have been cut since
  return bytes;
}

bool is_there(const fs::path& path) {
  std::error_code error;
  const bool there = fs::exists(path, error);
  if (error) throw InputError({path.string(), "", "cannot be looked for: " + error.message(), "check the path"});
  return there;
}

std::string text_if_there(const fs::path& path) {
  std::error_code ignored;
  if (!is_there(path) || (fs::is_regular_file(path, ignored) && fs::file_size(path, ignored) == 0)) return {};
  return read_text(path);
}

std::string lower_case_extension(const fs::path& path) { return lower_case(path.extension().string()); }

}  // namespace gracilis
