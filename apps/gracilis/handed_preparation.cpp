#include "handed_preparation.hpp"

#ifdef GRACILIS_WITH_PREPARE
#include <gracilis/prepare/mending.hpp>
#include <gracilis/prepare/prepare_surfaces.hpp>
#include <gracilis/prepare/separation.hpp>
#endif

#include <spdlog/spdlog.h>

#include <sstream>
#include <utility>

namespace gracilis {

void log_lines(const std::string& text) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) spdlog::info("{}", line);
}

ConfigurationError without_prepare() {
  return ConfigurationError({"", "", "this program was built without 'prepare'",
                             "install libcgal-dev and build with GRACILIS_WITH_PREPARE=ON"});
}

#ifdef GRACILIS_WITH_PREPARE

PrepareFunction scene_preparation() { return prepare_surfaces; }

SeparateFunction scene_separation() {
  return [](std::vector<TriangleMesh>& muscles, const std::vector<TriangleMesh>& bones) {
    return separate(muscles, bones, {}).shortfall;
  };
}

MendFunction surface_mending() {
  return [](const std::string& name, const TriangleMesh& mesh) {
    log_lines("mending " + name);
    FixedSurface fixed = mended_surface(mesh, name);
    return MendedSurface{std::move(fixed.mesh), std::move(fixed.repairs), std::move(fixed.heads)};
  };
}

#else

PrepareFunction scene_preparation() { return {}; }
SeparateFunction scene_separation() { return {}; }
MendFunction surface_mending() { throw without_prepare(); }

#endif

}  // namespace gracilis
