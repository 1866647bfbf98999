#pragma once

#include <gracilis/scene/scene.hpp>

#include <string>
#include <vector>

namespace gracilis {

/// What a user should know about a scene that is fit for a run, one line each: a joint's center far from its bodies'
/// bones, as one in a wrong unit is, a motion that leaves a joint's range (it is never clamped), attachments of a
/// handful of vertices, long and thin ones. Requires that `validate` finds nothing.
std::vector<std::string> warnings_about(const Scene& scene);

}  // namespace gracilis
