#include "manual.hpp"

#include "option_text.hpp"

#include <gracilis/io/atomic_file.hpp>

#include <algorithm>
#include <sstream>

namespace gracilis {

namespace {

/// Text that man does not take for its own language: no line begins with a point, and what looks like a hyphen is one
/// that can be copied into a shell.
std::string roff(const std::string& text) {
  std::string escaped;
  bool begins = true;
  for (const char c : text) {
    if (begins && (c == '.' || c == '\'')) escaped += "\\&";
    if (c == '\\')
      escaped += "\\e";
    else if (c == '-')
      escaped += "\\-";
    else if (c == '`' || c == '\'')
      escaped += c == '`' ? "\\(ga" : "\\(aq";
    else
      escaped += c;
    begins = c == '\n';
  }
  return escaped;
}

std::string upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::toupper(c); });
  return text;
}

std::string section_of(const std::string& title, const std::string& text) {
  return ".SH " + title + "\n" + text + "\n";
}

/// A paragraph that begins with what it explains.
std::string explained(const std::string& what, const std::string& meaning) {
  return ".TP\n" + what + "\n" + roff(meaning.empty() ? "" : meaning) + "\n";
}

std::string bold(const std::string& text) { return "\\fB" + roff(text) + "\\fR"; }
std::string slanted(const std::string& text) { return "\\fI" + roff(text) + "\\fR"; }

std::string option_names_of(const CLI::Option& option) {
  std::string names;
  for (const std::string& name : option.get_snames()) names += (names.empty() ? "" : ", ") + bold("-" + name);
  for (const std::string& name : option.get_lnames()) names += (names.empty() ? "" : ", ") + bold("--" + name);
  const std::string value = value_text(option);
  return names + (value.empty() ? "" : " " + slanted(value));
}

std::string remark_of(const CLI::Option& option) {
  std::string remark = option.get_description();
  for (const CLI::Option* other : option.get_excludes()) remark += " (not with " + other->get_name() + ")";
  if (option.get_required()) remark += " (required)";
  return remark;
}

std::vector<const CLI::App*> shown_commands(const CLI::App& command) {
  return command.get_subcommands(
      [](const CLI::App* sub) { return !sub->get_name().empty() && !sub->get_group().empty(); });
}

/// The last line of a footer that begins with "Example: ", and what stands before it.
struct Footer {
  std::string text, example;
};

Footer footer_of(const CLI::App& command) {
  const std::string all = command.get_footer(), mark = "Example: ";
  const std::size_t begin = all.rfind(mark);
  if (begin == std::string::npos) return {all, ""};
  return {all.substr(0, begin), all.substr(begin + mark.size())};
}

std::string synopsis(const CLI::App& command, const std::string& name) {
  std::string text = bold(name) + " [" + slanted("OPTIONS") + "]";
  for (const CLI::Option* argument : positional_arguments(command)) {
    const std::string word = slanted(argument->get_name()) +
                             (argument->get_expected_max() == CLI::detail::expected_max_vector_size ? "..." : "");
    text += argument->get_required() ? " " + word : " [" + word + "]";
  }
  return text + (shown_commands(command).empty() ? "" : " " + slanted("COMMAND") + " ...");
}

/// Lines as they are: tables that blanks align.
std::string as_it_stands(const std::string& text) { return ".nf\n" + roff(text) + "\n.fi"; }

std::string dashed(std::string name) {
  std::replace(name.begin(), name.end(), ' ', '-');
  return name;
}

/// A description without its blank lines, which man(7) leaves to requests.
std::string paragraphs(const std::string& text) {
  std::istringstream lines(text);
  std::string all;
  for (std::string line; std::getline(lines, line);) all += line.empty() ? ".PP\n" : roff(line) + "\n";
  if (!all.empty()) all.pop_back();
  return all;
}

std::string page(const CLI::App& command, const std::string& name, const std::string& version,
                 const std::string& date) {
  const Footer footer = footer_of(command);
  std::string text = ".\\\" Written by 'gracilis manual' from what --help says.\n.TH " + upper(roff(dashed(name))) +
                     " 1 \"" + date + "\" \"gracilis " + version + "\" \"Gracilis\"\n";
  text += section_of("NAME", roff(dashed(name)) + " \\- " + roff(command.get_description()));
  text += section_of("SYNOPSIS", synopsis(command, name));
  text += section_of("DESCRIPTION", paragraphs(command.get_description() + "."));
  std::string part;
  for (const CLI::App* sub : shown_commands(command))
    part += explained(bold(sub->get_name()),
                      sub->get_description() + " (see " + dashed(name) + "-" + sub->get_name() + "(1)).");
  if (!part.empty()) text += section_of("COMMANDS", part);
  part.clear();
  for (const CLI::Option* argument : positional_arguments(command))
    part += explained(slanted(argument->get_name()), remark_of(*argument));
  if (!part.empty()) text += section_of("ARGUMENTS", part);
  part.clear();
  for (const CLI::Option* option : named_options(command))
    part += explained(option_names_of(*option), remark_of(*option));
  text += section_of("OPTIONS", part);
  if (!footer.text.empty())
    text += section_of("NOTES", as_it_stands(footer.text.substr(0, footer.text.find_last_not_of('\n') + 1)));
  if (!footer.example.empty()) text += section_of("EXAMPLES", as_it_stands(footer.example));
  const CLI::App* parent = command.get_parent();
  std::string others;
  for (const CLI::App* other : shown_commands(parent ? *parent : command)) {
    if (other == &command) continue;
    const std::string first = parent ? name.substr(0, name.rfind(' ')) : name;
    others +=
        std::string(others.empty() ? "" : ",\n") + ".BR " + roff(dashed(first + " " + other->get_name())) + " (1)";
  }
  if (parent)
    others = ".BR " + roff(dashed(name.substr(0, name.rfind(' ')))) + " (1)" + (others.empty() ? "" : ",\n" + others);
  text += section_of("SEE ALSO", others);
  std::string clean;  // an empty line is a mistake to man
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (!line.empty()) clean += line + "\n";
  return clean;
}

void add_pages(const CLI::App& command, const std::string& name, const std::string& version, const std::string& date,
               std::map<std::string, std::string>& pages) {
  pages[dashed(name) + ".1"] = page(command, name, version, date);
  for (const CLI::App* sub : shown_commands(command))
    add_pages(*sub, name + " " + sub->get_name(), version, date, pages);
}

}  // namespace

std::map<std::string, std::string> manual_pages(const CLI::App& program, const std::string& version,
                                                const std::string& date) {
  std::map<std::string, std::string> pages;
  add_pages(program, program.get_name(), version, date, pages);
  return pages;
}

void write_manual(const CLI::App& program, const std::string& version, const std::string& date,
                  const std::filesystem::path& folder) {
  create_folder(folder);
  for (const auto& [name, text] : manual_pages(program, version, date)) write_text_atomically(folder / name, text);
}

}  // namespace gracilis
