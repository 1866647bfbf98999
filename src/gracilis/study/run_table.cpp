#include <gracilis/study/run_table.hpp>

#include <gracilis/io/csv_rows.hpp>
#include <gracilis/io/input_file.hpp>
#include <gracilis/io/value_reader.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace gracilis {

std::string run_name(Index number) { return fmt::format("{:04}", number); }

bool give_value(StudyRun& run, const std::string& key, const std::string& value) {
  if (key == "scene") {
    run.scene = value == "demo elbow" ? "demo-elbow" : value;
  } else if (key == "flexion") {
    double angle = 0;
    if (!parse_number(value, angle) || !(angle >= 0 && angle <= 130)) return false;
    run.flexion_deg = angle;
  } else {
    run.set.push_back(key + "=" + value);
  }
  return true;
}

/// A name that can be one of a folder, on every disk.
static bool is_run_name(const std::string& name) {
  const auto is_plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '_' ||
           c == '-';
  };
  return !name.empty() && name.size() <= 100 && name[0] != '.' && name[0] != '-' &&
         std::all_of(name.begin(), name.end(), is_plain);
}

/// What the table's columns are about: their keys, without the one that names the runs.
static std::vector<std::string> keys_of(const CsvRows& rows) {
  std::vector<std::string> keys;
  std::set<std::string_view> seen;
  for (const std::string_view label : rows.labels()) {
    if (label.empty()) rows.fail("has a column without a name", "name the key that it holds");
    if (label.find('=') != std::string_view::npos)
      rows.fail("the column '" + std::string(label) + "' is no key", "a key is what stands before the = of --set");
    if (!seen.insert(label).second) rows.fail("has two columns '" + std::string(label) + "'", "remove one");
    if (label != "run") keys.emplace_back(label);
  }
  return keys;
}

void read_run_table(const std::filesystem::path& file, const std::string& scene, Study& study) {
  const std::string text = read_text(file);
  CsvRows rows(file, text);
  study.parameters = keys_of(rows);
  const std::optional<std::size_t> named = rows.column("run");
  std::set<std::string> names;
  while (rows.next()) {
    StudyRun run;
    run.scene = scene;
    run.name = named ? std::string(rows.cell(*named)) : run_name(static_cast<Index>(study.runs.size()) + 1);
    if (!is_run_name(run.name))
      rows.fail("'" + run.name + "' cannot name a run", "take letters, digits, dots, _ and -");
    if (!names.insert(run.name).second) rows.fail("there are two runs '" + run.name + "'", "rename one");
    for (std::size_t column = 0; column < rows.labels().size(); ++column) {
      if (named == column) continue;
      const std::string value(rows.cell(column));
      if (!value.empty() && !give_value(run, std::string(rows.labels()[column]), value))
        rows.fail("'" + value + "' is no flexion", "0 to 130 degrees");
      run.values.push_back(value);
    }
    if (run.scene.empty()) rows.fail("names no scene", "add a column 'scene': a file, demo or demo-elbow");
    if (study.runs.size() == static_cast<std::size_t>(most_study_runs))
      rows.fail(fmt::format("has more than {} runs", most_study_runs), "make several studies of it");
    study.runs.push_back(std::move(run));
  }
}

}  // namespace gracilis
