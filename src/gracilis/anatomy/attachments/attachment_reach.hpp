#pragma once

#include <gracilis/scene/pose.hpp>
#include <gracilis/scene/scene.hpp>

#include <string>
#include <vector>

namespace gracilis {

/// Fibers become at most so much longer than at rest; their whole working range is 0.5 to 1.5 of their optimal length
/// (Zajac 1989).
inline constexpr Real longest_reach = 2;

/// Vertices of an attachment that could not be held.
struct LetGo {
  std::string muscle, attachment;
  std::string other;   ///< the attachment that moves away
  Index vertices = 0;  ///< let go
  Index of = 0;        ///< held before
  Real stretch = 0;    ///< distance in the worst pose over the way along the surface's edges at rest
};

/// Takes from attachments the vertices from which another one of the same muscle, on another body, moves away further
/// than `longest_reach` times the way over the surface at rest: such a vertex lies near a bone that the muscle passes,
/// and no surface between the two could follow. The attachment with more vertices lets go, of two as large the first;
/// none that lists its vertices, and none that would lose all. Looks at no more than 60 of the poses, evenly.
std::vector<LetGo> let_go_beyond_reach(Scene& scene, const std::vector<Pose>& poses);

}  // namespace gracilis
