#include <gracilis/io/toml_reader.hpp>

#include <gracilis/core/whole_number.hpp>
#include <gracilis/io/suggestions.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <tuple>

namespace gracilis {

Problem place_of(const toml::node& node) {
  const toml::source_region& region = node.source();
  Problem problem;
  if (region.path) problem.file = *region.path;
  // What the command line says has no lines.
  if (region.begin && !problem.file.starts_with("--")) {
    problem.where = std::to_string(region.begin.line) + ":" + std::to_string(region.begin.column);
  }
  return problem;
}

void sort_by_place(std::vector<Problem>& problems) {
  const auto key = [](const Problem& problem) {
    int line = 0, column = 0;
    std::sscanf(problem.where.c_str(), "%d:%d", &line, &column);
    return std::make_tuple(problem.file, line, column);
  };
  std::stable_sort(problems.begin(), problems.end(),
                   [&](const Problem& a, const Problem& b) { return key(a) < key(b); });
}

void TomlReader::add_problem(const toml::node& node, const std::string& what, const std::string& remedy) {
  Problem problem = place_of(node);
  problem.what = what;
  problem.remedy = remedy;
  problems_->push_back(std::move(problem));
}

void TomlReader::add_problem(const std::string& key, const std::string& what, const std::string& remedy) {
  const toml::node* node = find(key);
  add_problem(node ? *node : *table_, what, remedy);
}

std::nullopt_t TomlReader::wrong_type(const toml::node& node, const std::string& key, const std::string& expected) {
  add_problem(node, "'" + key + "' must be " + expected, "");
  return std::nullopt;
}

void TomlReader::missing(const std::string& key) { add_problem(*table_, title_ + " needs the key '" + key + "'", ""); }

const toml::node* TomlReader::find(const std::string& key) {
  if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.push_back(key);
  return table_->get(key);
}

std::optional<std::string> TomlReader::text(const std::string& key) {
  const toml::node* node = find(key);
  if (!node) return std::nullopt;
  if (!node->is_string() || node->as_string()->get().empty()) return wrong_type(*node, key, "a text in quotes");
  return node->as_string()->get();
}

std::optional<bool> TomlReader::flag(const std::string& key) {
  const toml::node* node = find(key);
  if (!node) return std::nullopt;
  if (!node->is_boolean()) return wrong_type(*node, key, "true or false");
  return node->as_boolean()->get();
}

/// A finite integer or float as a number.
static std::optional<Real> number_of(const toml::node& node) {
  if (!node.is_number()) return std::nullopt;
  const std::optional<Real> value = node.value<Real>();
  return value && std::isfinite(*value) ? value : std::nullopt;
}

std::optional<Real> TomlReader::number(const std::string& key, const NumberRange& range) {
  const toml::node* node = find(key);
  if (!node) return std::nullopt;
  const std::optional<Real> value = number_of(*node);
  const bool bounded = range.minimum > NumberRange{}.minimum;
  if (value && *value >= range.minimum && *value <= range.maximum) return value;
  std::string expected = "a number";
  if (bounded) expected += " from " + to_text(range.minimum) + " to " + to_text(range.maximum);
  if (!range.unit.empty()) expected += (bounded ? " " : " in ") + range.unit;
  return wrong_type(*node, key, expected);
}

std::optional<Index> TomlReader::integer(const std::string& key, Index least, Index most) {
  const toml::node* node = find(key);
  if (!node) return std::nullopt;
  const std::optional<Real> value = number_of(*node);
  const std::optional<Index> whole = value ? whole_number<Index>(*value, least, most) : std::nullopt;
  if (whole) return whole;
  return wrong_type(*node, key, "an integer from " + std::to_string(least) + " to " + std::to_string(most));
}

std::optional<Vec3> TomlReader::vector(const std::string& key) {
  const toml::node* node = find(key);
  if (!node) return std::nullopt;
  const std::optional<SettingValue> value = setting_value(*node);
  if (!value || !std::holds_alternative<Vec3>(*value)) return wrong_type(*node, key, "three numbers in brackets");
  return std::get<Vec3>(*value);
}

std::optional<Eigen::Vector2d> TomlReader::pair(const std::string& key) {
  const toml::node* node = find(key);
  if (!node) return std::nullopt;
  const toml::array* array = node->as_array();
  if (!array || array->size() != 2) return wrong_type(*node, key, "two numbers in brackets");
  const std::optional<Real> first = number_of((*array)[0]), second = number_of((*array)[1]);
  if (!first || !second) return wrong_type(*node, key, "two numbers in brackets");
  return Eigen::Vector2d(*first, *second);
}

std::optional<Eigen::MatrixXd> TomlReader::rows(const std::string& key, Index columns) {
  const toml::node* node = find(key);
  if (!node) return std::nullopt;
  const std::string expected = "an array of arrays of " + std::to_string(columns) + " numbers each";
  const toml::array* array = node->as_array();
  if (!array || array->empty()) return wrong_type(*node, key, expected);
  Eigen::MatrixXd values(array->size(), columns);
  for (std::size_t row = 0; row < array->size(); ++row) {
    const toml::array* numbers = (*array)[row].as_array();
    if (!numbers || static_cast<Index>(numbers->size()) != columns) return wrong_type((*array)[row], key, expected);
    for (Index column = 0; column < columns; ++column) {
      const std::optional<Real> value = number_of((*numbers)[column]);
      if (!value) return wrong_type((*numbers)[column], key, expected);
      values(row, column) = *value;
    }
  }
  return values;
}

std::vector<Real> TomlReader::numbers(const std::string& key) {
  const toml::node* node = find(key);
  if (!node) return {};
  std::vector<Real> result;
  if (const toml::array* array = node->as_array())
    for (const toml::node& element : *array)
      if (const std::optional<Real> value = number_of(element)) result.push_back(*value);
  const bool whole = node->is_array() && !result.empty() && result.size() == node->as_array()->size();
  if (!whole) wrong_type(*node, key, "an array of numbers");
  return result;
}

std::vector<std::string> TomlReader::texts(const std::string& key) {
  const toml::node* node = find(key);
  if (!node) return {};
  if (node->is_string()) return {node->as_string()->get()};
  std::vector<std::string> result;
  const toml::array* array = node->as_array();
  if (array) {
    for (const toml::node& element : *array) {
      if (!element.is_string()) {
        wrong_type(element, key, "texts in quotes");
        return {};
      }
      result.push_back(element.as_string()->get());
    }
  }
  if (result.empty()) wrong_type(*node, key, "a text in quotes or an array of such texts");
  return result;
}

std::vector<Index> TomlReader::indices(const std::string& key) {
  const toml::node* node = find(key);
  if (!node) return {};
  std::vector<Index> result;
  const toml::array* array = node->as_array();
  if (!array || array->empty()) {
    wrong_type(*node, key, "an array of integers, 0 or more");
    return {};
  }
  for (const toml::node& element : *array) {
    const std::optional<int64_t> value = element.is_integer() ? element.value<int64_t>() : std::nullopt;
    if (!value || *value < 0 || *value > std::numeric_limits<Index>::max()) {
      wrong_type(element, key, "an array of integers, 0 or more");
      return {};
    }
    result.push_back(static_cast<Index>(*value));
  }
  return result;
}

std::optional<TomlReader> TomlReader::table(const std::string& key) {
  const toml::node* node = find(key);
  if (!node) return std::nullopt;
  if (!node->is_table()) return wrong_type(*node, key, "a table: [" + key + "]");
  return TomlReader(*node->as_table(), "[" + key + "]", *problems_);
}

std::vector<TomlReader> TomlReader::tables(const std::string& key) {
  const toml::node* node = find(key);
  if (!node) return {};
  std::vector<TomlReader> result;
  const toml::array* array = node->as_array();
  if (!array) wrong_type(*node, key, "a list of tables: [[" + key + "]]");
  for (std::size_t i = 0; array && i < array->size(); ++i) {
    if (const toml::table* element = (*array)[i].as_table()) {
      result.emplace_back(*element, "[[" + key + "]]", *problems_);
    } else {
      wrong_type((*array)[i], key, "a list of tables: [[" + key + "]]");
    }
  }
  return result;
}

std::string TomlReader::required_text(const std::string& key) {
  if (!has(key)) missing(key);
  return text(key).value_or("");
}

std::optional<Real> TomlReader::required_number(const std::string& key, const NumberRange& range) {
  if (!has(key)) missing(key);
  return number(key, range);
}

std::optional<Vec3> TomlReader::required_vector(const std::string& key) {
  if (!has(key)) missing(key);
  return vector(key);
}

std::optional<SettingValue> TomlReader::setting_value(const toml::node& node) {
  if (node.is_boolean()) return SettingValue(node.as_boolean()->get());
  if (node.is_string()) return SettingValue(node.as_string()->get());
  if (node.is_integer()) {
    const int64_t value = node.as_integer()->get();
    if (value >= std::numeric_limits<int>::min() && value <= std::numeric_limits<int>::max()) {
      return SettingValue(static_cast<int>(value));
    }
    return SettingValue(static_cast<Real>(value));
  }
  if (node.is_floating_point()) return SettingValue(node.as_floating_point()->get());
  const toml::array* array = node.as_array();
  if (!array || array->size() != 3) return std::nullopt;
  Vec3 vector;
  for (int i = 0; i < 3; ++i) {
    const std::optional<Real> value = number_of((*array)[i]);
    if (!value) return std::nullopt;
    vector[i] = *value;
  }
  return SettingValue(vector);
}

std::optional<SettingValue> TomlReader::setting(const SettingInfo& info) {
  const std::string key(info.key);
  const toml::node* node = find(key);
  if (!node) return std::nullopt;
  std::optional<SettingValue> value = setting_value(*node);
  if (value) value = accepted(info, *value);
  if (!value) add_problem(*node, "'" + key + "' must be " + expectation(info), "");
  return value;
}

/// A list of more keys than this helps nobody.
static constexpr std::size_t most_listed = 40;

void TomlReader::reject_unknown_keys() {
  for (const auto& [key, node] : *table_) {
    if (std::find(known_.begin(), known_.end(), key.str()) != known_.end()) continue;
    Problem problem = place_of(node);
    // The key's own place, not its value's.
    if (key.source().begin && !problem.where.empty()) {
      problem.where = std::to_string(key.source().begin.line) + ":" + std::to_string(key.source().begin.column);
    }
    problem.what = "unknown key '" + std::string(key.str()) + "' in " + title_;
    const bool is_too_long = known_.size() > most_listed && nearest_word(key.str(), known_).empty();
    problem.remedy = is_too_long ? "'gracilis print-config' lists all that are known" : suggestion(key.str(), known_);
    problems_->push_back(std::move(problem));
  }
}

}  // namespace gracilis
