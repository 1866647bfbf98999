#pragma once

#include <filesystem>

namespace gracilis {

/// Keeps other processes from writing to a folder while it lives: FOLDER/run.lock, locked and with the process and the
/// machine in it. It goes with its process, however that ends; what a killed one left behind is taken over. Disks
/// without locks are served by what the file says.
class FolderLock {
 public:
  /// Throws ConfigurationError naming process and machine where another one holds it, and InputError where the file
  /// cannot be written.
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  bool take();

  std::filesystem::path path_;
  int file_ = -1;
};

}  // namespace gracilis
