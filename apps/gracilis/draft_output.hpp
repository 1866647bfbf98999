#pragma once

#include <gracilis/draft/scene_draft.hpp>

#include <filesystem>

/// What 'gracilis scene' and 'gracilis new' do with a drafted scene.
namespace gracilis {

/// Throws ConfigurationError where `out` is no name of a scene file, or where it, its landmarks' table, its folder of
/// mended surfaces or its picture is there already and not to be replaced.
void require_new_scene(const std::filesystem::path& out, bool force);

/// Writes the scene file, and its landmarks and mended surfaces beside it.
void write_draft_files(const SceneDraft& draft, const std::filesystem::path& out);

/// Prints what was found and what was guessed, doubtful things first.
void tell(const SceneDraft& draft);

/// Writes the scene, reads it again as a run would, tells what stands in it and what the reader says of it, and draws
/// it. It is of use without its picture, too: then there is a warning. Prints the scene's name last, or all of it as one
/// object of JSON.
void write_and_show(const SceneDraft& draft, const std::filesystem::path& out, const std::filesystem::path& picture,
                    bool as_json = false);

}  // namespace gracilis
