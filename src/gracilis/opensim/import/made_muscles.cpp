#include <gracilis/opensim/import/made_muscles.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/opensim/import/drawn_apart.hpp>
#include <gracilis/opensim/import/muscle_heads.hpp>
#include <gracilis/opensim/import/sheet_volume.hpp>
#include <gracilis/scene/section_line.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>

namespace gracilis::opensim {

/// The muscles asked for, in the model's order.
static std::vector<const Muscle*> chosen(const Model& model, const std::vector<std::string>& names) {
  std::vector<const Muscle*> muscles;
  for (const std::string& name : names)
    if (index_of(model.muscles, name) < 0)
      throw ConfigurationError({"--muscles", "", fmt::format("the model has no muscle '{}'", name), ""});
  for (const Muscle& muscle : model.muscles)
    if (names.empty() || std::find(names.begin(), names.end(), muscle.name) != names.end()) muscles.push_back(&muscle);
  return muscles;
}

/// As each would be alone; those that have no volume are told of later.
static std::map<std::string, RoundMuscle> round_muscles(const Model& model, const std::vector<const Muscle*>& muscles,
                                                        const std::vector<RigidTransform>& poses,
                                                        const Eigen::VectorXd& coordinates,
                                                        const VolumeSettings& settings) {
  std::map<std::string, RoundMuscle> round;
  for (const Muscle* muscle : muscles) {
    if (settings.surfaces.count(muscle->name) > 0) continue;
    try {
      round[muscle->name] = round_muscle(model, *muscle, poses, coordinates, settings);
    } catch (const InputError&) {
    }
  }
  return round;
}

/// The sheets that are to be made, by their first head.
static std::map<const Muscle*, MuscleHeads> sheets_of(const std::vector<const Muscle*>& muscles,
                                                      const SceneFolderSettings& settings) {
  std::map<const Muscle*, MuscleHeads> sheets;
  if (!settings.merge_heads) return sheets;
  const auto is_known = [&](const Muscle* muscle) { return settings.volumes.surfaces.count(muscle->name) > 0; };
  for (const MuscleHeads& sheet : heads_among(muscles))
    if (std::none_of(sheet.heads.begin(), sheet.heads.end(), is_known)) sheets[sheet.heads[0]] = sheet;
  return sheets;
}

/// Draws surfaces apart whose shapes are of lines alone: sheets, and what is known, stay.
static void draw_apart(std::vector<MadeMuscle>& made) {
  std::vector<MuscleVolume*> volumes;
  std::vector<SectionedSurface> surfaces;
  for (auto& [name, volume] : made)
    if (volume.sections_on_surface == 0 && volume.line.heads.empty()) {
      volumes.push_back(&volume);
      surfaces.push_back({volume.surface, section_line(volume.line).centers});
    }
  draw_apart(surfaces);
  for (std::size_t m = 0; m < volumes.size(); ++m) {
    const TriangleMesh &before = volumes[m]->surface, &now = surfaces[m].surface;
    volumes[m]->volume_share *=
        enclosed_volume(now.vertices, now.faces) / enclosed_volume(before.vertices, before.faces);
    volumes[m]->surface = now;
  }
}

std::vector<MadeMuscle> made_muscles(const Model& model, const std::vector<RigidTransform>& poses,
                                     const Eigen::VectorXd& coordinates, const SceneFolderSettings& settings,
                                     VolumeSettings volumes, SceneFolderNotes& notes) {
  const std::vector<const Muscle*> muscles = chosen(model, settings.muscles);
  if (settings.apart)
    volumes.beside = beside_bellies(round_muscles(model, muscles, poses, coordinates, volumes), *volumes.bones);
  const std::map<const Muscle*, MuscleHeads> sheets = sheets_of(muscles, settings);
  std::vector<MadeMuscle> made;
  std::set<const Muscle*> merged;
  for (const Muscle* muscle : muscles) {
    if (const auto sheet = sheets.find(muscle); sheet != sheets.end()) {
      const auto& [name, heads] = sheet->second;
      try {
        made.push_back({name, sheet_volume(model, heads, poses, coordinates, volumes)});
        merged.insert(heads.begin(), heads.end());
        std::vector<std::string> names;
        for (const ActionLine& head : made.back().volume.line.heads) names.push_back(head.name);
        notes.sheets.push_back(fmt::format("{}: a sheet over {}", name, fmt::join(names, ", ")));
      } catch (const InputError& error) {
        notes.left_out.push_back(fmt::format("{}: its heads stay apart: {}", name, error.what()));
      }
    }
    if (merged.count(muscle) > 0) continue;
    try {
      made.push_back({muscle->name, muscle_volume(model, *muscle, poses, coordinates, volumes)});
    } catch (const InputError& error) {
      notes.left_out.push_back(error.what());
    }
  }
  if (settings.apart) draw_apart(made);
  return made;
}

}  // namespace gracilis::opensim
