#include <gracilis/io/scene/scene_assembly.hpp>

#include <gracilis/anatomy/resolution/divided_muscle.hpp>
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

namespace gracilis::sections {

namespace fs = std::filesystem;

static fs::path data_root_of(const SceneDescription& description, const SceneOptions& options) {
  fs::path data_root;
  for (const fs::path& file : description.files)
    if (data_root.empty()) data_root = find_data_root(file, options.data);
  return description.files.empty() ? find_data_root("scene", options.data) : data_root;
}

SceneInProgress begin_scene(const SceneDescription& description, const SceneOptions& options) {
  SceneInProgress progress{description, options, data_root_of(description, options)};
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
static AttachmentSelector read_files(SceneInProgress& progress, bool muscles_stay_raw) {
  const SceneDescription& description = progress.description;
  SurfaceLoader surfaces(progress, muscles_stay_raw);
  for (const BoneDescription& bone : description.bones) add_bone(progress, surfaces, bone);
  for (const MuscleDescription& muscle : description.muscles) add_muscle(progress, surfaces, muscle);
  AttachmentSelector selector(progress);
  add_motion(progress);
  for (const ActivationDescription& activation : description.activations) add_activation(progress, activation);
  for (const ControlUnitDescription& unit : description.control_units) add_control_unit(progress, unit);
  progress.stop_at<InputError>();
  return selector;
}

static void require_valid(const Scene& scene, const fs::path& file) {
  std::vector<Problem> problems = validate(scene);
  for (Problem& problem : validate_method(scene)) problems.push_back(std::move(problem));
  for (Problem& problem : problems) problem.file = file.string();
  if (!problems.empty()) throw ConfigurationError(std::move(problems));
}

void read_surfaces(SceneInProgress& progress) {
  place_bodies(progress);
  progress.stop_at<ConfigurationError>();
  read_files(progress, true);
}

/// Divides needles of muscles' surfaces, and says so.
static void divide_needles_of(SceneInProgress& progress) {
  std::vector<Muscle>& muscles = progress.loaded.scene.muscles;
  progress.divided = divide_needles(muscles);
  std::size_t surfaces = 0, before = 0, added = 0;
  for (const VerticesBetween& each : progress.divided) {
    surfaces += each.ends.empty() ? 0 : 1;
    before += static_cast<std::size_t>(each.first);
    added += each.ends.size();
  }
  if (surfaces == 0) return;
  progress.add_warnings({"long, thin triangles were divided in the surfaces of " + std::to_string(surfaces) + " of " +
                         std::to_string(muscles.size()) + " muscles: " + std::to_string(added) +
                         " vertices more, after the files' own " + std::to_string(before) +
                         " ([surfaces] divide_needles = false leaves them)"});
}

LoadedScene finish_scene(SceneInProgress progress) {
  const SceneDescription& description = progress.description;
  Scene& scene = progress.loaded.scene;
  place_bodies(progress);
  progress.stop_at<ConfigurationError>();
  AttachmentSelector selector = read_files(progress, description.prepare.has_value());
  if (description.prepare) prepare_muscles(progress);
  if (description.surfaces.divide_needles) divide_needles_of(progress);
  selector.attach_all(description.muscles);
  add_transversals(progress);
  progress.stop_at<ConfigurationError>();
  require_valid(scene, description.files.empty() ? fs::path() : description.files.front());
  let_go_of_attachments(progress.loaded);
  progress.add_warnings(warnings_about(scene));
  return std::move(progress.loaded);
}

}  // namespace gracilis::sections
