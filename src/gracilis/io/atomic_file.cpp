#include <gracilis/io/atomic_file.hpp>

#include <gracilis/core/errors.hpp>

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>

namespace gracilis {

namespace fs = std::filesystem;

static void fail(const fs::path& path, const std::string& what) {
  throw InputError({path.string(), "", what, "check the folder's permissions and the free space of the disk"});
}

/// A name of its own per process, so that two runs never write to the same temporary.
static fs::path temporary_beside(const fs::path& path) {
  return path.parent_path() /
         ("." + path.stem().string() + "." + std::to_string(::getpid()) + path.extension().string());
}

static void sync_to_disk(const fs::path& path) {
  const int file = ::open(path.c_str(), O_RDONLY);
  if (file < 0) fail(path, std::string("cannot be opened to sync it: ") + std::strerror(errno));
  const int result = ::fsync(file);
  const int reason = errno;
  ::close(file);
  if (result != 0) fail(path, std::string("cannot be written: ") + std::strerror(reason));
}

void write_file_atomically(const fs::path& path, const std::function<void(const fs::path&)>& write) {
  const fs::path temporary = temporary_beside(path);
  try {
    write(temporary);
    sync_to_disk(temporary);
    fs::rename(temporary, path);
  } catch (const fs::filesystem_error& error) {
    std::error_code ignored;
    fs::remove(temporary, ignored);
    fail(path, "cannot be written: " + error.code().message());
  } catch (...) {
    std::error_code ignored;
    fs::remove(temporary, ignored);
    throw;
  }
}

void write_text_atomically(const fs::path& path, const std::string& text) {
  write_file_atomically(path, [&](const fs::path& temporary) {
    std::ofstream stream(temporary, std::ios::binary);
    stream << text;
    stream.close();
    if (!stream) fail(path, std::string("cannot be written: ") + std::strerror(errno));
  });
}

}  // namespace gracilis
