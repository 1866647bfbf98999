#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace gracilis {

/// The fewest single-character insertions, deletions, replacements and swaps of neighbors that turn `a` into `b`
/// (optimal string alignment distance).
int edit_distance(std::string_view a, std::string_view b);

/// The candidate nearest to `word`, or "" when none is near enough to be what was meant: at most a third of the word's
/// letters may differ, and always two; or it is the only one that begins with the word. The first of equally near ones.
/// Words of more than 120 bytes are near to none.
std::string nearest_word(std::string_view word, const std::vector<std::string>& candidates);

/// A name for a message: what is longer than 120 bytes ends in "...".
std::string shortened(std::string_view name);

/// "did you mean 'iterations'?", or where nothing is near "known are 'a', 'b', 'c'", at most 40 of them; for the remedy
/// of a Problem.
std::string suggestion(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace gracilis
