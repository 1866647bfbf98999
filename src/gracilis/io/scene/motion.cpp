#include <gracilis/io/scene/motion.hpp>

#include <gracilis/anatomy/joints/joint_pose.hpp>
#include <gracilis/io/scene/files.hpp>
#include <gracilis/io/suggestions.hpp>
#include <gracilis/io/tables/table.hpp>
#include <gracilis/scene/motion.hpp>

#include <algorithm>

namespace gracilis::sections {

/// All coordinates turn or all shift: key poses in degrees or in mm.
static Real unit_of_coordinates(const MotionDescription& motion) { return motion.translations ? 0.001 : radians(1); }

/// Tells whether the motion is one through key poses.
static bool read_key_poses(TomlReader& table, MotionDescription& motion) {
  const Index columns = static_cast<Index>(motion.coordinates.size());
  motion.translations = table.has("key_poses_mm");
  const std::string key = motion.translations ? "key_poses_mm" : "key_poses_deg";
  const bool keyed = table.has(key);
  if (keyed && !motion.file.path.empty()) {
    table.add_problem(key, "the motion is given twice, by 'file' and by '" + key + "'", "keep one of the two");
  } else if (keyed && columns == 0) {
    table.add_problem(key, "'" + key + "' needs the key 'coordinates'", "the names of its columns");
  } else if (!keyed && motion.file.path.empty() && !table.has("max_frames")) {
    table.add_problem("file", "[motion] needs the key 'file' or the key 'key_poses_deg'");
  }
  if (keyed && columns > 0)
    motion.key_poses = table.rows(key, columns).value_or(Eigen::MatrixXd(0, columns)) * unit_of_coordinates(motion);
  return keyed;
}

static void read_steps(TomlReader& table, MotionDescription& motion, bool keyed) {
  const std::string key = motion.translations ? "step_mm" : "step_deg";
  const NumberRange steps = {0.001, 360, motion.translations ? "mm" : "degrees"};
  motion.step = table.number(key, steps).value_or(1) * unit_of_coordinates(motion);
  motion.time_step = table.number("time_step", {1e-6, 1000, "s"}).value_or(keyed ? 1.0 / 60 : 0);
}

static void read_bounds(TomlReader& table, MotionDescription& motion) {
  if (motion.file.path.empty()) {
    for (const char* bound : {"begin", "end"})
      if (table.has(bound)) table.add_problem(bound, "a motion through key poses is taken as a whole");
  }
  motion.begin = table.number("begin").value_or(motion.begin);
  motion.end = table.number("end").value_or(motion.end);
}

MotionDescription read_motion(TomlReader table) {
  MotionDescription motion;
  motion.place = table.place();
  motion.file = file_at(table, "file");
  motion.coordinates = table.texts("coordinates");
  const bool keyed = read_key_poses(table, motion);
  motion.max_frames = table.integer("max_frames", 1, 100'000'000).value_or(motion.max_frames);
  read_steps(table, motion, keyed);
  read_bounds(table, motion);
  table.reject_unknown_keys();
  return motion;
}

static std::vector<std::string> translation_names(const Scene& scene) {
  std::vector<std::string> names;
  for (const Joint& joint : scene.joints)
    for (const JointAxis& axis : joint.axes)
      if (axis.translation) names.push_back(axis.coordinate);
  return names;
}

/// A motion's file usually tells of more joints than the scene has; one that tells of none of them is the wrong file.
static void match_coordinates(SceneInProgress& progress, const std::string& file) {
  Motion& motion = progress.loaded.scene.motion;
  const std::vector<std::string>& asked_for = progress.description.motion.coordinates;
  const std::vector<std::string> known = asked_for.empty() ? coordinate_names(progress.loaded.scene) : asked_for;
  const std::vector<std::string> dropped = drop_unknown_coordinates(motion, known);
  const Problem place = {file, "", "", ""};
  for (const std::string& coordinate : known) {
    const std::vector<std::string>& found = motion.coordinates;
    if (std::find(found.begin(), found.end(), coordinate) != found.end()) continue;
    if (asked_for.empty()) {
      progress.loaded.warnings.push_back(file + ": has no column '" + coordinate + "'; it keeps its capture value");
    } else {
      progress.add_problem(place, "has no column '" + coordinate + "'", suggestion(coordinate, dropped));
    }
  }
  if (motion.coordinates.empty())
    progress.add_problem(place, "none of its columns is a coordinate of the scene", suggestion("", known));
}

static void read_rows(SceneInProgress& progress, const std::filesystem::path& path) {
  const MotionDescription& description = progress.description.motion;
  Scene& scene = progress.loaded.scene;
  const Table table = read_table(path);
  progress.add_warnings(table.warnings);
  scene.motion = motion_from_table(table, translation_names(scene));
  thin_out(scene.motion, description.begin, description.end, description.time_step);
  if (scene.motion.times.empty())
    progress.add_problem({path.string(), "", "", ""}, "no row of the motion is between its 'begin' and 'end'");
  match_coordinates(progress, path.string());
}

void add_motion(SceneInProgress& progress) {
  const MotionDescription& description = progress.description.motion;
  if (!description.file.path.empty()) {
    read_file(progress, description.file, [&](const std::filesystem::path& path) { read_rows(progress, path); });
  } else if (description.key_poses.rows() > 0) {
    Scene& scene = progress.loaded.scene;
    scene.motion = motion_through(description.coordinates, description.key_poses, description.step,
                                  description.time_step, description.max_frames);
    scene.motion.name = scene.name;
  }
}

}  // namespace gracilis::sections
