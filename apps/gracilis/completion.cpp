#include "completion.hpp"

#include "completion_names.hpp"
#include "option_text.hpp"

#include <gracilis/methods/registry.hpp>

#include <algorithm>

namespace gracilis {

namespace {

/// Where a command line ends: the command it is in, and the option whose value or the positional argument whose place
/// it is; null: neither.
struct Place {
  const CLI::App* command;
  const CLI::Option* option = nullptr;
  bool is_value = false;  ///< nothing but a value of `option` can stand here
};

const CLI::Option* option_called(const CLI::App& command, const std::string& word) {
  for (const CLI::Option* option : named_options(command))
    if (option->check_name(word)) return option;
  return nullptr;
}

const CLI::App* command_called(const CLI::App& command, const std::string& word) {
  for (const CLI::App* sub : command.get_subcommands({}))
    if (sub->get_name() == word) return sub;
  return nullptr;
}

bool is_repeated(const CLI::Option& option) {
  return option.get_expected_max() == CLI::detail::expected_max_vector_size;
}

Place place_at_end(const CLI::App& program, const std::vector<std::string>& words) {
  Place place{&program};
  std::size_t arguments = 0;
  const CLI::Option* taking = nullptr;  // the option that the next words may be values of
  bool must = false;
  for (std::size_t i = 1; i + 1 < words.size(); ++i) {
    const std::string& word = words[i];
    if (must) {
      must = false;
      if (!is_repeated(*taking) || !taking->get_allow_extra_args()) taking = nullptr;
    } else if (word.starts_with("-") && word != "-") {
      const CLI::Option* option = option_called(*place.command, word.substr(0, word.find('=')));
      // A flag is an option that expects nothing; its type may have a size all the same.
      const bool wants = option && option->get_items_expected_max() > 0 && word.find('=') == std::string::npos;
      taking = wants ? option : nullptr;
      must = taking;
    } else if (const CLI::App* sub = taking ? nullptr : command_called(*place.command, word)) {
      place.command = sub;
    } else if (!taking) {
      ++arguments;
    }
  }
  if (taking) return {place.command, taking, must};
  const std::vector<const CLI::Option*> positional = positional_arguments(*place.command);
  if (!positional.empty())
    place.option = arguments < positional.size()     ? positional[arguments]
                   : is_repeated(*positional.back()) ? positional.back()
                                                     : nullptr;
  return place;
}

std::vector<Candidate> words_of(const std::vector<std::string>& names, const std::string& end = "") {
  std::vector<Candidate> all;
  for (const std::string& name : names) all.push_back({name + end, ""});
  return all;
}

/// A list between commas: what stands before the last comma stays.
std::vector<Candidate> listed(std::vector<Candidate> candidates, const std::string& begun) {
  const std::size_t comma = begun.rfind(',');
  if (comma == std::string::npos) return candidates;
  for (Candidate& candidate : candidates) candidate.word.insert(0, begun.substr(0, comma + 1));
  return candidates;
}

std::vector<Candidate> values_of(const CLI::Option& option, const std::vector<std::string>& words,
                                 const std::string& begun) {
  if (const std::vector<std::string> choices = choices_of(option); !choices.empty()) return words_of(choices);
  const std::string name = option.get_name();
  const std::string& description = option.get_description();
  const auto is = [&](std::initializer_list<const char*> names) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  if (is({"--set"})) {
    SubjectNames names = names_in_subject(words);
    for (const std::string& word : words)
      if (word.starts_with("method=")) names.method = word.substr(7);
    return setting_candidates(names, begun);
  }
  if (is({"--only", "--muscles"})) return listed(words_of(names_in_subject(words).muscles), begun);
  if (is({"--bones"}) && !description.starts_with("Folder"))
    return listed(words_of(names_in_subject(words).bones), begun);
  if (is({"--hide", "--focus"})) {
    SubjectNames names = names_in_subject(words);
    names.muscles.insert(names.muscles.end(), names.bones.begin(), names.bones.end());
    return listed(words_of(names.muscles), begun);
  }
  if (is({"--coord", "--range", "--pose"})) return words_of(names_in_subject(words).coordinates, "=");
  if (is({"--joint", "--reactions"})) return words_of(names_in_subject(words).joints);
  if (is({"--methods"})) {
    std::vector<Candidate> all;
    for (const MethodEntry& method : methods()) all.push_back({std::string(method.name), std::string(method.meaning)});
    for (const Preset& preset : presets()) all.push_back({std::string(preset.name), std::string(preset.meaning)});
    return listed(all, begun);
  }
  std::vector<Candidate> all = file_candidates(description, begun);
  if (description.find("demo-elbow") != std::string::npos) {
    all.push_back({"demo", "the built-in hip"});
    all.push_back({"demo-elbow", "the built-in elbow"});
  }
  return all;
}

}  // namespace

std::vector<std::string> shell_words(const std::string& line) {
  std::vector<std::string> words(1);
  char quote = 0;
  bool begun = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (quote) {
      if (c == quote)
        quote = 0;
      else
        words.back() += c == '\\' && quote == '"' && i + 1 < line.size() ? line[++i] : c;
    } else if (c == '\'' || c == '"') {
      quote = c;
      begun = true;
    } else if (c == '\\' && i + 1 < line.size()) {
      words.back() += line[++i];
      begun = true;
    } else if (c == ' ' || c == '\t' || c == '\n') {
      if (begun) words.emplace_back();
      begun = false;
    } else {
      words.back() += c;
      begun = true;
    }
  }
  return words;
}

std::vector<Candidate> completions(const CLI::App& program, const std::string& line) {
  const std::vector<std::string> words = shell_words(line);
  if (words.size() < 2) return {};
  const std::string& word = words.back();
  const Place place = place_at_end(program, words);
  std::vector<Candidate> all;
  const std::size_t equals = word.find('=');
  if (!place.is_value && word.starts_with("--") && equals != std::string::npos) {
    if (const CLI::Option* option = option_called(*place.command, word.substr(0, equals)))
      for (Candidate& each : values_of(*option, words, word.substr(equals + 1)))
        all.push_back({word.substr(0, equals + 1) + each.word, each.meaning});
  } else if (!place.is_value && word.starts_with("-")) {
    for (const CLI::Option* option : named_options(*place.command))
      for (const std::string& name : option->get_lnames()) all.push_back({"--" + name, option->get_description()});
  } else if (place.option) {
    all = values_of(*place.option, words, word);
  } else {
    for (const CLI::App* sub : place.command->get_subcommands({}))
      all.push_back({sub->get_name(), sub->get_description()});
  }
  std::erase_if(all, [&](const Candidate& each) { return !each.word.starts_with(word); });
  return all;
}

}  // namespace gracilis
