#pragma once

#include <string>
#include <vector>

namespace gracilis {

/// What this program was built of, and where.
struct BuildInfo {
  std::string version;
  std::string commit;    ///< "unknown" where it was built without git
  std::string date;      ///< of the commit, as in 2026-11-26; empty where it is not known
  std::string compiler;  ///< "GCC 12.2.0"
  std::string build_type;
  std::vector<std::string> instruction_sets;      ///< for which there is code
  std::string instruction_set;                    ///< that this machine uses
  std::vector<std::string> components, left_out;  ///< optional ones
};

BuildInfo build_info();

/// For people, a line each; the first is "gracilis VERSION".
std::string version_text();
/// The same for programs, as JSON.
std::string version_json();

}  // namespace gracilis
