#pragma once

#include <gracilis/io/run/folder_lock.hpp>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace gracilis {

/// A run that this process works on: its working folder, locked (FolderLock), so that no other process of any machine
/// begins it. The lock's time is renewed while the claim is told to be alive; a lock of another machine that nobody has
/// renewed for `abandoned_after` is taken over, since that machine may have died. Where the lock were lost all the
/// same, the run's own folder has one, too, and results appear by one rename.
class RunClaim {
 public:
  static constexpr int renewed_every = 10;     ///< s
  static constexpr int abandoned_after = 300;  ///< s

  /// Nothing where another process works on it. Throws InputError where the folder cannot be written.
  static std::optional<RunClaim> take(const std::filesystem::path& folder);

  /// The claim goes along.
  RunClaim(RunClaim&&) = default;
  RunClaim& operator=(RunClaim&&) = delete;
  ~RunClaim();

  /// Says that this process is alive; nothing happens where the lock cannot be written.
  void renew() const;

 private:
  explicit RunClaim(std::filesystem::path folder);

  std::filesystem::path folder_;
  std::unique_ptr<FolderLock> lock_;
};

/// "process 17 on node3" where a process works in the folder as far as can be told; empty where none does.
std::string who_claims(const std::filesystem::path& folder);

}  // namespace gracilis
