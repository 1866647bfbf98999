#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace gracilis {

/// Name of the list in a run folder: a line per file, as `sha256sum --check` reads it.
inline constexpr const char* output_hashes_name = "outputs.sha256";

/// One file of a run folder.
struct OutputHash {
  std::string file;    ///< relative to the folder, with '/'
  std::string sha256;  ///< in hexadecimal digits
};

/// That of one file, which may be empty. Throws InputError where it cannot be read.
std::string output_hash(const std::filesystem::path& file);

/// Of all that a run writes into its folder, but for run.json: surfaces, fibers, plots, tables, index, preview; sorted
/// by their names. Throws InputError where one cannot be read.
std::vector<OutputHash> hash_outputs(const std::filesystem::path& folder);

/// Writes the list of these hashes and returns the hash of the list.
std::string write_output_hashes(const std::filesystem::path& folder);

/// The list as it stands in the folder. Throws InputError where a line is none, or names a file outside of the folder.
std::vector<OutputHash> read_output_hashes(const std::filesystem::path& folder);

}  // namespace gracilis
