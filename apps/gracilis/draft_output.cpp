#include "draft_output.hpp"

#include <gracilis/core/errors.hpp>
#include <gracilis/draft/draft_text.hpp>
#include <gracilis/io/atomic_file.hpp>
#include <gracilis/io/counted.hpp>
#include <gracilis/io/input_file.hpp>
#include <gracilis/io/json_file.hpp>
#include <gracilis/io/mesh/mesh_writer.hpp>
#include <gracilis/io/scene/scene_reader.hpp>
#include <gracilis/view/pictures/scene_picture.hpp>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <set>

namespace gracilis {

namespace fs = std::filesystem;

static std::set<std::string> doubtful_ends(const SceneDraft& draft) {
  std::set<std::string> ends;
  for (const DraftMuscle& muscle : draft.muscles)
    for (const DraftAttachment& each : muscle.attachments)
      if (each.guess.certainty < doubtful) ends.insert(muscle.found->name + " " + each.name);
  return ends;
}

static fs::path landmark_table(const fs::path& out) {
  return out.parent_path() / (out.stem().string() + "_landmarks.csv");
}

void require_new_scene(const fs::path& out, bool force) {
  if (out.extension() != ".toml")
    throw ConfigurationError({"--out", "", "'" + out.string() + "' is no name of a scene file", "name a .toml file"});
  if (force) return;
  if (is_there(out))
    throw ConfigurationError({out.string(), "", "is there already", "give another name, or --force to replace it"});
  // The files that a draft puts beside the scene may be somebody's own.
  for (const fs::path& beside : {landmark_table(out), mended_folder(out), fs::path(out).replace_extension(".png")})
    if (is_there(beside))
      throw ConfigurationError({beside.string(), "", "is there already, and would be written beside " + out.string(),
                                "give another name, or --force to replace it"});
}

static void write_mended(const FoundMuscle& muscle) {
  const fs::path& file = muscle.mended->file;
  create_folder_of(file);
  write_surface(file, muscle.mesh.vertices, muscle.mesh.faces);
}

void write_draft_files(const SceneDraft& draft, const fs::path& out) {
  create_folder_of(out);
  const std::string clouds = draft_landmarks(draft);
  const fs::path table = clouds.empty() ? fs::path() : landmark_table(out);
  if (!clouds.empty()) write_text_atomically(table, clouds);
  for (const DraftMuscle& muscle : draft.muscles)
    if (muscle.found->mended) write_mended(*muscle.found);
  write_text_atomically(out, draft_text(draft, out, table));
}

/// Those of the muscles' ends, too, with how many vertices they hold; doubtful ones first.
static std::vector<Guess> guesses_of(const SceneDraft& draft) {
  std::vector<Guess> guesses = draft.guesses;
  for (const DraftMuscle& muscle : draft.muscles)
    for (const DraftAttachment& each : muscle.attachments) {
      guesses.push_back(each.guess);
      guesses.back().how +=
          fmt::format(" ({} vertices on {})", each.vertices.size(), each.muscle.empty() ? each.body : each.muscle);
    }
  std::stable_sort(guesses.begin(), guesses.end(),
                   [](const Guess& a, const Guess& b) { return (a.certainty < doubtful) > (b.certainty < doubtful); });
  return guesses;
}

void tell(const SceneDraft& draft) {
  fmt::print("{}, {}, {}\n", counted(draft.found.bones.size(), "bone"), counted(draft.skeleton.joints.size(), "joint"),
             counted(draft.muscles.size(), "muscle"));
  for (const Guess& guess : guesses_of(draft))
    fmt::print("{} {}: {}\n", guess.certainty < doubtful ? "look at" : "guessed", guess.subject, to_string(guess));
  for (const DraftMuscle& muscle : draft.muscles)
    if (muscle.found->mended) fmt::print("mended {}: {}\n", muscle.found->name, muscle.found->mended->file.string());
  for (const std::string& line : draft.left_out) fmt::print("left out {}\n", line);
}

static nlohmann::ordered_json names_in(const auto& parts) {
  nlohmann::ordered_json names = nlohmann::json::array();
  for (const auto& each : parts) names.push_back(each.name);
  return names;
}

static void tell_as_json(const SceneDraft& draft, const Scene& scene, const fs::path& out, const fs::path& picture) {
  nlohmann::ordered_json guesses = nlohmann::json::array();
  for (const Guess& guess : guesses_of(draft))
    guesses.push_back({{"subject", guess.subject}, {"how", guess.how}, {"certainty", guess.certainty}});
  const nlohmann::ordered_json told = {
      {"scene", out.string()},
      {"picture", picture.empty() ? nlohmann::json() : nlohmann::json(picture.string())},
      {"bones", names_in(scene.bones)},
      {"joints", names_in(scene.joints)},
      {"muscles", names_in(scene.muscles)},
      {"guesses", guesses},
      {"left_out", draft.left_out}};
  fmt::print("{}", json_text(told));
}

/// Says whether there is a picture.
static bool draw(const SceneDraft& draft, const Scene& scene, const fs::path& path) {
  try {
    create_folder_of(path);
    render_picture(scene_picture(scene, doubtful_ends(draft)), path);
    return true;
  } catch (const Error& error) {
    spdlog::warn("no picture: {}", error.what());
    return false;
  }
}

void write_and_show(const SceneDraft& draft, const fs::path& out, const fs::path& picture, bool as_json) {
  write_draft_files(draft, out);
  const LoadedScene loaded = read_scene(out);
  if (!as_json) tell(draft);
  for (const std::string& warning : loaded.warnings) spdlog::warn("{}", warning);
  const bool is_drawn = draw(draft, loaded.scene, picture);
  if (as_json) return tell_as_json(draft, loaded.scene, out, is_drawn ? picture : fs::path());
  if (is_drawn) fmt::print("{}\n", picture.string());
  fmt::print("{}\n", out.string());
}

}  // namespace gracilis
