#pragma once

#include <gracilis/draft/dictionary.hpp>

#include <optional>
#include <string>
#include <vector>

namespace gracilis {

/// The bone or muscle that a name means.
template <class Known>
struct NameMatch {
  const Known* known = nullptr;   ///< null: none
  std::vector<std::string> rest;  ///< words that its alias does not have
  Real certainty = 0;             ///< 0 to 1
};

/// The one whose alias has the most of the words, all of it among them; else the one that is spelled nearly so.
NameMatch<KnownBone> find_bone(const NameWords& name);
/// As find_bone.
NameMatch<KnownMuscle> find_muscle(const NameWords& name);

/// Whether the name tells something that is neither bone nor muscle, as a ligament.
bool names_something_else(const NameWords& name);

}  // namespace gracilis
