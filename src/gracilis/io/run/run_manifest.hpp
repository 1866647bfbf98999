#pragma once

#include <gracilis/anatomy/overlap/overlap_report.hpp>
#include <gracilis/scene/scene.hpp>

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace gracilis {

/// A transversal of a scene, by names.
struct NamedTransversal {
  std::string muscle, other;  ///< other: empty where there is none
  SectionCorner at, at_other;
  std::vector<std::string> bones;
};

/// Those of a scene, by the names of muscles and bones.
std::vector<NamedTransversal> named_transversals(const Scene& scene);

/// What run.json says about a run, beside the versions of the libraries, the time and the machine.
struct RunManifest {
  std::string version;                        ///< of Gracilis
  std::string scene;                          ///< the scene's name
  std::string preset;                         ///< that the settings started from
  std::vector<std::string> command;           ///< the command line, word by word
  std::string settings;                       ///< every setting as resolved, as TOML
  std::vector<std::filesystem::path> inputs;  ///< each is listed with its SHA-256
  std::vector<std::string> guessed;           ///< what was guessed rather than measured, e.g. "psoas_r origin"
  std::vector<std::string> warnings;
  std::vector<std::pair<std::string, std::string>> counters;  ///< per muscle: what constraints could not do, in words
  int every = 1;                                              ///< which of the motion's frames are recorded
  bool ramps = true;             ///< whether those on the way from and to the capture pose are
  bool fibers = true;            ///< whether fibers are followed
  bool corrections = false;      ///< whether frames tell what constraints moved
  int first_motion_frame = 0;    ///< of those recorded: those before it lead from the capture pose to the motion
  std::string metrics = "full";  ///< what is measured: none, light or full
  std::vector<std::pair<std::string, ActionLine>> lines;           ///< of muscles that have one, by their names
  std::vector<NamedTransversal> transversals;                      ///< of the scene
  std::vector<Joint> joints;                                       ///< of the scene
  OverlapReport overlaps;                                          ///< in the capture pose
  AnatomicalAxes axes;                                             ///< how the subject stands
  std::string status = "running";                                  ///< running, complete, interrupted, or "failed: why"
  Vec3 preview_looking = Vec3::Zero(), preview_up = Vec3::Zero();  ///< of the preview's camera; zero: there is none
  int threads = 1;
  int frames = 0;                   ///< on disk
  double seconds = 0;               ///< spent on them
  std::string outputs_sha256 = {};  ///< of the list of all files' hashes (output_hashes.hpp); empty: there is none yet
};

/// The report as `run.json` and `gracilis inspect` have it.
nlohmann::ordered_json overlaps_json(const OverlapReport& report);

/// Writes `path` (RUN/run.json), whole or not at all.
void write_manifest(const std::filesystem::path& path, const RunManifest& manifest);

/// FOLDER/run.json. What readers ask it for has the type that write_manifest gives it, to its depth but for action
/// lines. Throws InputError where it is missing, not JSON or of another shape.
nlohmann::ordered_json read_manifest(const std::filesystem::path& folder);

/// Throws InputError where the run in FOLDER was begun with other settings than these, lines of TOML: what goes on with
/// them would join two runs. Names the first that differs. Errors as read_manifest.
void require_same_settings(const std::filesystem::path& folder, const std::string& settings);

}  // namespace gracilis
