#include <build_paths.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <string>
#include <vector>

/// Who may include whom: only what stands further down, and what stands in the same folder. Folders of the same rank do
/// not know each other.
namespace {

const std::map<std::string, int> ranks = {
    {"core", 0},    {"geometry", 1},  {"dynamics", 2}, {"scene", 2},   {"anatomy", 3}, {"strings", 4},
    {"methods", 5}, {"simulate", 6},  {"io", 7},       {"prepare", 7}, {"opensim", 8}, {"draft", 8},
    {"study", 8},   {"calibrate", 9}, {"transfer", 9}, {"view", 10},   {"apps", 11}};

/// Rooms of a folder, "." for the files that stand in it without one, and the same rule between them.
const std::map<std::string, std::map<std::string, int>> room_ranks = {
    {"dynamics",
     {{".", 0},
      {"simd", 1},
      {"contact/mesh", 2},
      {"constraints", 3},
      {"contact/field", 4},
      {"contact/self", 4},
      {"havlicek_2024", 4},
      {"contact/surface", 5},
      {"solver", 6}}},
    {"anatomy",
     {{"attachments", 0},
      {"builtin", 0},
      {"joints", 0},
      {"resolution", 0},
      {"sections", 0},
      {"overlap", 1},
      {"activation", 1},
      {"fibers", 1},
      {".", 2}}},
    {"io", {{".", 0}, {"mesh", 1}, {"tables", 1}, {"scene", 2}, {"run", 3}}},
    {"opensim",
     {{"functions", 0},
      {"reader", 1},
      {"kinematics", 2},
      {"paths", 3},
      {"static_optimization", 4},
      {"import", 4},
      {"export", 5}}},
    {"view",
     {{"pictures", 0},
      {"charts", 1},
      {"export", 1},
      {"report", 2},
      {"window", 2},
      {"calibration", 3},
      {"comparison", 3},
      {"session", 3},
      {"study", 3},
      {"transfer", 3}}}};

/// Libraries that only `io` and `view` (and programs) may use: file formats, text, graphics.
const std::vector<std::string> toolkit_libraries = {"vtk",   "fmt/",     "spdlog/", "toml++/", "nlohmann/",
                                                    "CLI/",  "openssl/", "EGL/",    "pugixml", "gif_lib",
                                                    "SimTK", "muParser", "nlopt",   "hdf5"};

/// Folder names of a path such as "methods/xpbd/motion.hpp", without the file.
std::vector<std::string> folders_of(const std::string& path) {
  std::vector<std::string> folders;
  for (const auto& part : std::filesystem::path(path).parent_path()) folders.push_back(part.string());
  return folders;
}

/// The room of a path such as "dynamics/contact/field/points.cpp": "contact/field".
std::string room_of(const std::string& path) {
  const std::filesystem::path within =
      std::filesystem::path(path).parent_path().lexically_relative(folders_of(path)[0]);
  return within.generic_string();
}

/// Empty when a file of a room may include one of another room of the same folder; otherwise why not.
std::string objection_between_rooms(const std::string& from, const std::string& included) {
  const auto rooms = room_ranks.find(folders_of(from)[0]);
  if (rooms == room_ranks.end() || room_of(from) == room_of(included)) return "";
  const auto own = rooms->second.find(room_of(from)), other = rooms->second.find(room_of(included));
  if (own == rooms->second.end() || other == rooms->second.end()) return "a room without a rank";
  return other->second < own->second ? "" : "a room that is not further down";
}

/// Empty when file `from` (relative to src/gracilis) may include `<included>`; otherwise why not.
std::string objection(const std::string& from, const std::string& included) {
  const std::vector<std::string> own = folders_of(from);
  const int rank = ranks.at(own.at(0));
  if (included.starts_with("CGAL/")) return own[0] == "prepare" ? "" : "CGAL, which is for 'prepare' alone";
  if (!included.starts_with("gracilis/")) {
    const bool of_toolkit = std::any_of(toolkit_libraries.begin(), toolkit_libraries.end(),
                                        [&](const std::string& start) { return included.starts_with(start); });
    return of_toolkit && rank < ranks.at("io") ? "a library of the toolkit" : "";
  }
  const std::vector<std::string> other = folders_of(included.substr(std::string("gracilis/").size()));
  if (other.empty() || !ranks.contains(other[0])) return "a folder without a rank";
  if (own[0] != other[0]) return ranks.at(other[0]) < rank ? "" : "a folder that is not further down";
  // Methods are siblings: each knows itself and what stands in methods/ for all of them.
  const bool is_registry = from == "methods/every_method.cpp";  // the one place that knows them all
  const bool other_method =
      own[0] == "methods" && other.size() > 1 && !is_registry && (own.size() < 2 || own[1] != other[1]);
  if (other_method) return "another method";
  return objection_between_rooms(from, included.substr(std::string("gracilis/").size()));
}

struct Include {
  std::string from, included;
};

std::vector<Include> includes_below(const std::filesystem::path& root, const std::string& prefix) {
  static const std::regex pattern(R"(^\s*#\s*include\s*[<"]([^>"]+)[>"])");
  std::vector<Include> includes;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
    if (entry.path().extension() != ".hpp" && entry.path().extension() != ".cpp") continue;
    std::ifstream file(entry.path());
    std::smatch match;
    for (std::string line; std::getline(file, line);)
      if (std::regex_search(line, match, pattern))
        includes.push_back({prefix + entry.path().lexically_relative(root).generic_string(), match[1]});
  }
  return includes;
}

