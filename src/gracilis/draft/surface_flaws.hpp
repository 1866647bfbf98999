#pragma once

#include <gracilis/geometry/triangle_mesh.hpp>

#include <string>

namespace gracilis {

/// What is wrong with a closed surface that a run takes nevertheless, in words: closed pieces that lie in others, and
/// triangles that cut others. Empty: nothing.
std::string flaws_of(const TriangleMesh& surface);

}  // namespace gracilis
