#pragma once

#include <gracilis/core/errors.hpp>
#include <gracilis/draft/found_surfaces.hpp>
#include <gracilis/scene/preparation.hpp>
#include <gracilis/transfer/muscle_transfer.hpp>

#include <string>

/// The optional component `prepare`, as functions for those who do not know it.
namespace gracilis {

/// What prepares a scene's surfaces; empty where this program is built without the component.
PrepareFunction scene_preparation();

/// What pulls muscles apart from bones and each other, likewise.
SeparateFunction scene_separation();

/// What mends one muscle so that a run takes it. Throws ConfigurationError where this program is built without it.
MendFunction surface_mending();

/// That this program is built without the component, and what to do.
ConfigurationError without_prepare();

/// Each line of `text` to the log.
void log_lines(const std::string& text);

}  // namespace gracilis
