#include <gracilis/io/run/inspect_run.hpp>

#include <gracilis/anatomy/joints/joint_pose.hpp>
#include <gracilis/core/errors.hpp>
#include <gracilis/io/input_file.hpp>
#include <gracilis/io/run/run_manifest.hpp>
#include <gracilis/io/scene/scene_reader.hpp>
#include <gracilis/io/text_cells.hpp>
#include <gracilis/io/value_reader.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace gracilis {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

/// The worst that each muscle showed in any frame, from measures.csv.
static Json worst_measures(const fs::path& path) {
  const std::string text = read_text(path);
  ValueReader reader(path, text);
  const std::vector<std::string_view> columns = cells_of(reader.line());
  const auto column_of = [&](std::string_view name) {
    const auto found = std::find(columns.begin(), columns.end(), name);
    if (found == columns.end()) reader.fail("has no column '" + std::string(name) + "'", "run the scene again");
    return static_cast<std::size_t>(found - columns.begin());
  };
  const std::size_t muscle_column = column_of("muscle");
  struct Worst {
    std::string label;
    std::size_t column;
    Real reference;  ///< what is farthest from this is worst
  };
  std::vector<Worst> worst;
  for (const auto& [name, reference] : {std::pair{"volume_ratio", 1.0},
                                        {"edge_ratio_mean", 1.0},
                                        {"edge_ratio_max_free", 1.0},
                                        {"vertex_depth_beyond_rest_mm", 0.0},
                                        {"midpoint_depth_beyond_rest_mm", 0.0},
                                        {"milliseconds", 0.0}}) {
    worst.push_back({name, column_of(name), reference});
  }
  // Runs made before these were measured do not have them.
  for (const auto& [name, reference] : {std::pair{"edge_ratio_max_near", 1.0},
                                        {"spike", 0.0},
                                        {"thickening", 1.0},
                                        {"thinning", 1.0},
                                        {"muscle_depth_beyond_rest_mm", 0.0},
                                        {"belly_off_place_mm", 0.0},
                                        {"wrong_side_share", 0.0},
                                        {"slack", 0.0}})
    if (std::find(columns.begin(), columns.end(), name) != columns.end())
      worst.push_back({name, column_of(name), reference});
  std::vector<std::string> names;
  std::map<std::string, std::vector<Real>> found;
  while (!reader.at_end()) {
    const std::vector<std::string_view> cells = cells_of(reader.line());
    if (cells.size() != columns.size()) continue;  // a row that an interruption cut off
    const std::string name(cells[muscle_column]);
    if (!found.contains(name)) {
      names.push_back(name);
      found[name].assign(worst.size(), std::nan(""));
    }
    for (std::size_t i = 0; i < worst.size(); ++i) {
      double value = 0;
      if (cells[worst[i].column].empty()) continue;  // not measured
      if (!parse_number(cells[worst[i].column], value) || !std::isfinite(value))
        reader.fail("holds what is not a finite number", "run the scene again");
      Real& sofar = found[name][i];
      if (!(std::abs(value - worst[i].reference) <= std::abs(sofar - worst[i].reference))) sofar = value;
    }
  }
  Json muscles = Json::array();
  for (const std::string& name : names) {
    Json muscle = {{"name", name}};
    for (std::size_t i = 0; i < worst.size(); ++i)
      muscle[worst[i].label] = std::isnan(found[name][i]) ? Json(nullptr) : Json(found[name][i]);
    muscles.push_back(muscle);
  }
  return muscles;
}

Json inspect_run(const fs::path& folder) {
  const Json manifest = read_manifest(folder);
  Json description = {{"kind", "run folder"}};
  for (const char* key :
       {"status", "scene", "preset", "gracilis", "written", "frames", "seconds", "threads", "guessed", "warnings"}) {
    if (manifest.contains(key)) description[key] = manifest[key];
  }
  if (fs::exists(folder / "measures.csv")) description["worst_of_all_frames"] = worst_measures(folder / "measures.csv");
  return description;
}

Json inspect_scene(const fs::path& path) {
  const LoadedScene loaded = read_scene(path);
  const Scene& scene = loaded.scene;
  Json bones = Json::array(), coordinates = Json::array(), muscles = Json::array();
  for (const Bone& bone : scene.bones) {
    bones.push_back({{"name", bone.name},
                     {"body", scene.bodies[static_cast<std::size_t>(bone.body)]},
                     {"triangles", bone.surface.face_count()}});
  }
  for (const Joint& joint : scene.joints) {
    for (const JointAxis& axis : joint.axes) {
      coordinates.push_back({{"name", axis.coordinate},
                             {"joint", joint.name},
                             {std::string("capture_") + shown_unit(axis), shown_value(axis, axis.capture_value)}});
    }
  }
  for (const Muscle& muscle : scene.muscles) {
    std::size_t attached = 0;
    for (const Attachment& attachment : muscle.attachments) attached += attachment.vertices.size();
    muscles.push_back({{"name", muscle.name},
                       {"vertices", muscle.surface.vertex_count()},
                       {"attachments", muscle.attachments.size()},
                       {"attached_vertices", attached}});
  }
  return {{"kind", "scene"},
          {"name", scene.name},
          {"preset", loaded.preset},
          {"bodies", scene.bodies},
          {"bones", bones},
          {"coordinates", coordinates},
          {"muscles", muscles},
          {"rest_overlaps", overlaps_json(report_overlaps(scene))},
          {"motion", scene.motion.name},
          {"motion_rows", scene.motion.times.size()},
          {"warnings", loaded.warnings}};
}

}  // namespace gracilis
