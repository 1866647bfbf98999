#pragma once

#include "command.hpp"

#include <gracilis/scene/preparation.hpp>
#include <gracilis/transfer/muscle_transfer.hpp>

#include <string>

namespace gracilis {

/// gracilis prepare FILE...|SCENE.toml: repaired, remeshed surfaces without overlaps. Built without the component, the
/// command says so and ends with exit code 2.
void add_prepare_command(CLI::App& program, Command& chosen);

/// What prepares a scene's surfaces; empty where this program is built without the component.
PrepareFunction scene_preparation();

/// What pulls muscles apart from bones and each other, likewise.
SeparateFunction scene_separation();

/// Each line of `text` to the log.
void log_lines(const std::string& text);

}  // namespace gracilis
