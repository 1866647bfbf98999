#pragma once

#include "completion.hpp"

#include <string>
#include <vector>

namespace gracilis {

/// What a command line is about: names in the scene, run folder or model that it names first; of what cannot be read
/// there are none.
struct SubjectNames {
  std::vector<std::string> muscles, bones, joints, coordinates;
  std::string method;  ///< of a scene; empty: not told
};
SubjectNames names_in_subject(const std::vector<std::string>& words);

/// What may stand behind --set: keys with '=', their defaults and meanings; behind a key its values.
std::vector<Candidate> setting_candidates(const SubjectNames& names, const std::string& begun);

/// Files and folders that a word may become, by what an option says of itself: its endings (".png"), "run folder",
/// "folder". None where it speaks of no file.
std::vector<Candidate> file_candidates(const std::string& description, const std::string& begun);

}  // namespace gracilis
