#pragma once

#include <gracilis/scene/scene.hpp>
#include <gracilis/view/pictures/picture.hpp>

#include <set>
#include <string>

namespace gracilis {

/// A scene before anything moves, to be checked: from four sides, above bones with where muscles attach (origins red,
/// insertions blue, those in `doubtful`, "muscle attachment", yellow) and the joints' axes, below with the muscles.
Picture scene_picture(const Scene& scene, const std::set<std::string>& doubtful = {});

}  // namespace gracilis
