#include "draft_output.hpp"

#include <gracilis/core/errors.hpp>
#include <gracilis/draft/draft_text.hpp>
#include <gracilis/io/atomic_file.hpp>
#include <gracilis/io/input_file.hpp>
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
  for (const fs::path& beside : {landmark_table(out), fs::path(out).replace_extension(".png")})
    if (is_there(beside))
      throw ConfigurationError({beside.string(), "", "is there already, and would be written beside " + out.string(),
                                "give another name, or --force to replace it"});
}

void write_draft_files(const SceneDraft& draft, const fs::path& out) {
  const std::string clouds = draft_landmarks(draft);
  const fs::path table = clouds.empty() ? fs::path() : landmark_table(out);
  if (!clouds.empty()) write_text_atomically(table, clouds);
  write_text_atomically(out, draft_text(draft, out, table));
}

void tell(const SceneDraft& draft) {
  fmt::print("{} bones, {} joints, {} muscles\n", draft.found.bones.size(), draft.skeleton.joints.size(),
             draft.muscles.size());
  std::vector<Guess> guesses = draft.guesses;
  for (const DraftMuscle& muscle : draft.muscles)
    for (const DraftAttachment& each : muscle.attachments) {
      guesses.push_back(each.guess);
      guesses.back().how +=
          fmt::format(" ({} vertices on {})", each.vertices.size(), each.muscle.empty() ? each.body : each.muscle);
    }
  std::stable_sort(guesses.begin(), guesses.end(),
                   [](const Guess& a, const Guess& b) { return (a.certainty < doubtful) > (b.certainty < doubtful); });
  for (const Guess& guess : guesses)
    fmt::print("{} {}: {}\n", guess.certainty < doubtful ? "look at" : "guessed", guess.subject, to_string(guess));
  for (const std::string& line : draft.left_out) fmt::print("left out {}\n", line);
}

static void draw(const SceneDraft& draft, const Scene& scene, const fs::path& path) {
  try {
    render_picture(scene_picture(scene, doubtful_ends(draft)), path);
    fmt::print("{}\n", path.string());
  } catch (const Error& error) {
    spdlog::warn("no picture: {}", error.what());
  }
}

void write_and_show(const SceneDraft& draft, const fs::path& out, const fs::path& picture) {
  write_draft_files(draft, out);
  const LoadedScene loaded = read_scene(out);
  tell(draft);
  for (const std::string& warning : loaded.warnings) spdlog::warn("{}", warning);
  draw(draft, loaded.scene, picture);
  fmt::print("{}\n", out.string());
}

}  // namespace gracilis
