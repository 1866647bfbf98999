#pragma once

#include <gracilis/scene/scene.hpp>

#include <string>

namespace gracilis {

/// A scene in one piece, for a program that reads no files (the page in the browser, web/src): numbers keep every bit.
/// All of it but `activation`, which holds functions.
std::string scene_bytes(const Scene& scene);

/// The scene again. Precondition: the bytes are those of scene_bytes, by a program of the same version. Throws
/// InputError where they begin otherwise.
Scene scene_of_bytes(const std::string& bytes);

}  // namespace gracilis
