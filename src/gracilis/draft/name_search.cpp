#include <gracilis/draft/name_search.hpp>

#include <gracilis/io/suggestions.hpp>

#include <algorithm>

namespace gracilis {
namespace {

/// What of `words` the alias does not have; nothing where the alias has a word more.
std::optional<std::vector<std::string>> without(std::vector<std::string> words, const Alias& alias) {
  for (const std::string& word : alias) {
    const auto found = std::find(words.begin(), words.end(), word);
    if (found == words.end()) return std::nullopt;
    words.erase(found);
  }
  return words;
}

std::string run_together(const Alias& words) {
  std::string all;
  for (const std::string& word : words) all += word;
  return all;
}

bool is_number(const std::string& word) { return word.find_first_not_of("0123456789") == std::string::npos; }

/// Of what the alias says: more words before more letters.
std::size_t weight(const Alias& alias) { return 100 * alias.size() + run_together(alias).size(); }

/// Short forms as "sup" mean something as a whole name only.
constexpr std::size_t short_form = 4;

template <class Known>
NameMatch<Known> by_words(const NameWords& name, const std::vector<Known>& all) {
  NameMatch<Known> best;
  std::size_t most = 0;
  for (const Known& known : all)
    for (const Alias& alias : known.aliases) {
      const auto rest = without(name.words, alias);
      if (!rest || weight(alias) <= most) continue;
      const bool plain = std::all_of(rest->begin(), rest->end(), is_number);
      if (!plain && alias.size() == 1 && alias.front().size() <= short_form) continue;
      most = weight(alias);
      best = {&known, *rest, plain ? 0.95 : 0.8};
    }
  return best;
}

template <class Known>
NameMatch<Known> by_spelling(const NameWords& name, const std::vector<Known>& all) {
  NameMatch<Known> best;
  const std::string text = run_together(name.words);
  int fewest = text.size() < 6 ? 0 : std::max(1, static_cast<int>(text.size()) / 8);
  for (const Known& known : all)
    for (const Alias& alias : known.aliases) {
      const int distance = edit_distance(text, run_together(alias));
      if (distance > fewest || (best.known && distance == fewest)) continue;
      fewest = distance;
      best = {&known, {}, distance == 0 ? 0.9 : 0.6};
    }
  return best;
}

template <class Known>
NameMatch<Known> found_among(const NameWords& name, const std::vector<Known>& all) {
  if (name.words.empty()) return {};
  const NameMatch<Known> exact = by_words(name, all);
  return exact.known ? exact : by_spelling(name, all);
}

}  // namespace

NameMatch<KnownBone> find_bone(const NameWords& name) { return found_among(name, dictionary().bones); }

NameMatch<KnownMuscle> find_muscle(const NameWords& name) { return found_among(name, dictionary().muscles); }

bool names_something_else(const NameWords& name) {
  return std::any_of(name.words.begin(), name.words.end(),
                     [](const std::string& word) { return dictionary().words.others.contains(word); });
}

}  // namespace gracilis
