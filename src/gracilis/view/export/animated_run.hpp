#pragma once

#include <gracilis/io/run/recorded_run.hpp>

#include <string>
#include <vector>

namespace gracilis {

/// How a run becomes an animation in another program's format.
struct AnimationOptions {
  Index muscle_vertices = 4000;  ///< about, at most, of each muscle; they are some of its own
  Index bone_vertices = 4000;
  int frames = 60;              ///< at most; first, last and as many between as are allowed
  Real frames_per_second = 20;  ///< of the animation
};

/// A muscle or a bone as an animation shows it, thinned, about the run's place, m.
struct AnimatedSurface {
  std::string name;
  std::vector<Index> vertices;  ///< those of the recorded surface that stay
  Eigen::Matrix3Xi faces;       ///< of these
  Points rest;                  ///< in frame 0
};

/// Throws InputError, like the next two.
AnimatedSurface animated_surface(const RecordedRun& run, const std::string& name, Index most_vertices);

/// Where its vertices are in a frame.
Points points_in(const RecordedRun& run, const AnimatedSurface& surface, int frame);

/// How a bone moved since frame 0, in each of `frames`.
std::vector<RigidTransform> bone_motions(const RecordedRun& run, const std::string& name,
                                         const std::vector<int>& frames);

/// Turns the run's frame into one with x to the subject's left, y up and z ahead, as animation programs have it.
Eigen::Matrix3d upright_turn(const RecordedRun& run);

}  // namespace gracilis
