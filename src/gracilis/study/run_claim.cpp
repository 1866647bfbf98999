#include <gracilis/study/run_claim.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/io/atomic_file.hpp>
#include <gracilis/io/input_file.hpp>
#include <gracilis/io/process_mark.hpp>

#include <fmt/format.h>

#include <fcntl.h>
#include <sys/stat.h>

#include <chrono>

namespace gracilis {

namespace fs = std::filesystem;

static std::optional<ProcessMark> mark_in(const fs::path& lock) {
  try {
    return parse_mark(text_if_there(lock));
  } catch (const InputError&) {
    return std::nullopt;  // it went in between
  }
}

/// How long ago the lock was renewed, by the clock of the disk that it lies on: a file that is written now is compared
/// with it, for machines' clocks differ.
static std::optional<double> age_of(const fs::path& lock) {
  const fs::path now = lock.parent_path() / fmt::format(".now-{}-{}", own_mark().host, own_mark().process);
  std::error_code error;
  const auto renewed = fs::last_write_time(lock, error);
  if (error) return std::nullopt;
  write_text_atomically(now, "now\n");
  const auto present = fs::last_write_time(now, error);
  fs::remove(now, error);
  return std::chrono::duration<double>(present - renewed).count();
}

/// Takes away a lock of another machine that nobody renews. It is moved aside first: of several who try, one moves the
/// old lock; whoever finds that it moved a new one puts it back.
static bool remove_abandoned(const fs::path& folder) {
  const fs::path lock = folder / "run.lock";
  const std::optional<ProcessMark> mark = mark_in(lock);
  if (!mark || mark->host == own_mark().host) return false;
  const std::optional<double> age = age_of(lock);
  if (!age || *age < RunClaim::abandoned_after) return false;
  const fs::path aside = folder / fmt::format(".abandoned-{}-{}", own_mark().host, own_mark().process);
  std::error_code error;
  fs::rename(lock, aside, error);
  if (error) return false;
  const std::optional<ProcessMark> moved = mark_in(aside);
  const bool is_same = moved && to_text(*moved) == to_text(*mark);
  if (!is_same) fs::create_hard_link(aside, lock, error);
  fs::remove(aside, error);
  if (is_same) fs::remove(folder / "run" / "run.lock", error);
  return is_same;
}

RunClaim::RunClaim(fs::path folder) : folder_(std::move(folder)), lock_(std::make_unique<FolderLock>(folder_)) {}

RunClaim::~RunClaim() {
  if (!lock_) return;
  lock_.reset();
  std::error_code ignored;  // what still lies in it keeps a folder
  fs::remove(folder_, ignored);
}

std::optional<RunClaim> RunClaim::take(const fs::path& folder) {
  for (int attempt = 0;; ++attempt) {
    create_folder(folder);
    try {
      return RunClaim(folder);
    } catch (const ConfigurationError&) {
      if (attempt > 0 || !remove_abandoned(folder)) return std::nullopt;
    } catch (const InputError&) {
      // Whoever had it has just removed the folder.
      if (attempt > 20 || is_there(folder)) throw;
    }
  }
}

void RunClaim::renew() const {
  // By the disk's own clock. Where it cannot be, somebody takes over at worst.
  (void)::utimensat(AT_FDCWD, (folder_ / "run.lock").c_str(), nullptr, 0);
}

std::string who_claims(const fs::path& folder) {
  const std::optional<ProcessMark> mark = mark_in(folder / "run.lock");
  if (!mark || is_gone(*mark)) return "";
  return fmt::format("process {} on {}", mark->process, mark->host);
}

}  // namespace gracilis
