#pragma once

#include <gracilis/scene/scene.hpp>

#include <vector>

namespace gracilis {

/// Per vertex of a muscle's surface: 1 where an attachment holds it.
inline std::vector<char> attached_vertices(const Muscle& muscle) {
  std::vector<char> attached(static_cast<std::size_t>(muscle.surface.vertex_count()), 0);
  for (const Attachment& attachment : muscle.attachments)
    for (const Index v : attachment.vertices) attached[static_cast<std::size_t>(v)] = 1;
  return attached;
}

}  // namespace gracilis
