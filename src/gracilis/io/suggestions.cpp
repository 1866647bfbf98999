#include <gracilis/io/suggestions.hpp>

#include <algorithm>
#include <cstdlib>

namespace gracilis {

// What a person types and reads stays far below; the distance of longer words takes the product of their lengths.
static constexpr std::size_t longest_word = 120, most_words = 40;

int edit_distance(std::string_view a, std::string_view b) {
  // Three rows of the table of distances between beginnings of a and b.
  std::vector<int> before(b.size() + 1), row(b.size() + 1), next(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    next[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      next[j] = std::min({row[j] + 1, next[j - 1] + 1, row[j - 1] + (a[i - 1] != b[j - 1])});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        next[j] = std::min(next[j], before[j - 2] + 1);
    }
    std::swap(before, row);
    std::swap(row, next);
  }
  return row[b.size()];
}

std::string nearest_word(std::string_view word, const std::vector<std::string>& candidates) {
  if (word.size() > longest_word) return "";
  int nearest = std::max<int>(2, static_cast<int>(word.size() / 3)) + 1;
  std::string result;
  for (const std::string& candidate : candidates) {
    // At least so many letters are put in or left out.
    if (std::abs(static_cast<long>(word.size()) - static_cast<long>(candidate.size())) >= nearest) continue;
    if (candidate.size() > longest_word) continue;
    const int distance = edit_distance(word, candidate);
    // A word of three letters is not a misspelling of any other word of three letters.
    if (distance >= nearest || distance >= static_cast<int>(std::max(word.size(), candidate.size()))) continue;
    nearest = distance;
    result = candidate;
  }
  if (!result.empty()) return result;

  // Or the only one that begins with the word.
  for (const std::string& candidate : candidates) {
    if (word.size() < 3 || !candidate.starts_with(word)) continue;
    if (!result.empty()) return "";
    result = candidate;
  }
  return result;
}

std::string shortened(std::string_view name) {
  if (name.size() <= longest_word) return std::string(name);
  std::size_t end = longest_word;
  while (end > 0 && (static_cast<unsigned char>(name[end]) & 0xc0) == 0x80) --end;  // not within a letter of UTF-8
  return std::string(name.substr(0, end)) + "...";
}

std::string suggestion(std::string_view word, const std::vector<std::string>& candidates) {
  const std::string nearest = nearest_word(word, candidates);
  if (!nearest.empty()) return "did you mean '" + shortened(nearest) + "'?";
  if (candidates.empty()) return "none is known here";
  std::string text = "known are";
  const std::size_t listed = std::min(candidates.size(), most_words);
  for (std::size_t i = 0; i < listed; ++i) text += (i == 0 ? " '" : ", '") + shortened(candidates[i]) + "'";
  return listed < candidates.size() ? text + " and " + std::to_string(candidates.size() - listed) + " more" : text;
}

}  // namespace gracilis
