#include "transfer_command.hpp"

#include "build_info.hpp"
#include "handed_preparation.hpp"
#include "scene_options.hpp"

#include <gracilis/core/errors.hpp>
#include <gracilis/core/shell_word.hpp>
#include <gracilis/io/atomic_file.hpp>
#include <gracilis/io/counted.hpp>
#include <gracilis/io/input_file.hpp>
#include <gracilis/transfer/transfer_folder.hpp>
#include <gracilis/view/transfer/transfer_page.hpp>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <memory>

namespace gracilis {

namespace fs = std::filesystem;

namespace {

struct TransferCommandOptions {
  std::string origin, side, unit;
  fs::path bones, out, landmarks, template_landmarks, volumes;
  bool force = false, keep_overlaps = false, json = false;
  SceneOptions scene;
  std::vector<std::string> words;
};

FoundFolder subject_of(const TransferCommandOptions& options) {
  if (is_there(options.bones / "run.json"))
    throw ConfigurationError(
        {options.bones.string(), "", "is the folder of a run, not of bones", run_folder_advice(options.bones)});
  return find_surfaces(list_folder(options.bones), options.bones, options.unit);
}

void require_new_folder(const TransferCommandOptions& options) {
  if (options.out.extension() == ".toml")
    throw ConfigurationError({"--out", "", "'" + options.out.string() + "' looks like a file's name",
                              "name a folder; the scene will be scene.toml in it"});
  if (is_there(options.out) && !fs::is_directory(options.out))
    throw ConfigurationError({options.out.string(), "", "is there already, and no folder", "give another name"});
  if (is_there(options.out / "scene.toml") && !options.force)
    throw ConfigurationError({(options.out / "scene.toml").string(), "", "is there already",
                              "give another folder, or --force to replace it"});
}

void tell(const Transferred& transferred, const std::vector<std::string>& left_out) {
  const Scene& scene = transferred.scene;
  fmt::print("{}, {}, {}\n", counted(scene.bones.size(), "bone"), counted(scene.joints.size(), "joint"),
             counted(scene.muscles.size(), "muscle"));
  if (transferred.is_mirrored) fmt::print("the template is mirrored to the subject's side\n");
  for (const FittedBone& bone : transferred.skeleton.bones) {
    const BoneFit& fit = bone.registered.fit;
    fmt::print(
        "{}: {:.2f} mm RMS from {} ({:.2f} mm back, 95 % within {:.2f} mm; {:.0f} % of it and {:.0f} % of the "
        "subject's have no counterpart)\n",
        transferred.whole_template.bones[static_cast<std::size_t>(bone.match.of_template)].name, 1000 * fit.to_subject,
        transferred.subject.bones[bone.match.of_subject].file.filename().string(), 1000 * fit.to_template,
        1000 * fit.p95, 100 * fit.trimmed_template, 100 * fit.trimmed_subject);
  }
  for (const std::string& line : transferred.skeleton.doubtful) fmt::print("look at {}\n", line);
  for (const AttachmentFit& each : transferred.muscles.attachments)
    if (!each.on_bone) fmt::print("look at {} {}: on no bone of the subject\n", each.muscle, each.attachment);
  for (const Guess& guess : transferred.guesses)
    fmt::print("{} {}: {}\n", guess.certainty < doubtful ? "look at" : "guessed", guess.subject, to_string(guess));
  for (const std::string& line : left_out) fmt::print("left out {}\n", line);
}

/// The picture's bytes; empty, with a warning, where it cannot be drawn.
std::string drawn(const Transferred& transferred, const Scene& scene, const fs::path& path) {
  try {
    render_picture(transfer_picture(transferred, scene), path);
    return read_text(path);
  } catch (const Error& error) {
    spdlog::warn("no picture: {}", error.what());
    return {};
  }
}

int run_transfer(const TransferCommandOptions& options) {
  require_new_folder(options);
  const TemplateScene origin = read_template(options.origin, options.scene);
  FoundFolder subject = subject_of(options);
  const std::vector<std::string> of_folder = subject.left_out;
  TransferOptions transfer_options;
  if (!options.side.empty()) transfer_options.side = options.side == "left" ? BodySide::left : BodySide::right;
  TransferRecord record{build_info().version, options.words, {}};
  if (!options.landmarks.empty()) {
    transfer_options.landmarks.of_subject = read_landmark_points(options.landmarks, subject.unit_length);
    record.inputs.push_back(options.landmarks);
  }
  if (!options.template_landmarks.empty()) {
    transfer_options.landmarks.of_template = read_landmark_points(options.template_landmarks, 1);
    record.inputs.push_back(options.template_landmarks);
  }
  if (!options.volumes.empty()) {
    transfer_options.volumes = read_volumes(options.volumes);
    record.inputs.push_back(options.volumes);
  }
  if (!options.keep_overlaps) transfer_options.separate = scene_separation();
  if (!options.keep_overlaps && !transfer_options.separate)
    spdlog::warn("this program is built without 'prepare': muscles that overlap stay as they are");
  transfer_options.say = log_lines;

  Transferred transferred = transfer(origin.loaded.scene, std::move(subject), transfer_options);
  for (const std::string& line : of_folder) transferred.left_out.push_back(line);
  const std::vector<std::string> left_out = write_transfer_folder(origin, transferred, record, options.out);
  const fs::path scene_file = options.out / "scene.toml";
  const LoadedScene loaded = read_scene(scene_file);
  if (!options.json) tell(transferred, left_out);
  for (const std::string& warning : loaded.warnings) spdlog::warn("{}", warning);
  const std::string picture = drawn(transferred, loaded.scene, options.out / "transfer.png");
  transferred.scene.name = loaded.scene.name;
  write_transfer_page(options.out / "transfer.html", transferred, {origin.name, left_out, loaded.warnings, picture});
  if (options.json)
    fmt::print("{}", read_text(options.out / "transfer.json"));
  else
    fmt::print("{}\n{}\nnext: gracilis run {}\n", (options.out / "transfer.html").string(), scene_file.string(),
               shell_word(scene_file.string()));
  return static_cast<int>(ExitCode::done);
}

}  // namespace

void add_transfer_command(CLI::App& program, const std::vector<std::string>& words, Command& chosen) {
  const auto options = std::make_shared<TransferCommandOptions>();
  options->words = words;
  CLI::App* command = program.add_subcommand(
      "transfer",
      "Carry a template's muscles and joints to a subject's bones: a scene, with a report of how well they fit");
  command
      ->add_option("TEMPLATE", options->origin,
                   "Scene file, demo for the built-in hip, or demo-elbow for the built-in elbow")
      ->required();
  command->add_option("--bones", options->bones, "Folder with surfaces of the subject's bones, named after them")
      ->required();
  command->add_option("--out", options->out, "Folder to write: scene.toml, its surfaces and the report")->required();
  command
      ->add_option("--side", options->side,
                   "Side of the subject to make: right or left (default: the template's, or "
                   "the one whose bones are there)")
      ->check(CLI::IsMember({"right", "left"}));
  command
      ->add_option("--unit", options->unit, "Unit of the subject's files: m, cm or mm (default: by the bones' sizes)")
      ->check(CLI::IsMember({"m", "cm", "mm"}));
  command->add_option("--landmarks", options->landmarks,
                      "Landmarks of the subject by name (.csv or .toml); the template knows its joints' centers by the "
                      "joints' names");
  command->add_option("--template-landmarks", options->template_landmarks, "Landmarks of the template by name");
  command->add_option("--volumes", options->volumes,
                      "Volumes or masses of the subject's muscles: a .csv with muscle and volume_cm3 or mass_g");
  command->add_flag("--json", options->json,
                    "Print what was found as JSON (transfer.json of the folder), for programs");
  command->add_flag("--keep-overlaps", options->keep_overlaps, "Do not pull muscles apart from bones and each other");
  command->add_option("--data", options->scene.data, "Folder with the template's files");
  add_setting_options(*command, options->scene);
  command->add_flag("--force", options->force, "Replace the scene in the folder");
  command->callback([&chosen, options] {
    options->scene.prepare = scene_preparation();
    options->scene.say = log_lines;
    chosen = [options] { return run_transfer(*options); };
  });
}

}  // namespace gracilis