const std::filesystem::path source = std::filesystem::path(build_paths::source_folder) / "src/gracilis";

TEST(Includes, go_down_only) {
  std::vector<Include> includes = includes_below(source, "");
  const std::vector<Include> of_programs =
      includes_below(std::filesystem::path(build_paths::source_folder) / "apps", "apps/");
  includes.insert(includes.end(), of_programs.begin(), of_programs.end());
  ASSERT_GT(includes.size(), 500u);
  for (const auto& [from, included] : includes)
    EXPECT_EQ(objection(from, included), "") << from << " includes <" << included << ">";
}

TEST(Includes, every_folder_has_a_rank) {
  for (const auto& entry : std::filesystem::directory_iterator(source))
    EXPECT_TRUE(ranks.contains(entry.path().filename().string())) << entry.path();
}

/// Sources whose functions another header declares: what stands in for one source, parts of one class, and what asks
/// CGAL, one compiler run each.
const std::vector<std::string> without_header = {"core/parallel_", "geometry/triangle_tree_", "methods/xpbd/xpbd_entry",
                                                 "prepare/cgal_", "view/window/viewer_"};

TEST(Includes, every_source_includes_a_header_of_its_own_name_first) {
  std::map<std::string, std::string> first;
  for (const auto& [from, included] : includes_below(source, "gracilis/")) first.emplace(from, included);
  int sources = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(source)) {
    if (entry.path().extension() != ".cpp") continue;
    const std::string within = entry.path().lexically_relative(source).generic_string(), path = "gracilis/" + within;
    if (std::any_of(without_header.begin(), without_header.end(),
                    [&](const std::string& start) { return within.starts_with(start); }))
      continue;
    EXPECT_EQ(first[path], std::filesystem::path(path).replace_extension(".hpp").generic_string());
    ++sources;
  }
  EXPECT_GT(sources, 300);
}

TEST(Includes, every_room_has_a_rank) {
  for (const auto& [folder, rooms] : room_ranks) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(source / folder)) {
      if (entry.path().extension() != ".hpp" && entry.path().extension() != ".cpp") continue;
      const std::string path = entry.path().lexically_relative(source).generic_string();
      EXPECT_TRUE(rooms.contains(room_of(path))) << path;
    }
    for (const auto& [room, rank] : rooms) EXPECT_TRUE(std::filesystem::is_directory(source / folder / room)) << room;
  }
}

TEST(Includes, upward_and_sideways_ones_would_be_found) {
  EXPECT_NE(objection("core/parallel.cpp", "gracilis/geometry/topology.hpp"), "");
  EXPECT_NE(objection("dynamics/solver/solver.hpp", "gracilis/scene/pose.hpp"), "");
  EXPECT_NE(objection("scene/scene.hpp", "gracilis/dynamics/solver/solver.hpp"), "");
  EXPECT_NE(objection("simulate/run.cpp", "gracilis/io/run/run_folder.hpp"), "");
  EXPECT_NE(objection("io/run/run_folder.cpp", "gracilis/view/pictures/preview.hpp"), "");
  EXPECT_NE(objection("io/tables/table.cpp", "gracilis/opensim/reader/model.hpp"), "");
  EXPECT_NE(objection("methods/xpbd/motion.cpp", "gracilis/methods/rbf/kernel.hpp"), "");
  EXPECT_NE(objection("methods/method.hpp", "gracilis/methods/xpbd/motion.hpp"), "");
  EXPECT_NE(objection("dynamics/particles.cpp", "gracilis/dynamics/solver/solver.hpp"), "");
  EXPECT_NE(
      objection("dynamics/contact/self/self_intersections.cpp", "gracilis/dynamics/contact/field/field_contact.hpp"),
      "");
  EXPECT_NE(objection("opensim/reader/model.hpp", "gracilis/opensim/import/scene_folder.hpp"), "");
  EXPECT_NE(objection("geometry/measures.cpp", "vtkPolyData.h"), "");
  EXPECT_NE(objection("geometry/measures.cpp", "CGAL/Surface_mesh.h"), "");
  EXPECT_NE(objection("geometry/measures.cpp", "gracilis/elsewhere/file.hpp"), "");
}

TEST(Includes, downward_ones_are_welcome) {
  EXPECT_EQ(objection("methods/xpbd/motion.cpp", "gracilis/methods/method.hpp"), "");
  EXPECT_EQ(objection("methods/xpbd/motion.cpp", "gracilis/methods/xpbd/motion.hpp"), "");
  EXPECT_EQ(objection("dynamics/solver/solver.cpp", "gracilis/dynamics/contact/field/field_contact.hpp"), "");
  EXPECT_EQ(objection("view/pictures/preview.cpp", "gracilis/io/mesh/mesh_reader.hpp"), "");
  EXPECT_EQ(objection("opensim/reader/model_reader.cpp", "gracilis/io/input_file.hpp"), "");
  EXPECT_EQ(objection("io/mesh/mesh_writer.cpp", "vtkPolyData.h"), "");
}

}  // namespace
