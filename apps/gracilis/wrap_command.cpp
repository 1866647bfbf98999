#include "wrap_command.hpp"

#include "console.hpp"
#include "exported_paths.hpp"
#include "opensim_model.hpp"
#include "scene_options.hpp"

#include <gracilis/core/errors.hpp>
#include <gracilis/io/atomic_file.hpp>
#include <gracilis/io/json_file.hpp>
#include <gracilis/io/scene/field_cache.hpp>
#include <gracilis/methods/registry.hpp>
#include <gracilis/opensim/export/model_with_paths.hpp>
#include <gracilis/opensim/export/scene_lengths.hpp>
#include <gracilis/opensim/kinematics/skeleton.hpp>
#include <gracilis/transfer/wrap_muscles.hpp>

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <nlohmann/json.hpp>

#include <memory>

namespace gracilis {

namespace {

struct WrapOptions {
  std::filesystem::path model, file, out;
  std::vector<std::filesystem::path> geometry;
  SceneOptions scene;
  Index poses = 1000, points = 12;
  bool json = false;
};

/// The model's surfaces in their bodies' own frames.
std::vector<opensim::ModelBone> surfaces_of_bodies(const opensim::Model& model, const WrapOptions& options) {
  const std::vector<RigidTransform> at_origin(model.bodies.size(), RigidTransform::Identity());
  opensim::ModelBones found =
      opensim::load_bones(model, at_origin, {options.model.parent_path(), options.geometry, {}});
  for (const std::string& line : found.missing) spdlog::warn("{}", line);
  return found.bones;
}

void say_shared(const SharedBodies& shared) {
  for (const SharedBody& body : shared.bodies)
    if (body.registered)
      spdlog::info("{}: surfaces lie {:.2f} mm apart (root mean square of the nearer four fifths)", body.name,
                   1000 * body.error);
    else
      spdlog::info("{}: taken to lie in the scene where the model has it", body.name);
  for (const std::string& line : shared.left_out) spdlog::warn("{}", line);
}

void print_json(const WrappedMuscles& wrapped) {
  nlohmann::ordered_json muscles = nlohmann::json::array();
  for (const WrappedMuscle& muscle : wrapped.told) {
    muscles.push_back(
        {{"muscle", muscle.name}, {"points", muscle.points}, {"poses", muscle.poses}, {"held_out", muscle.held_out}});
    muscles.back().update(as_json(muscle.errors));
  }
  fmt::print("{}", json_text({{"muscles", muscles}, {"left_out", wrapped.left_out}}));
}

int wrap_model(WrapOptions options) {
  if (std::filesystem::exists(options.out) && std::filesystem::equivalent(options.out, options.model))
    throw ConfigurationError({"--out", "", "is the model itself", "name another file"});
  const opensim::Model model = read_opensim_model(options.model, false);
  options.scene.set.insert(options.scene.set.begin(), "method=strings");
  const Scene scene = read_scene(options.file, options.scene).scene;
  const std::set<Index> wanted = bodies_to_share(model, scene);
  if (wanted.empty())
    throw InputError(
        {options.file.string(), "", "has no muscle of a name of the model's", "name muscles as the model does"});
  opensim::Skeleton skeleton(model);
  skeleton.place(opensim::captured_coordinates(model, scene));
  const SharedBodies shared = shared_bodies(model, scene, wanted, surfaces_of_bodies(model, options), skeleton.poses());
  say_shared(shared);
  if (shared.bodies.empty())
    throw InputError({options.file.string(), "", "shares no body with the model", "name bodies as the model does"});
  const auto method =
      make_method(scene, [&](const DistanceFieldSettings& settings) { return cached_bone_fields(scene, settings); });
  Progress progress(0, static_cast<int>(options.poses));
  const opensim::LengthSamples samples = opensim::scene_lengths(
      scene, *method, model, shared_ranges(model, scene), options.poses,
      [&](Index done) { progress.show(static_cast<int>(done)); }, options.points);
  progress.clear();
  const WrappedMuscles wrapped = wrap_muscles(model, scene, shared.bodies, samples);
  if (options.json)
    print_json(wrapped);
  else
    for (const WrappedMuscle& muscle : wrapped.told) fmt::print("{}\n", to_string(muscle));
  for (const std::string& line : wrapped.left_out) spdlog::warn("{}; the model keeps its path", line);
  if (wrapped.muscles.empty())
    throw InputError({options.file.string(), "", "has no muscle that the model can take",
                      "name muscles and bodies as the model does"});
  create_folder_of(options.out);
  write_text_atomically(options.out, opensim::model_with_paths(options.model, model, wrapped.muscles));
  spdlog::info("{}: {} of {} muscles replaced", options.out.string(), wrapped.muscles.size(), model.muscles.size());
  return static_cast<int>(ExitCode::done);
}

}  // namespace

void add_wrap_command(CLI::App& program, Command& chosen) {
  const auto options = std::make_shared<WrapOptions>();
  CLI::App* command = program.add_subcommand(
      "wrap", "Replace muscles' paths of an OpenSim model by those that strings of a scene of the same bones take");
  command->add_option("MODEL", options->model, "OpenSim model (.osim) of version 3.0 or later")
      ->required()
      ->check(CLI::ExistingFile);
  add_scene_options(*command, options->file, options->scene);
  command->add_option("--out", options->out, "Model to write: the same but for these muscles")->required();
  command
      ->add_option("--geometry", options->geometry,
                   "Folder with the model's surfaces, by which its bodies are laid on the scene's. May be repeated")
      ->allow_extra_args(false);
  command
      ->add_option("--sample", options->poses,
                   "Poses spread over the ranges of the coordinates that both have, a fifth of them held out")
      ->check(CLI::Range(16, 100000))
      ->capture_default_str();
  command->add_option("--points", options->points, "Points of a path at most, its ends among them")
      ->check(CLI::Range(2, 100))
      ->capture_default_str();
  command->add_flag("--json", options->json, "Print JSON, for programs");
  command->callback([&chosen, options] { chosen = [options] { return wrap_model(*options); }; });
}

}  // namespace gracilis
