#include <gracilis/draft/name_words.hpp>

#include <algorithm>
#include <cctype>
#include <sstream>

namespace gracilis {

std::string side_ending(BodySide side) { return side == BodySide::right ? "_r" : side == BodySide::left ? "_l" : ""; }

BodySide other_side(BodySide side) {
  return side == BodySide::right ? BodySide::left : side == BodySide::left ? BodySide::right : BodySide::none;
}

namespace {

bool is_upper(char c) { return std::isupper(static_cast<unsigned char>(c)) != 0; }
bool is_lower(char c) { return std::islower(static_cast<unsigned char>(c)) != 0; }
bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }
bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }

/// Whether a new word begins at text[i], inside a run of letters and digits.
bool begins_word(std::string_view text, std::size_t i, std::size_t word_length) {
  const char before = text[i - 1], here = text[i];
  if (is_lower(before) && is_upper(here)) return true;
  if (is_upper(before) && is_upper(here) && i + 1 < text.size() && is_lower(text[i + 1])) return true;
  return word_length >= 3 && !is_digit(before) && is_digit(here);
}

std::vector<std::string> split(std::string_view text) {
  std::vector<std::string> words(1);
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (!is_word(text[i])) {
      words.emplace_back();
      continue;
    }
    if (!words.back().empty() && begins_word(text, i, words.back().size())) words.emplace_back();
    words.back() += static_cast<char>(std::tolower(static_cast<unsigned char>(text[i])));
  }
  std::erase(words, "");
  return words;
}

/// "001" is "1".
std::string without_zeros(const std::string& word) {
  if (!std::all_of(word.begin(), word.end(), is_digit)) return word;
  const std::size_t first = word.find_first_not_of('0');
  return first == std::string::npos ? "0" : word.substr(first);
}

}  // namespace

NameWords read_name(std::string_view name, const WordTables& tables) {
  NameWords result;
  for (const std::string& word : split(name)) {
    if (tables.right.contains(word)) {
      result.side = BodySide::right;
    } else if (tables.left.contains(word)) {
      result.side = BodySide::left;
    } else {
      const auto same = tables.same.find(word);
      std::istringstream meant(same == tables.same.end() ? without_zeros(word) : same->second);
      for (std::string each; meant >> each;)
        if (!tables.fillers.contains(each)) result.words.push_back(each);
    }
  }
  for (const auto& [word, other] : tables.instead)
    if (std::find(result.words.begin(), result.words.end(), word) != result.words.end())
      std::erase(result.words, other);
  return result;
}

}  // namespace gracilis
