#pragma once

#include <gracilis/anatomy/resolution/divided_muscle.hpp>
#include <gracilis/core/errors.hpp>
#include <gracilis/io/mesh/mesh_reader.hpp>
#include <gracilis/io/scene/scene_description.hpp>
#include <gracilis/io/scene/scene_reader.hpp>

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

/// The sections of a scene file. Each is read into its description first, and put into the scene when all are read.
namespace gracilis::sections {

/// A scene on its way from its description to its values.
struct SceneInProgress {
  const SceneDescription& description;
  const SceneOptions& options;
  std::filesystem::path data_root;  ///< empty: there is none
  LoadedScene loaded = {};
  std::vector<Index> bone_bodies = {};        ///< of each bone of the description
  std::vector<TriangleMesh> surfaces = {};    ///< that came with the description, m
  std::vector<VerticesBetween> divided = {};  ///< what came into each muscle of the scene; empty: none was looked at
  std::vector<Problem> problems = {};         ///< of the stage under way
  std::unique_ptr<MeshFiles> files = std::make_unique<MeshFiles>();

  /// Of the stage under way, at this place.
  void add_problem(Problem place, const std::string& what, const std::string& remedy = "") {
    place.what = what;
    place.remedy = remedy;
    problems.push_back(std::move(place));
  }

  /// A line each.
  void add_warnings(const std::vector<std::string>& lines) {
    loaded.warnings.insert(loaded.warnings.end(), lines.begin(), lines.end());
  }

  /// Ends a stage: throws its problems together as an error of this kind, if there are any.
  template <class Kind>
  void stop_at() {
    if (!problems.empty()) throw Kind(std::move(problems));
  }
};

}  // namespace gracilis::sections
