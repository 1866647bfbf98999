#include <gracilis/io/scene/preparation.hpp>

#include <gracilis/io/mesh/load_surface.hpp>
#include <gracilis/io/scene/field_cache.hpp>
#include <gracilis/io/scene/prepared_cache.hpp>

namespace gracilis::sections {

template <class Elements>
static std::vector<NamedSurface> surfaces_of(const Elements& elements) {
  std::vector<NamedSurface> surfaces;
  for (const auto& each : elements) surfaces.push_back({each.name, each.surface});
  return surfaces;
}

std::vector<NamedSurface> muscle_surfaces(const Scene& scene) { return surfaces_of(scene.muscles); }

std::vector<NamedSurface> bone_surfaces(const Scene& scene) { return surfaces_of(scene.bones); }

static void reject_listed_vertices(SceneInProgress& progress) {
  for (const MuscleDescription& muscle : progress.description.muscles)
    for (const AttachmentDescription& each : muscle.attachments)
      if (each.attachment.listed)
        progress.add_problem(each.place,
                             "attachment '" + each.attachment.name + "' lists vertices, which preparation renumbers",
                             "describe the attachment by distances");
  progress.stop_at<ConfigurationError>();
}

void prepare_muscles(SceneInProgress& progress) {
  reject_listed_vertices(progress);
  Scene& scene = progress.loaded.scene;
  const SceneOptions& options = progress.options;
  const auto say = options.say ? options.say : [](const std::string&) {};
  const auto warn = [&](const std::string& warning) { progress.loaded.warnings.push_back(warning); };
  const std::vector<TriangleMesh> prepared =
      cached_preparation(muscle_surfaces(scene), bone_surfaces(scene), *progress.description.prepare, options.prepare,
                         say, default_cache_folder(), warn);
  for (std::size_t m = 0; m < scene.muscles.size(); ++m) {
    Muscle& muscle = scene.muscles[m];
    muscle.surface = check_surface(prepared[m], 1, SurfaceRole::muscle, "prepared " + muscle.name).mesh;
  }
}

}  // namespace gracilis::sections
