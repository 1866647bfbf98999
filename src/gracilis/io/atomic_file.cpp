#include <gracilis/io/atomic_file.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/io/process_mark.hpp>

#include <fmt/format.h>

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <mutex>
#include <optional>
#include <set>
#include <string_view>

namespace gracilis {

namespace fs = std::filesystem;

static constexpr std::string_view temporary_prefix = ".gracilis-";

void throw_write_error(const fs::path& path, const std::string& what) {
  throw InputError({path.string(), "", what, "check the folder's permissions and the free space of the disk"});
}

/// ".gracilis-HOST-PROCESS-STARTED-NUMBER.vtp" for "anything.vtp".
static fs::path temporary_beside(const fs::path& path) {
  static const ProcessMark own = own_mark();
  static std::atomic<unsigned> count{0};
  return path.parent_path() / fmt::format("{}{}-{}-{}-{}{}", temporary_prefix, own.host, own.process, own.started,
                                          count++, path.extension().string().substr(0, 32));
}

/// An empty file that was not there before and is no link that somebody laid.
static fs::path new_temporary(const fs::path& path) {
  for (;;) {
    fs::path temporary = temporary_beside(path);
    const int file = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (file >= 0) {
      ::close(file);
      return temporary;
    }
    if (errno != EEXIST) throw_write_error(path, std::string("cannot be written: ") + std::strerror(errno));
  }
}

static void sync_to_disk(const fs::path& temporary, const fs::path& path) {
  const int file = ::open(temporary.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) throw_write_error(path, std::string("cannot be opened to sync it: ") + std::strerror(errno));
  const int result = ::fsync(file);
  const int reason = errno;
  ::close(file);
  if (result != 0) throw_write_error(path, std::string("cannot be written: ") + std::strerror(reason));
}

fs::path folder_of(const fs::path& file) { return file.has_parent_path() ? file.parent_path() : fs::path("."); }

/// A file that is renamed onto a device or a pipe takes its place, for everybody.
static void require_replaceable(const fs::path& path) {
  std::error_code ignored;
  const fs::file_status there = fs::status(path, ignored);
  if (fs::exists(there) && !fs::is_regular_file(there))
    throw InputError({path.string(), "", "is no file that could be replaced", "name another file"});
}

/// What killed processes left goes when the first file is written beside it; to look again each time takes long where
/// there are many files.
static void clear_once(const fs::path& folder) {
  static std::mutex mutex;
  static std::set<fs::path> cleared;
  {
    const std::lock_guard lock(mutex);
    if (!cleared.insert(folder).second) return;
  }
  remove_left_temporaries(folder, LeftBy::own_machine);
}

void write_file_atomically(const fs::path& path, const std::function<void(const fs::path&)>& write) {
  require_replaceable(path);
  clear_once(folder_of(path));
  const fs::path temporary = new_temporary(path);
  try {
    write(temporary);
    sync_to_disk(temporary, path);
    fs::rename(temporary, path);
  } catch (const fs::filesystem_error& error) {
    std::error_code ignored;
    fs::remove(temporary, ignored);
    throw_write_error(path, "cannot be written: " + error.code().message());
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
    if (!stream) throw_write_error(path, std::string("cannot be written: ") + std::strerror(errno));
  });
}

/// Who wrote a temporary, by its name.
static std::optional<ProcessMark> writer_of(const fs::path& temporary) {
  std::string name = temporary.filename().string();
  if (!name.starts_with(temporary_prefix)) return std::nullopt;
  name.erase(0, temporary_prefix.size());
  std::replace(name.begin(), name.end(), '-', ' ');
  return parse_mark(name.substr(0, name.rfind(' ')));
}

void remove_left_temporaries(const fs::path& folder, LeftBy left_by) {
  const std::string own_host = own_mark().host;
  std::error_code ignored;
  for (fs::directory_iterator entry(folder, ignored), end; entry != end; entry.increment(ignored)) {
    const std::optional<ProcessMark> writer = writer_of(entry->path());
    if (!writer) continue;
    const bool of_others = writer->host != own_host;
    if (is_gone(*writer) || (of_others && left_by == LeftBy::any_machine)) fs::remove(entry->path(), ignored);
  }
}

void create_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw InputError({folder.string(), "", "cannot be created: " + error.message(), "choose another place with --out"});
}

void create_folder_of(const std::filesystem::path& file) { create_folder(folder_of(file)); }

}  // namespace gracilis
