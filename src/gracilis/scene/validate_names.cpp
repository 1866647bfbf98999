#include <gracilis/scene/validate_names.hpp>

#include <gracilis/scene/names.hpp>

#include <algorithm>
#include <map>
#include <set>

namespace gracilis {

/// "muscle 'psoas'"; what is far too long is cut.
static std::string bearer(const std::string& kind, const std::string& name) {
  return kind + " '" + name.substr(0, longest_name) + "'";
}

static const std::string length_remedy = "use at most " + std::to_string(longest_name) + " letters";

/// Bones and muscles are files of one folder.
static void check_files(const std::string& kind, const std::string& name, std::map<std::string, std::string>& taken,
                        std::vector<Problem>& problems) {
  if (name.size() > longest_name)
    problems.push_back({"", bearer(kind, name), "the name is too long", length_remedy});
  else if (!fits_file_name(name))
    problems.push_back(
        {"", bearer(kind, name), "the name is not fit for a file's name", "use letters, digits, '_', '-' and '.'"});
  const auto [other, is_new] = taken.emplace(name, kind);
  if (is_new) return;
  if (other->second == kind)
    problems.push_back({"", bearer(kind, name), "duplicate name", ""});
  else
    problems.push_back({"", bearer(kind, name), "a " + other->second + " has the same name",
                        "rename one of them: each is a file of its name"});
}

static void check_coordinate(const JointAxis& axis, std::vector<Problem>& problems) {
  const std::string& name = axis.coordinate;
  if (name.empty()) return;  // reported with its joint
  if (name.size() > longest_name)
    problems.push_back({"", bearer("coordinate", name), "the name is too long", length_remedy});
  else if (!fits_column(name))
    problems.push_back({"", bearer("coordinate", name), "the name is not fit for a column of a table",
                        "use letters, digits, '_' and '-', and not 'time'"});
  const std::string column = name + (axis.translation ? "_mm" : "_deg");
  const std::vector<std::string>& measures = measure_columns();
  if (std::find(measures.begin(), measures.end(), column) != measures.end())
    problems.push_back(
        {"", bearer("coordinate", name), "measures have a column '" + column + "', too", "rename the coordinate"});
}

/// "psoas" of "psoas_f007", as tables call a fiber; empty of all other names.
static std::string muscle_of_fiber(const std::string& name) {
  const std::size_t at = name.rfind("_f");
  if (at == std::string::npos || name.size() < at + 5) return {};
  return name.find_first_not_of("0123456789", at + 2) == std::string::npos ? name.substr(0, at) : std::string();
}

std::vector<Problem> name_problems(const Scene& scene) {
  std::vector<Problem> problems;
  if (std::any_of(scene.name.begin(), scene.name.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }))
    problems.push_back({"", "", "the scene's name holds a control character", "write it on one line"});
  std::map<std::string, std::string> files;
  for (const Bone& bone : scene.bones) check_files("bone", bone.name, files, problems);
  std::set<std::string> muscles;
  for (const Muscle& muscle : scene.muscles) {
    check_files("muscle", muscle.name, files, problems);
    muscles.insert(muscle.name);
  }
  // Coordinates, muscles and their fibers are columns of one table.
  const auto check_fiber = [&](const std::string& kind, const std::string& name) {
    if (const std::string muscle = muscle_of_fiber(name); muscles.contains(muscle))
      problems.push_back({"", bearer(kind, name), "a fiber of the muscle '" + muscle + "' is called so in tables",
                          "rename one of them"});
  };
  for (const Joint& joint : scene.joints)
    for (const JointAxis& axis : joint.axes) {
      check_coordinate(axis, problems);
      check_fiber("coordinate", axis.coordinate);
      if (muscles.contains(axis.coordinate))
        problems.push_back({"", bearer("coordinate", axis.coordinate), "a muscle has the same name",
                            "rename one of them: each is a column of its name"});
    }
  for (const std::string& muscle : muscles) check_fiber("muscle", muscle);
  return problems;
}

}  // namespace gracilis
