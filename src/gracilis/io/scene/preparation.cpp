#include <gracilis/io/scene/preparation.hpp>

#include <gracilis/io/mesh/load_surface.hpp>
#include <gracilis/io/scene/field_cache.hpp>
#include <gracilis/io/scene/prepared_cache.hpp>
#include <gracilis/io/suggestions.hpp>

namespace gracilis {

void pull_only_known(std::vector<NamedSurface>& muscles, const std::vector<std::string>& apart,
                     const std::string& subject) {
  const std::vector<std::string> unknown = pull_only(muscles, apart);
  if (unknown.empty()) return;
  std::vector<std::string> names;
  for (const NamedSurface& muscle : muscles) names.push_back(muscle.name);
  throw ConfigurationError(
      {"", subject, "no muscle is called '" + unknown.front() + "'", suggestion(unknown.front(), names)});
}

}  // namespace gracilis

namespace gracilis::sections {

std::vector<NamedSurface> muscle_surfaces(const SceneInProgress& progress) {
  const Scene& scene = progress.loaded.scene;
  std::vector<NamedSurface> surfaces;
  for (std::size_t m = 0; m < scene.muscles.size(); ++m)
    surfaces.push_back(
        {scene.muscles[m].name, scene.muscles[m].surface, progress.description.muscles[m].surface.largest_piece});
  // Of a part of the muscles the others' names are no mistake.
  if (progress.options.only.empty())
    pull_only_known(surfaces, progress.description.apart, "[prepare] apart");
  else
    pull_only(surfaces, progress.description.apart);
  return surfaces;
}

std::vector<NamedSurface> bone_surfaces(const SceneInProgress& progress) {
  std::vector<NamedSurface> surfaces;
  for (const Bone& bone : progress.loaded.scene.bones) surfaces.push_back({bone.name, bone.surface});
  return surfaces;
}

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
      cached_preparation(muscle_surfaces(progress), bone_surfaces(progress), *progress.description.prepare,
                         options.prepare, say, default_cache_folder(), warn);
  for (std::size_t m = 0; m < scene.muscles.size(); ++m) {
    Muscle& muscle = scene.muscles[m];
    muscle.surface = check_surface(prepared[m], 1, SurfaceRole::muscle, "prepared " + muscle.name).mesh;
  }
}

}  // namespace gracilis::sections
