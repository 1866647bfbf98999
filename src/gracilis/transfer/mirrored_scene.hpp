#pragma once

#include <gracilis/scene/scene.hpp>

#include <string>

namespace gracilis {

/// A name of the other side: "_r" and "_l" at the end or before an underscore, "right" and "left" change places.
std::string other_side_name(const std::string& name);

/// The scene of the body's other half, mirrored across its axes' right: surfaces face outwards and keep their order of
/// vertices, coordinates keep their meaning (flexion stays flexion, inward stays inward), names change sides. Paths of
/// action lines keep their points alone.
Scene mirrored_scene(Scene scene);

}  // namespace gracilis
