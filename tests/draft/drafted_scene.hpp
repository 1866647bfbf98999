#pragma once

#include <gracilis/draft/draft_text.hpp>
#include <gracilis/io/scene/scene_reader.hpp>

#include "../io/test_files.hpp"

namespace gracilis {

/// The scene that `gracilis scene` would write beside the folder, read back.
inline LoadedScene drafted_scene(const std::filesystem::path& folder, const DraftOptions& options = {}) {
  const SceneDraft draft = draft_scene(folder, options);
  const std::filesystem::path out = folder.parent_path() / "scene.toml", table = folder.parent_path() / "scene.csv";
  const std::string clouds = draft_landmarks(draft);
  if (!clouds.empty()) std::ofstream(table) << clouds;
  std::ofstream(out) << draft_text(draft, out, clouds.empty() ? std::filesystem::path() : table);
  return read_scene(out);
}

}  // namespace gracilis
