#include <gracilis/io/scene/scene_reader.hpp>

#include <gracilis/anatomy/scene_warnings.hpp>
#include <gracilis/io/scene/activation.hpp>
#include <gracilis/io/scene/attachments.hpp>
#include <gracilis/io/scene/bodies.hpp>
#include <gracilis/io/scene/control_units.hpp>
#include <gracilis/io/scene/data_root.hpp>
#include <gracilis/io/scene/motion.hpp>
#include <gracilis/io/scene/muscles.hpp>
#include <gracilis/io/scene/preparation.hpp>
#include <gracilis/io/scene/scene_description.hpp>
#include <gracilis/io/scene/scene_in_progress.hpp>
#include <gracilis/io/scene/surfaces.hpp>
#include <gracilis/io/scene/transversals.hpp>
#include <gracilis/methods/registry.hpp>
#include <gracilis/scene/validate.hpp>

namespace gracilis {

namespace fs = std::filesystem;

static fs::path data_root_of(const SceneDescription& description, const SceneOptions& options) {
  fs::path data_root;
  for (const fs::path& file : description.files)
    if (data_root.empty()) data_root = find_data_root(file, options.data);
  return data_root;
}

static sections::SceneInProgress begin_scene(const SceneDescription& description, const SceneOptions& options) {
  sections::SceneInProgress progress{description, options, data_root_of(description, options)};
  LoadedScene& loaded = progress.loaded;
  loaded.scene = description.scene;
  loaded.preset = description.preset;
  loaded.max_frames = description.motion.max_frames;
  loaded.inputs = description.files;
  loaded.warnings = description.notes;
  loaded.guessed = description.guessed;
  return progress;
}

/// Adds all that stands in files: surfaces, landmarks (which attachments are then selected by), motion, activations.
static sections::AttachmentSelector read_files(sections::SceneInProgress& progress, bool muscles_stay_raw) {
  const SceneDescription& description = progress.description;
  sections::SurfaceLoader surfaces(progress, muscles_stay_raw);
  for (const BoneDescription& bone : description.bones) sections::add_bone(progress, surfaces, bone);
  for (const MuscleDescription& muscle : description.muscles) sections::add_muscle(progress, surfaces, muscle);
  sections::AttachmentSelector selector(progress);
  sections::add_motion(progress);
  for (const ActivationDescription& activation : description.activations)
    sections::add_activation(progress, activation);
  for (const ControlUnitDescription& unit : description.control_units) sections::add_control_unit(progress, unit);
  progress.stop_at<InputError>();
  return selector;
}

static void require_valid(const Scene& scene, const fs::path& file) {
  std::vector<Problem> problems = validate(scene);
  for (Problem& problem : validate_method(scene)) problems.push_back(std::move(problem));
  for (Problem& problem : problems) problem.file = file.string();
  if (!problems.empty()) throw ConfigurationError(std::move(problems));
}

LoadedScene read_scene(const fs::path& path, const SceneOptions& options) {
  const SceneDescription description = read_scene_description(path, options.set, options.only);
  sections::SceneInProgress progress = begin_scene(description, options);
  Scene& scene = progress.loaded.scene;
  sections::place_bodies(progress);
  progress.stop_at<ConfigurationError>();
  sections::AttachmentSelector selector = read_files(progress, description.prepare.has_value());
  if (description.prepare) sections::prepare_muscles(progress);
  selector.attach_all(description.muscles);
  sections::add_transversals(progress);
  progress.stop_at<ConfigurationError>();
  require_valid(scene, description.files.front());
  sections::let_go_of_attachments(progress.loaded);
  progress.add_warnings(warnings_about(scene));
  return std::move(progress.loaded);
}

SceneSurfaces read_scene_surfaces(const fs::path& path, const SceneOptions& options) {
  const SceneDescription description = read_scene_description(path, options.set, options.only);
  sections::SceneInProgress progress = begin_scene(description, options);
  sections::place_bodies(progress);
  progress.stop_at<ConfigurationError>();
  read_files(progress, true);
  const Scene& scene = progress.loaded.scene;
  return {scene.name, sections::muscle_surfaces(progress), sections::bone_surfaces(progress),
          description.prepare.value_or(PrepareSettings{})};
}

}  // namespace gracilis
