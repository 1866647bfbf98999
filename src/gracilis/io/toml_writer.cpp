#include <gracilis/io/toml_writer.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <sstream>
#include <vector>

namespace gracilis {
namespace {

constexpr std::size_t widest = 118;

std::string key_text(const toml::key& key) {
  const std::string_view text = key.str();
  const bool bare = !text.empty() && text.find_first_not_of(
                                         "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                         "0123456789_-") == std::string_view::npos;
  if (bare) return std::string(text);
  std::ostringstream quoted;
  quoted << toml::value<std::string>(std::string(text));
  return quoted.str();
}

bool is_list_of_tables(const toml::node& node) {
  return node.is_array() && !node.as_array()->empty() && node.as_array()->is_homogeneous(toml::node_type::table);
}

std::string value_text(const toml::node& node);

/// Items one after the other, a new line where the next does not fit.
std::string wrapped(const std::vector<std::string>& items) {
  std::size_t whole = 2;
  for (const std::string& item : items) whole += item.size() + 2;
  std::string text = "[", line;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const std::string item = items[i] + (i + 1 < items.size() ? "," : "");
    if (whole > widest && (line.empty() || line.size() + item.size() + 1 > widest)) {
      text += line;
      line = "\n  ";
    } else if (!line.empty() || i > 0) {
      line += ' ';
    }
    line += item;
  }
  return text + line + (whole > widest ? "\n]" : "]");
}

std::string value_text(const toml::node& node) {
  if (const toml::array* array = node.as_array()) {
    std::vector<std::string> items;
    for (const toml::node& each : *array) items.push_back(value_text(each));
    return wrapped(items);
  }
  if (const toml::table* table = node.as_table()) {
    std::string text;
    for (auto&& [key, each] : *table) text += (text.empty() ? "" : ", ") + key_text(key) + " = " + value_text(each);
    return "{ " + text + " }";
  }
  if (const auto number = node.as_floating_point()) {
    const std::string text = fmt::format("{}", number->get());
    return text.find_first_of(".einf") == std::string::npos ? text + ".0" : text;
  }
  std::ostringstream text;
  node.visit([&](const auto& value) { text << value; });
  return text.str();
}

void write(const toml::table& table, const std::string& path, std::string& text) {
  constexpr std::array<std::string_view, 2> first = {"schema", "name"};
  const auto is_first = [&](std::string_view key, const toml::node& node) {
    return node.is_value() && std::find(first.begin(), first.end(), key) != first.end();
  };
  for (const std::string_view key : first)
    if (const toml::node* node = table.get(key); node && is_first(key, *node))
      text += std::string(key) + " = " + value_text(*node) + "\n";
  for (auto&& [key, node] : table)
    if (!node.is_table() && !is_list_of_tables(node) && !is_first(key.str(), node))
      text += key_text(key) + " = " + value_text(node) + "\n";
  for (auto&& [key, node] : table) {
    const std::string own = path.empty() ? key_text(key) : path + "." + key_text(key);
    if (const toml::table* inner = node.as_table()) {
      text += "\n[" + own + "]\n";
      write(*inner, own, text);
    } else if (is_list_of_tables(node)) {
      for (const toml::node& each : *node.as_array()) {
        text += "\n[[" + own + "]]\n";
        write(*each.as_table(), own, text);
      }
    }
  }
}

}  // namespace

std::string toml_of(const toml::table& table) {
  std::string text;
  write(table, "", text);
  return text;
}

}  // namespace gracilis
