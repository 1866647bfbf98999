#include "targets.hpp"

#include <gracilis/calibrate/target_reader.hpp>
#include <gracilis/core/errors.hpp>
#include <gracilis/io/mesh/mesh_reader.hpp>
#include <gracilis/io/mesh/polyline_file.hpp>
#include <gracilis/io/run/output_hashes.hpp>
#include <gracilis/io/run/recorded_run.hpp>
#include <gracilis/io/run/run_manifest.hpp>
#include <gracilis/io/scene/field_cache.hpp>
#include <gracilis/io/scene/landmarks.hpp>
#include <gracilis/io/scene/prepared_cache.hpp>
#include <gracilis/io/scene/scene_description.hpp>
#include <gracilis/io/tables/activation_samples.hpp>
#include <gracilis/io/tables/arm_reference.hpp>
#include <gracilis/io/tables/table.hpp>
#include <gracilis/opensim/import/bone_files.hpp>
#include <gracilis/opensim/import/skeleton_fit.hpp>
#include <gracilis/opensim/reader/model_reader.hpp>
#include <gracilis/opensim/static_optimization/setup_reader.hpp>
#include <gracilis/study/run_record.hpp>
#include <gracilis/study/study_reader.hpp>
#include <gracilis/transfer/transfer_inputs.hpp>

#include <io/tiny_run.hpp>

#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace gracilis::fuzz {

namespace fs = std::filesystem;

namespace {

/// A folder of this process, in memory where there is a disk in memory.
class Folder {
 public:
  Folder() : path_((fs::exists("/dev/shm") ? fs::path("/dev/shm") : fs::temp_directory_path()) / name()) {
    fs::create_directories(path_);
  }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  fs::path write(const std::string& file, std::string_view bytes) const {
    std::ofstream(path_ / file, std::ios::binary) << bytes;
    return path_ / file;
  }
  const fs::path& path() const { return path_; }

 private:
  static std::string name() { return "gracilis-fuzz-" + std::to_string(::getpid()); }

  fs::path path_;
};

const Folder& folder() {
  static const Folder one;
  return one;
}

/// A run folder of three frames, whose tables are then replaced.
const fs::path& run_folder() {
  static const fs::path path = [] {
    const TinyRun run;
    fs::path made = folder().path() / "run";
    RunFolder out(made, run.scene, run.poses, ExistingRun::replace);
    for (int i = 0; i < 3; ++i) out.write_frame(run.record(i));
    RunManifest manifest;
    manifest.scene = "tiny";
    out.write_manifest(manifest);
    return made;
  }();
  return path;
}

Target mesh(const std::string& format) {
  return {format, [format](std::string_view bytes) { read_mesh(folder().write("mesh." + format, bytes), 0.001); }};
}

/// Forces for a model that has one body and one coordinate.
void read_forces(const fs::path& file) {
  static const opensim::Model model = opensim::read_model(folder().write(
      "pendulum.osim",
      "<OpenSimDocument Version='40000'><Model><BodySet><objects><Body name='rod'/></objects></BodySet><JointSet>"
      "<objects><PinJoint name='hinge'><socket_parent_frame>/ground</socket_parent_frame><socket_child_frame>"
      "/bodyset/rod</socket_child_frame><coordinates><Coordinate name='swing'/></coordinates></PinJoint></objects>"
      "</JointSet></Model></OpenSimDocument>"));
  opensim::Model changed = model;
  opensim::read_force_set(file, true, changed);
}

void require(bool understood) {
  if (!understood) throw InputError({"bytes", "", "are not what was expected", "give others"});
}

}  // namespace

const std::vector<Target>& targets() {
  static const std::vector<Target> all = {
      mesh("ply"),
      mesh("stl"),
      mesh("obj"),
      mesh("vtk"),
      mesh("vtp"),
      mesh("glb"),
      {"lines", [](std::string_view bytes) { read_polylines(folder().write("lines.vtk", bytes), 1); }},
      {"tck", [](std::string_view bytes) { read_polylines(folder().write("tracts.tck", bytes), 1); }},
      {"trk", [](std::string_view bytes) { read_polylines(folder().write("tracts.trk", bytes), 1); }},
      {"tracts", [](std::string_view bytes) { read_polylines(folder().write("tracts.csv", bytes), 1); }},
      {"scene", [](std::string_view bytes) { read_scene_description(folder().write("scene.toml", bytes), {}, {}); }},
      {"table", [](std::string_view bytes) { motion_from_table(read_table(folder().write("motion.sto", bytes)), {}); }},
      {"landmarks", [](std::string_view bytes) { read_landmarks(folder().write("landmarks.csv", bytes), 1); }},
      {"mapping", [](std::string_view bytes) { read_muscle_mapping(folder().write("mapping.toml", bytes)); }},
      {"model", [](std::string_view bytes) { opensim::read_model(folder().write("model.osim", bytes)); }},
      {"setup", [](std::string_view bytes) { opensim::read_setup(folder().write("setup.xml", bytes)); }},
      {"geometry", [](std::string_view bytes) { opensim::read_geometry_map(folder().write("map.toml", bytes)); }},
      {"fit", [](std::string_view bytes) { opensim::read_skeleton_fit(folder().write("fit.toml", bytes)); }},
      {"manifest",
       [](std::string_view bytes) {
         folder().write("run.json", bytes);
         read_manifest(folder().path());
       }},
      {"measures",
       [](std::string_view bytes) {
         std::ofstream(run_folder() / "measures.csv", std::ios::binary) << bytes;
         open_recorded_run(run_folder());
       }},
      {"hashes",
       [](std::string_view bytes) {
         folder().write(output_hashes_name, bytes);
         read_output_hashes(folder().path());
       }},
      {"study", [](std::string_view bytes) { read_study(folder().write("study.toml", bytes)); }},
      {"runs", [](std::string_view bytes) { read_study(folder().write("runs.csv", bytes)); }},
      {"targets",
       [](std::string_view bytes) {
         static const fs::path curves =
             folder().write("curves.csv", "muscle,angle_deg,moment_arm_mm\npsoas,10,-30\npsoas,20,-31\n");
         read_targets(folder().write("targets.toml", bytes));
       }},
      {"arms", [](std::string_view bytes) { read_arm_reference(folder().write("arms.csv", bytes)); }},
      {"points", [](std::string_view bytes) { read_landmark_points(folder().write("points.toml", bytes), 1); }},
      {"volumes", [](std::string_view bytes) { read_volumes(folder().write("volumes.csv", bytes)); }},
      {"record", [](std::string_view bytes) { read_run_record(folder().write("study.json", bytes)); }},
      {"forces", [](std::string_view bytes) { read_forces(folder().write("forces.xml", bytes)); }},
      // What stands behind the seal, without which nothing of a file is looked at.
      {"field", [](std::string_view bytes) { require(parse_field(bytes).has_value()); }},
      {"prepared", [](std::string_view bytes) { require(parse_prepared(bytes, 1).has_value()); }}};
  return all;
}

void run(const Target& target, std::string_view bytes) {
  try {
    target.read(bytes);
  } catch (const Error&) {
    // What cannot be read is told of.
  }
}

}  // namespace gracilis::fuzz
