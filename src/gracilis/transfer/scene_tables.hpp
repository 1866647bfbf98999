#pragma once

#include <gracilis/transfer/template_scene.hpp>
#include <gracilis/transfer/transfer.hpp>

#include <toml++/toml.h>

#include <filesystem>
#include <string>
#include <vector>

namespace gracilis {

/// The template's tables as they hold for the subject: bones and muscles from files under bones/ and muscles/ of
/// `folder`, joints where they are now, listed vertices in the place of rules, nothing of what was left out; all else
/// as the template says. Files that tables name besides are copied to tables/; `left_out` is told of what is not
/// carried.
toml::table subject_tables(const TemplateScene& origin, const Transferred& transferred,
                           const std::filesystem::path& folder, std::vector<std::string>& left_out);

}  // namespace gracilis
