#include <gracilis/io/scene/scene_reader.hpp>

#include <gracilis/io/scene/preparation.hpp>
#include <gracilis/io/scene/scene_assembly.hpp>
#include <gracilis/io/scene/scene_description.hpp>

namespace gracilis {

namespace fs = std::filesystem;

LoadedScene read_scene(const fs::path& path, const SceneOptions& options) {
  const SceneDescription description = read_scene_description(path, options.set, options.only);
  return sections::finish_scene(sections::begin_scene(description, options));
}

SceneSurfaces read_scene_surfaces(const fs::path& path, const SceneOptions& options) {
  const SceneDescription description = read_scene_description(path, options.set, options.only);
  sections::SceneInProgress progress = sections::begin_scene(description, options);
  sections::read_surfaces(progress);
  const Scene& scene = progress.loaded.scene;
  return {scene.name, sections::muscle_surfaces(progress), sections::bone_surfaces(progress),
          description.prepare.value_or(PrepareSettings{})};
}

}  // namespace gracilis
