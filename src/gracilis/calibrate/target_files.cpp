#include <gracilis/calibrate/target_files.hpp>

#include <gracilis/io/csv_rows.hpp>
#include <gracilis/io/input_file.hpp>
#include <gracilis/io/mesh/load_surface.hpp>
#include <gracilis/io/scene/data_root.hpp>
#include <gracilis/io/suggestions.hpp>
#include <gracilis/io/tables/arm_reference.hpp>

#include <algorithm>
#include <set>

namespace gracilis {

namespace fs = std::filesystem;

fs::path TargetFiles::located(TomlReader& reader, const std::string& file) const {
  if (file.empty()) return {};
  std::vector<fs::path> places = {targets_.parent_path() / file};
  if (const fs::path root = find_data_root(targets_, data_); !root.empty()) places.push_back(root / file);
  for (const fs::path& place : places)
    if (is_there(place)) {
      if (std::find(inputs_.begin(), inputs_.end(), place) == inputs_.end()) inputs_.push_back(place);
      return place;
    }
  Problem problem = reader.place();
  if (const toml::node* node = reader.find("file")) problem = place_of(*node);
  problem.what = "the file '" + file + "' is not there";
  problem.remedy = "looked for in " + places[0].string() + (places.size() > 1 ? " and " + places[1].string() : "");
  of_files_.push_back(problem);
  return {};
}

template <class Read>
void TargetFiles::guarded(const Read& read) const {
  try {
    read();
  } catch (const InputError& error) {
    of_files_.insert(of_files_.end(), error.problems().begin(), error.problems().end());
  }
}

static TargetPart part_of(const ArmCurve& curve, const CurveChoice& choice) {
  constexpr Real rounding = 1e-9;
  const auto renamed = choice.names.find(curve.muscle);
  TargetPart part{renamed == choice.names.end() ? curve.muscle : renamed->second, curve.source};
  for (std::size_t i = 0; i < curve.angles.size(); ++i) {
    const Real angle = curve.angles[i];
    if (angle < choice.from - rounding || angle > choice.to + rounding) continue;
    if (!part.at.empty() && angle < part.at.back() + choice.spacing - rounding) continue;
    part.at.push_back(angle);
    part.values.push_back(curve.arms[i]);
  }
  return part;
}

static bool holds(const std::vector<std::string>& names, const std::string& name) {
  return names.empty() || std::find(names.begin(), names.end(), name) != names.end();
}

void TargetFiles::read_curves(TomlReader& reader, const std::string& file, const CurveChoice& choice,
                              CalibrationTarget& target) const {
  const fs::path path = located(reader, file);
  if (path.empty()) return;
  guarded([&] {
    const std::vector<ArmCurve> curves = target.kind == TargetKind::lengths
                                             ? read_length_reference(path, target.coordinate)
                                             : read_arm_reference(path, target.coordinate);
    std::set<std::string> muscles, sources;
    for (const ArmCurve& curve : curves) {
      muscles.insert(choice.names.contains(curve.muscle) ? choice.names.at(curve.muscle) : curve.muscle);
      sources.insert(curve.source);
      if (!curve.coordinate.empty() && curve.coordinate != target.coordinate) continue;
      TargetPart part = part_of(curve, choice);
      if (!holds(choice.muscles, part.muscle) || !holds(choice.sources, part.source)) continue;
      if (!part.at.empty()) target.parts.push_back(std::move(part));
    }
    for (const auto& [key, wanted, known] :
         {std::tuple{"muscles", &choice.muscles, &muscles}, {"sources", &choice.sources, &sources}})
      for (const std::string& name : *wanted)
        if (!known->contains(name))
          return reader.add_problem(
              key, "'" + file + "' has no " + (key[0] == 'm' ? "muscle" : "source") + " '" + name + "'",
              suggestion(name, {known->begin(), known->end()}));
    if (target.parts.empty())
      reader.add_problem("file", "'" + file + "' tells nothing of '" + target.coordinate + "' in this range",
                         "look at its columns coordinate and angle_deg");
  });
}

void TargetFiles::read_volumes(TomlReader& reader, const std::string& file, CalibrationTarget& target) const {
  const fs::path path = located(reader, file);
  if (path.empty()) return;
  guarded([&] {
    const std::string text = read_text(path);
    CsvRows rows(path, text);
    const std::optional<std::size_t> muscle = rows.column("muscle"), volume = rows.column("volume_cm3");
    if (!muscle || !volume) rows.fail("names no columns 'muscle' and 'volume_cm3'", "the first line must name them");
    std::set<std::string> names;
    while (rows.next()) {
      const std::string name(rows.cell(*muscle));
      const Real value = rows.number(*volume, "a volume");
      if (!(value > 0)) rows.fail("has a volume that is not above 0");
      if (!names.insert(name).second) rows.fail("tells '" + name + "' twice");
      target.parts.push_back({name, "", {}, {1e-6 * value}});
    }
    if (target.parts.empty()) rows.fail("holds no volumes");
  });
}

void TargetFiles::read_shape(TomlReader& reader, const std::string& muscle, const std::string& file,
                             CalibrationTarget& target) const {
  const std::string unit = reader.text("unit").value_or("m");
  const Real length = unit == "mm" ? 0.001 : unit == "cm" ? 0.01 : 1;
  if (unit != "m" && unit != "cm" && unit != "mm") reader.add_problem("unit", "'unit' must be \"m\", \"cm\" or \"mm\"");
  const fs::path path = located(reader, file);
  if (path.empty()) return;
  guarded([&] {
    // A target may have holes, as what was cut from a scan has.
    LoadedMesh loaded = load_surface(path, length, SurfaceRole::bone);
    target.parts.push_back(
        {muscle, path.filename().string(), {}, {}, std::make_shared<TriangleMesh>(std::move(loaded.mesh))});
  });
}

}  // namespace gracilis
