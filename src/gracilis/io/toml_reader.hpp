#pragma once

#include <gracilis/core/errors.hpp>
#include <gracilis/core/types.hpp>
#include <gracilis/scene/setting_table.hpp>

#include <toml++/toml.h>

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace gracilis {

/// The place of a node in its file, with nothing said about it yet.
Problem place_of(const toml::node& node);

/// Problems of one file together, in the order of lines and columns.
void sort_by_place(std::vector<Problem>& problems);

/// Bounds of a number, both allowed, with the unit to show.
struct NumberRange {
  Real minimum = -std::numeric_limits<Real>::max();
  Real maximum = std::numeric_limits<Real>::max();
  std::string unit = "";
};

/// Reads one table of a scene file. Each access makes its key a known one and adds a problem, with line and column,
/// where the value is not what was asked for; at the end `reject_unknown_keys` finds the keys that nobody asked for.
/// Nothing is thrown: an access whose value is missing or wrong returns nothing. The table must outlive the reader.
class TomlReader {
 public:
  /// `title` says in messages what the table is, as in "[[bones]]".
  TomlReader(const toml::table& table, std::string title, std::vector<Problem>& problems)
      : table_(&table), title_(std::move(title)), problems_(&problems) {}

  const toml::node* find(const std::string& key);                    ///< null when the key is missing
  bool has(const std::string& key) { return find(key) != nullptr; }  ///< whether the key is there

  std::optional<std::string> text(const std::string& key);                            ///< not empty
  std::optional<bool> flag(const std::string& key);                                   ///< true or false
  std::optional<Real> number(const std::string& key, const NumberRange& range = {});  ///< within the range
  /// `least` to `most`.
  std::optional<Index> integer(const std::string& key, Index least, Index most);
  std::optional<Vec3> vector(const std::string& key);                          ///< three numbers
  std::optional<Eigen::Vector2d> pair(const std::string& key);                 ///< two numbers
  std::optional<Eigen::MatrixXd> rows(const std::string& key, Index columns);  ///< array of arrays of numbers
  std::vector<Real> numbers(const std::string& key);                           ///< array of numbers
  std::vector<std::string> texts(const std::string& key);                      ///< one string or an array of them
  std::vector<Index> indices(const std::string& key);                          ///< array of integers, not negative
  /// [key]; problems go where this reader's go.
  std::optional<TomlReader> table(const std::string& key);
  std::vector<TomlReader> tables(const std::string& key);  ///< [[key]]

  /// As above, and adds a problem when the key is missing; then the result is empty.
  std::string required_text(const std::string& key);
  std::optional<Real> required_number(const std::string& key, const NumberRange& range = {});  ///< as required_text
  std::optional<Vec3> required_vector(const std::string& key);                                 ///< as required_text

  /// Reads every setting of the struct that stands in the table.
  template <class Settings>
  void read_settings(Settings& settings) {
    for (const Setting<Settings>& each : setting_table<Settings>())
      if (const std::optional<SettingValue> value = setting(each)) each.set(settings, *value);
  }
  /// The value of a setting where it stands in the table and may be that; adds a problem where it may not.
  std::optional<SettingValue> setting(const SettingInfo& info);

  /// At the value of the key, or at the table where the key is missing.
  void add_problem(const std::string& key, const std::string& what, const std::string& remedy = "");
  /// At a value.
  void add_problem(const toml::node& node, const std::string& what, const std::string& remedy);
  /// One that knows its place.
  void add_problem(Problem problem) { problems_->push_back(std::move(problem)); }
  /// Adds a problem for each key that nobody asked for.
  void reject_unknown_keys();

  Problem place() const { return place_of(*table_); }  ///< of the table, with nothing said about it yet
  const std::string& title() const { return title_; }  ///< what the table is, for messages

 private:
  static std::optional<SettingValue> setting_value(const toml::node& node);
  std::nullopt_t wrong_type(const toml::node& node, const std::string& key, const std::string& expected);
  void missing(const std::string& key);

  const toml::table* table_;
  std::string title_;
  std::vector<Problem>* problems_;
  std::vector<std::string> known_;
};

}  // namespace gracilis
