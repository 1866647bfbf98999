#include <gracilis/io/scene/given_scene.hpp>

#include <gracilis/io/scene/scene_assembly.hpp>
#include <gracilis/io/scene/scene_description.hpp>

#include <utility>

namespace gracilis {

LoadedScene make_scene(const toml::table& tables, std::vector<TriangleMesh> surfaces, const SceneOptions& options) {
  const SceneDescription description = read_given_description(tables, static_cast<Index>(surfaces.size()));
  sections::SceneInProgress progress = sections::begin_scene(description, options);
  progress.surfaces = std::move(surfaces);
  return sections::finish_scene(std::move(progress));
}

}  // namespace gracilis
