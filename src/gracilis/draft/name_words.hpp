#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace gracilis {

/// Which half of the body something belongs to.
enum class BodySide { none, right, left };

/// What follows a name: "", "_r" or "_l".
std::string side_ending(BodySide side);

/// Left of right and the other way; none of none.
BodySide other_side(BodySide side);

/// How the words of names are read (words.toml).
struct WordTables {
  std::set<std::string> right, left, fillers, others;
  std::map<std::string, std::string> same;     ///< read as
  std::map<std::string, std::string> instead;  ///< counts, and the other one does not
};

/// A name in comparable words: lower case, without side and fillers.
struct NameWords {
  std::vector<std::string> words;
  BodySide side = BodySide::none;
};

/// Splits at all that is no letter or digit, where small letters turn to capitals, and before digits behind words
/// ("metatarsal1", but not "l4"). Words of the same meaning become the same.
NameWords read_name(std::string_view name, const WordTables& tables);

}  // namespace gracilis
