#pragma once

#include <gracilis/io/run/recorded_run.hpp>
#include <gracilis/view/pictures/picture.hpp>

#include <string>
#include <vector>

namespace gracilis {

/// The forces with which muscles pull at their ends, as arrows, of runs that have a forces.sto.

/// How long arrows are, m per N: 1, 2 or 5 times a power of ten, the largest at which the largest force of these runs
/// is no longer than 60 mm. Throws ConfigurationError where a run has no forces or none of an attachment, and
/// InputError where its table is damaged.
Real force_arrow_scale(const std::vector<RecordedRun>& runs);

/// What the forces of a run do at muscles' ends.
class ForceArrows {
 public:
  /// `scale` in m per N, above 0. Throws as force_arrow_scale does. The run must outlive this.
  ForceArrows(const RecordedRun& run, Real scale);

  /// Two arrows at most, one per end: from the middle of the vertices that are attached there, along the sum of what
  /// the muscle does to all bodies that this end holds on to. Their names tell the scale: they are the legend's.
  /// `surface` is the muscle in this frame.
  std::vector<PaintedSurface> of(std::size_t muscle, const TriangleMesh& surface, int frame) const;

  /// N; frames × 3, of one end (0 origin, 1 insertion); 0 × 3 where the run knows none.
  const Eigen::MatrixX3d& forces(std::size_t muscle, int end) const { return forces_[2 * muscle + end]; }

 private:
  Real scale_;
  std::vector<Eigen::MatrixX3d> forces_;      ///< two per muscle
  std::vector<std::vector<Index>> attached_;  ///< two per muscle: vertices
};

/// How an arrow looks.
struct ArrowShape {
  Real most_head = 0.012;  ///< m; a short arrow's head is half of it
  Index sides = 16;        ///< of a section, 3 or more
  Real shortest = 0.0005;  ///< m; what is shorter is not drawn
};

/// A closed arrow from `root` to `root + along`, m; empty where it is too short.
TriangleMesh arrow_surface(const Vec3& root, const Vec3& along, const ArrowShape& shape = {});

}  // namespace gracilis
