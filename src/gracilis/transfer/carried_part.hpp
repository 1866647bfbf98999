#pragma once

#include <gracilis/scene/scene.hpp>

#include <string>
#include <vector>

namespace gracilis {

/// Takes out of a scene what cannot move as a whole where some bodies have no bones (`has_bones`, of the scene's
/// bodies): joints of these; of the parts into which the others fall without those joints, all but the one in which
/// most muscles end, with its bones; and muscles that end on what is gone, or lie on such muscles. `left_out` is told
/// of each, a line with the reason. Bodies stay numbered as they were.
void keep_connected_part(Scene& scene, const std::vector<char>& has_bones, std::vector<std::string>& left_out);

}  // namespace gracilis
