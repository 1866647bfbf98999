#include "option_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gracilis {

namespace {

constexpr std::size_t whole = std::string::npos;

/// "a->1,b->0" as a and b.
std::vector<std::string> split_choices(const std::string& text) {
  std::vector<std::string> words;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string word = text.substr(begin, end - begin);
    words.push_back(word.substr(0, word.find("->")));
    begin = end + 1;
  }
  return words;
}

}  // namespace

std::vector<std::string> choices_of(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const std::size_t begin = type.find('{'), end = type.find('}');
  if (begin == whole || end == whole) return {};
  return split_choices(type.substr(begin + 1, end - begin - 1));
}

std::string value_text(const CLI::Option& option) {
  if (option.get_type_size() == 0) return "";
  std::string text;
  if (const std::vector<std::string> choices = choices_of(option); !choices.empty()) {
    text = fmt::format("{}", fmt::join(choices, "|"));
  } else {
    // CLI11 joins the type and what its checks say by a colon, as in "INT:INT in [0 - 4]".
    text = option.get_type_name();
    if (const std::size_t colon = text.find(':'); colon != whole) {
      const std::string type = text.substr(0, colon), check = text.substr(colon + 1);
      text = check.starts_with(type) ? check : type + " " + check;
    }
  }
  if (!option.get_default_str().empty()) text += "=" + option.get_default_str();
  if (option.get_expected_max() == CLI::detail::expected_max_vector_size) text += " ...";
  return text;
}

std::vector<const CLI::Option*> named_options(const CLI::App& command) {
  return command.get_options(
      [](const CLI::Option* option) { return option->nonpositional() && !option->get_group().empty(); });
}

std::vector<const CLI::Option*> positional_arguments(const CLI::App& command) {
  return command.get_options([](const CLI::Option* option) { return option->get_positional(); });
}

std::string HelpText::make_option_opts(const CLI::Option* option) const {
  const std::string value = value_text(*option);
  std::string text = value.empty() ? "" : " " + value;
  if (option->get_required()) text += " REQUIRED";
  for (const CLI::Option* other : option->get_excludes()) text += " (not with " + other->get_name() + ")";
  for (const CLI::Option* other : option->get_needs()) text += " (with " + other->get_name() + ")";
  return text;
}

}  // namespace gracilis
