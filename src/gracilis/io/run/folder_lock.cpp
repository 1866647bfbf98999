#include <gracilis/io/run/folder_lock.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/io/atomic_file.hpp>
#include <gracilis/io/process_mark.hpp>

#include <fmt/format.h>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <optional>

namespace gracilis {

namespace fs = std::filesystem;

/// Who holds it, as far as the file says.
static std::optional<ProcessMark> holder_in(int file) {
  char text[256];
  const ssize_t size = ::pread(file, text, sizeof text, 0);
  return size > 0 ? parse_mark({text, static_cast<std::size_t>(size)}) : std::nullopt;
}

[[noreturn]] static void refuse(const fs::path& path, const std::optional<ProcessMark>& holder, bool is_sure) {
  const std::string who =
      holder ? fmt::format("process {} on {}", holder->process, holder->host) : std::string("another process");
  const std::string remedy = is_sure ? "wait for it, or choose another folder with --out"
                                     : fmt::format(
                                           "choose another folder with --out, or remove {} if that process "
                                           "runs no more",
                                           path.string());
  throw ConfigurationError({path.parent_path().string(), "", "is being written by " + who, remedy});
}

/// Whether the file is still the one at `path`: its last holder may have removed it in between.
static bool is_at(int file, const fs::path& path) {
  struct stat opened {
  }, named{};
  return ::fstat(file, &opened) == 0 && ::stat(path.c_str(), &named) == 0 && opened.st_ino == named.st_ino &&
         opened.st_dev == named.st_dev;
}

/// False: try again.
bool FolderLock::take() {
  file_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0666);
  if (file_ < 0) throw_write_error(path_, std::string("cannot be written: ") + std::strerror(errno));
  const bool locked = ::flock(file_, LOCK_EX | LOCK_NB) == 0;
  const int reason = errno;
  const std::optional<ProcessMark> holder = holder_in(file_);
  if (!locked && reason == EWOULDBLOCK) refuse(path_, holder, true);
  if (locked && !is_at(file_, path_)) {
    ::close(file_);
    return false;
  }
  // Locks of another machine may not reach here; of this one they do, so that what is written in a locked file is old.
  const bool may_live = holder && (locked ? holder->host != own_mark().host : !is_gone(*holder));
  if (may_live) refuse(path_, holder, false);
  const std::string text = to_text(own_mark()) + "\n";
  if (::ftruncate(file_, 0) != 0 || ::pwrite(file_, text.data(), text.size(), 0) != static_cast<ssize_t>(text.size()))
    throw_write_error(path_, std::string("cannot be written: ") + std::strerror(errno));
  return true;
}

FolderLock::FolderLock(const fs::path& folder) : path_(folder / "run.lock") {
  try {
    while (!take()) {
    }
  } catch (...) {
    if (file_ >= 0) ::close(file_);
    throw;
  }
}

FolderLock::~FolderLock() {
  ::unlink(path_.c_str());
  ::close(file_);
}

}  // namespace gracilis
