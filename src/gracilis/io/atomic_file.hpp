#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace gracilis {

/// Writes a file that appears whole or not at all: `write` fills a temporary file beside `path` (same extension), which
/// is then synced and renamed. The temporary is made anew under a name that no other process of any machine uses, so
/// that many may write the same file at once: one of them wins. On any failure it is removed, what stood at `path` is
/// untouched, and Error is thrown with the path and the system's reason. Devices, pipes and folders are never replaced.
void write_file_atomically(const std::filesystem::path& path,
                           const std::function<void(const std::filesystem::path&)>& write);

/// The same for a text already in memory.
void write_text_atomically(const std::filesystem::path& path, const std::string& text);

/// The folder that a file lies in or is to be written into; "." for a bare name.
std::filesystem::path folder_of(const std::filesystem::path& file);

/// Makes a folder, and those above it, where they are not there. Throws InputError.
void create_folder(const std::filesystem::path& folder);

/// The same of the folder that a file is to be written into.
void create_folder_of(const std::filesystem::path& file);

/// Throws InputError: `what` is why the file at `path` could not be written.
[[noreturn]] void throw_write_error(const std::filesystem::path& path, const std::string& what);

/// Whose temporaries are left over: those of processes of this machine that run no more, or in a folder that nobody
/// else writes to also those of other machines.
enum class LeftBy { own_machine, any_machine };

/// Removes the temporaries in a folder (not below it) that killed processes left there. What cannot be removed stays.
void remove_left_temporaries(const std::filesystem::path& folder, LeftBy left_by);

}  // namespace gracilis
