#pragma once

#include <gracilis/io/scene/scene_reader.hpp>

#include "io/scene_folder.hpp"

#include <gtest/gtest.h>

#include <string>

namespace gracilis {

/// Reads scenes in a folder of their own.
class SceneReader : public testing::Test {
 protected:
  LoadedScene read(const std::string& text, const SceneOptions& options = {}) const {
    return read_scene(folder.write("scene.toml", text), options);
  }

  /// All problems of a scene file, with the folder's name taken out.
  std::string problems(const std::string& text, const SceneOptions& options = {}) const {
    try {
      read(text, options);
    } catch (const Error& error) {
      code = error.code();
      std::string message = error.what();
      for (std::size_t at; (at = message.find(folder.path("").string())) != std::string::npos;) {
        message.erase(at, folder.path("").string().size());
      }
      return message;
    }
    return "no problem";
  }

  SceneFolder folder;
  mutable ExitCode code = ExitCode::done;
};

}  // namespace gracilis
