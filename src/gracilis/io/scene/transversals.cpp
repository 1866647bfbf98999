#include <gracilis/io/scene/transversals.hpp>

#include <algorithm>

namespace gracilis::sections {

static SectionCorner read_corner(TomlReader& table, const std::string& prefix) {
  const auto required = [&](const std::string& key) {
    if (!table.has(key)) table.required_number(key);
    return table.integer(key, 0, 1'000'000).value_or(0);
  };
  SectionCorner corner;
  corner.section = required(prefix + "section");
  corner.ray = required(prefix + "ray");
  return corner;
}

TransversalDescription read_transversal(TomlReader table) {
  TransversalDescription description;
  description.place = table.place();
  description.muscle = table.required_text("muscle");
  description.transversal.moved = read_corner(table, "");
  description.other = table.text("other_muscle").value_or("");
  description.bones = table.texts("bones");
  if (!description.other.empty()) {
    description.transversal.other = read_corner(table, "other_");
  } else {
    for (const char* key : {"other_section", "other_ray"})
      if (table.has(key))
        table.add_problem(key, "'" + std::string(key) + "' says where on a muscle that is not named",
                          "give 'other_muscle'");
    if (description.bones.empty())
      table.add_problem("muscle", "a transversal that keeps out of nothing", "give 'other_muscle' or 'bones', or both");
  }
  table.reject_unknown_keys();
  return description;
}

/// -1: there is none.
static Index muscle_index(const Scene& scene, const std::string& name) {
  const auto found = std::find_if(scene.muscles.begin(), scene.muscles.end(),
                                  [&](const Muscle& muscle) { return muscle.name == name; });
  return found == scene.muscles.end() ? -1 : static_cast<Index>(found - scene.muscles.begin());
}

void add_transversals(SceneInProgress& progress) {
  Scene& scene = progress.loaded.scene;
  for (const TransversalDescription& description : progress.description.transversals) {
    Transversal transversal = description.transversal;
    transversal.moved.muscle = muscle_index(scene, description.muscle);
    transversal.other.muscle = muscle_index(scene, description.other);
    if (transversal.moved.muscle < 0) continue;
    const std::vector<std::string>& bones = description.bones;
    for (std::size_t bone = 0; bone < scene.bones.size(); ++bone)
      if (std::find(bones.begin(), bones.end(), scene.bones[bone].name) != bones.end())
        transversal.bones.push_back(static_cast<Index>(bone));
    scene.transversals.push_back(std::move(transversal));
  }
}

}  // namespace gracilis::sections
