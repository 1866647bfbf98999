#include <gracilis/io/run/run_manifest.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/core/whole_number.hpp>
#include <gracilis/dynamics/simd/instruction_set.hpp>
#include <gracilis/io/atomic_file.hpp>
#include <gracilis/io/content_hash.hpp>
#include <gracilis/io/input_file.hpp>
#include <gracilis/io/json_file.hpp>

#include <embree3/rtcore_config.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <hwy/highway.h>
#include <oneapi/tbb/version.h>
#include <vtkVersion.h>
#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <sstream>
#include <thread>

namespace gracilis {

static nlohmann::ordered_json library_versions() {
  return {{"Eigen", fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
          {"oneTBB", fmt::format("{}.{}", TBB_VERSION_MAJOR, TBB_VERSION_MINOR)},
          {"Embree", RTC_VERSION_STRING},
          {"Highway", fmt::format("{}.{}", HWY_MAJOR, HWY_MINOR)},
          {"VTK", vtkVersion::GetVTKVersion()},
          {"compiler", __VERSION__}};
}

static std::vector<Real> components(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

static nlohmann::ordered_json rows(const Points& points) {
  nlohmann::ordered_json rows = nlohmann::json::array();
  for (const Vec3 point : points.colwise()) rows.push_back(components(point));
  return rows;
}

/// What exports of sections need (view/export_tetrahedra).
static nlohmann::ordered_json action_lines(const RunManifest& manifest) {
  nlohmann::ordered_json lines = nlohmann::json::object();
  for (const auto& [muscle, line] : manifest.lines)
    lines[muscle] = {{"rays", line.rays},
                     {"scaling", line.scaling},
                     {"shares", line.shares},
                     {"tendon_m", line.tendon},
                     {"origin_tendon_m", line.origin_tendon},
                     {"tendon_sections", line.tendon_sections},
                     {"optimal_fiber_m", line.optimal_fiber},
                     {"pennation_rad", line.pennation},
                     {"points_m", rows(line.points)},
                     {"centers_m", rows(line.centers)}};
  return lines;
}

std::vector<NamedTransversal> named_transversals(const Scene& scene) {
  std::vector<NamedTransversal> named;
  for (const Transversal& each : scene.transversals) {
    const auto name = [&](Index muscle) {
      return muscle < 0 ? std::string() : scene.muscles[static_cast<std::size_t>(muscle)].name;
    };
    named.push_back({name(each.moved.muscle), name(each.other.muscle), each.moved, each.other, {}});
    for (const Index bone : each.bones) named.back().bones.push_back(scene.bones[static_cast<std::size_t>(bone)].name);
  }
  return named;
}

static nlohmann::ordered_json transversals_json(const std::vector<NamedTransversal>& transversals) {
  nlohmann::ordered_json list = nlohmann::json::array();
  for (const NamedTransversal& each : transversals) {
    list.push_back({{"muscle", each.muscle}, {"section", each.at.section}, {"ray", each.at.ray}});
    if (!each.other.empty()) {
      list.back()["other_muscle"] = each.other;
      list.back()["other_section"] = each.at_other.section;
      list.back()["other_ray"] = each.at_other.ray;
    }
    if (!each.bones.empty()) list.back()["bones"] = each.bones;
  }
  return list;
}

/// What exports to OpenSim need (opensim/export/run_lengths).
static nlohmann::ordered_json joints_json(const std::vector<Joint>& joints) {
  nlohmann::ordered_json list = nlohmann::json::array();
  for (const Joint& joint : joints) {
    nlohmann::ordered_json coordinates = nlohmann::json::array();
    for (const JointAxis& axis : joint.axes)
      coordinates.push_back({{"name", axis.coordinate}, {"translation", axis.translation}});
    list.push_back({{"name", joint.name}, {"coordinates", coordinates}});
  }
  return list;
}

nlohmann::ordered_json overlaps_json(const OverlapReport& report) {
  nlohmann::ordered_json pairs = nlohmann::json::array();
  for (const MuscleOverlap& pair : report.pairs)
    pairs.push_back({{"pair", pair.first + ", " + pair.second},
                     {"vertices_of_first_inside", pair.first_vertices},
                     {"vertices_of_second_inside", pair.second_vertices},
                     {"first_deepest_mm", 1e3 * pair.first_deepest},
                     {"second_deepest_mm", 1e3 * pair.second_deepest},
                     {"passes_through", pair.is_through}});
  nlohmann::ordered_json in_bones = nlohmann::json::array();
  for (const MuscleInBone& each : report.in_bones)
    in_bones.push_back({{"pair", each.muscle + ", " + each.bone},
                        {"vertices_inside", each.vertices},
                        {"deepest_mm", 1e3 * each.deepest}});
  return {{"vertices_inside", report.vertices},
          {"of_vertices", report.of_vertices},
          {"pairs", pairs},
          {"in_bones", in_bones}};
}

namespace {

using Json = nlohmann::ordered_json;

bool is_text(const Json& json) { return json.is_string(); }
bool is_real(const Json& json) { return json.is_number(); }
bool is_flag(const Json& json) { return json.is_boolean(); }
bool is_object(const Json& json) { return json.is_object(); }

bool is_count(const Json& json) { return json.is_number() && whole_number<Index>(json.get<Real>(), 0).has_value(); }

bool is_list_of(const Json& json, bool (*fits)(const Json&)) {
  return json.is_array() && std::all_of(json.begin(), json.end(), fits);
}

bool is_texts(const Json& json) { return is_list_of(json, is_text); }

/// Whether what is known of an object fits; it need not be there.
bool fits_at(const Json& json, const char* key, bool (*fits)(const Json&)) {
  const auto found = json.find(key);
  return found == json.end() || fits(*found);
}

bool is_coordinate(const Json& json) {
  return json.is_object() && fits_at(json, "name", is_text) && fits_at(json, "translation", is_flag);
}

bool is_joint(const Json& json) {
  return json.is_object() && fits_at(json, "name", is_text) &&
         fits_at(json, "coordinates", [](const Json& list) { return is_list_of(list, is_coordinate); });
}

bool is_input(const Json& json) {
  return json.is_object() && fits_at(json, "file", is_text) && fits_at(json, "sha256", is_text);
}

}  // namespace

nlohmann::ordered_json read_manifest(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / "run.json";
  if (!is_there(path))
    throw InputError({folder.string(), "", "is no run folder: it has no run.json", "name the folder of a run"});
  nlohmann::ordered_json manifest = read_json(path);
  const auto fail = [&](const std::string& what) {
    throw InputError({path.string(), "", what, "run the scene again"});
  };
  if (!manifest.is_object()) fail("is no manifest of a run");
  const auto require = [&](std::initializer_list<const char*> keys, bool (*fits)(const Json&), const char* expected) {
    for (const char* key : keys)
      if (!fits_at(manifest, key, fits)) fail(fmt::format("'{}' must be {}", key, expected));
  };
  require(
      {"gracilis", "status", "scene", "preset", "written", "instruction_set", "settings", "outputs_sha256", "metrics"},
      is_text, "a text");
  require({"seconds"}, is_real, "a number");
  require({"frames", "threads", "processors", "every", "first_motion_frame"}, is_count, "a count");
  require({"ramps", "fibers", "corrections"}, is_flag, "true or false");
  require({"command", "guessed", "warnings"}, is_texts, "a list of texts");
  require(
      {"inputs"}, [](const Json& json) { return is_list_of(json, is_input); }, "a list of files and hashes");
  require(
      {"joints"}, [](const Json& json) { return is_list_of(json, is_joint); }, "a list of joints");
  require({"axes", "action_lines", "rest_overlaps", "libraries", "counters", "preview"}, is_object, "an object");
  return manifest;
}

static std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

void require_same_settings(const std::filesystem::path& folder, const std::string& settings) {
  const nlohmann::ordered_json manifest = read_manifest(folder);
  const std::vector<std::string> then = lines_of(manifest["settings"].get<std::string>()), now = lines_of(settings);
  const auto [was, is] = std::mismatch(then.begin(), then.end(), now.begin(), now.end());
  if (was == then.end() && is == now.end()) return;
  const std::string before = was == then.end() ? "nothing" : "'" + *was + "'",
                    after = is == now.end() ? "nothing" : "'" + *is + "'";
  throw InputError({(folder / "run.json").string(), "",
                    fmt::format("the run was begun with {} where there is {} now", before, after),
                    "resume with the settings that it was begun with, or replace the run with --force"});
}

void write_manifest(const std::filesystem::path& path, const RunManifest& manifest) {
  nlohmann::ordered_json inputs = nlohmann::json::array();
  for (const std::filesystem::path& input : manifest.inputs) {
    inputs.push_back({{"file", input.string()}, {"sha256", content_hash(input)}});
  }
  nlohmann::ordered_json counters = nlohmann::json::object();
  for (const auto& [muscle, text] : manifest.counters) counters[muscle] = text;
  nlohmann::ordered_json json = {
      {"gracilis", manifest.version},
      {"status", manifest.status},
      {"scene", manifest.scene},
      {"preset", manifest.preset},
      {"command", manifest.command},
      {"written", fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)))},
      {"seed", nullptr},  // nothing in a run is random
      {"frames", manifest.frames},
      {"seconds", manifest.seconds},
      {"threads", manifest.threads},
      {"instruction_set", instruction_set()},  // results differ in the last bits between sets
      {"processors", std::thread::hardware_concurrency()},
      {"axes", {{"anterior", components(manifest.axes.anterior)}, {"superior", components(manifest.axes.superior)}}},
      {"preview", {{"looking", components(manifest.preview_looking)}, {"up", components(manifest.preview_up)}}},
      {"joints", joints_json(manifest.joints)},
      {"action_lines", action_lines(manifest)},
      {"transversals", transversals_json(manifest.transversals)},
      {"rest_overlaps", overlaps_json(manifest.overlaps)},
      {"guessed", manifest.guessed},
      {"warnings", manifest.warnings},
      {"every", manifest.every},
      {"ramps", manifest.ramps},
      {"fibers", manifest.fibers},
      {"corrections", manifest.corrections},
      {"first_motion_frame", manifest.first_motion_frame},
      {"metrics", manifest.metrics},
      {"counters", counters},
      {"inputs", inputs},
      {"libraries", library_versions()},
      {"settings", manifest.settings}};
  if (!manifest.outputs_sha256.empty()) json["outputs_sha256"] = manifest.outputs_sha256;
  write_text_atomically(path, json_text(json));
}

}  // namespace gracilis
