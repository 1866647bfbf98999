#include <gracilis/io/scene/transversals.hpp>

#include <algorithm>

namespace gracilis::sections {

static SectionCorner read_corner(TomlReader& table, const std::string& prefix) {
  SectionCorner corner;
  corner.section = table.integer(prefix + "section", 0, 1'000'000).value_or(0);
  corner.ray = table.integer(prefix + "ray", 0, 1'000'000).value_or(0);
  return corner;
}

TransversalDescription read_transversal(TomlReader table) {
  TransversalDescription description;
  description.place = table.place();
  description.muscle = table.required_text("muscle");
  description.transversal.moved = read_corner(table, "");
  description.other = table.text("other_muscle").value_or("");
  description.transversal.other = read_corner(table, "other_");
  description.bones = table.texts("bones");
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
