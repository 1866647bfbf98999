#pragma once

#include <gracilis/draft/scene_draft.hpp>

#include <filesystem>
#include <string>

namespace gracilis {

/// The scene file's text: every guess is a comment beside what it is about, and stands in the list `guessed`; every
/// table says what to change in it. What a draft without joints lacks stands there as comments to fill in. Paths are
/// relative to the folder of `out`; clouds lie in the table `landmarks` beside it.
std::string draft_text(const SceneDraft& draft, const std::filesystem::path& out,
                       const std::filesystem::path& landmarks);

/// The clouds that attachments name, as a table with coordinates in mm; empty where there are none.
std::string draft_landmarks(const SceneDraft& draft);

}  // namespace gracilis
