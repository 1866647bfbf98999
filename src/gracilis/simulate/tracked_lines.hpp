#pragma once

#include <gracilis/geometry/polylines.hpp>
#include <gracilis/geometry/surface_binding.hpp>
#include <gracilis/simulate/fiber_tracker.hpp>

#include <optional>
#include <vector>

namespace gracilis {

/// The bodies that a line's two ends are attached to, as indices into Scene::bodies.
struct EndBodies {
  std::size_t first = 0, last = 0;
};

/// A few lines of one muscle, from its origin to its insertion.
struct MuscleLines {
  Polylines lines;
  std::vector<EndBodies> ends;  ///< per line
};

/// A few of each muscle's fibers, at most 12, from attachment to attachment: they stand for the way that the whole
/// muscle takes.
class TrackedLines {
 public:
  /// Takes them from the fibers of `tracker`, where there is one. For muscles of which it has none, or whose fibers end
  /// away from the attachments (as those between two tendons do), it makes lines of 20 segments by `inner_fibers`.
  /// Muscles without an origin or an insertion have none. Scene and tracker must outlive this.
  TrackedLines(const Scene& scene, const FiberTracker* tracker);

  /// In the capture pose, per muscle.
  const std::vector<MuscleLines>& rest() const { return rest_; }

  /// Where a muscle's lines are in a frame. `fibers` are what the tracker says of it in that frame.
  Polylines follow(std::size_t muscle, const Points& vertices, const MuscleFibers& fibers) const;

  /// Whether a muscle's lines are some of the tracker's.
  bool asks_tracker(std::size_t muscle) const { return !chosen_[muscle].empty(); }

 private:
  std::vector<MuscleLines> rest_;
  std::vector<std::vector<Index>> chosen_;              ///< of the tracker's fibers, per muscle
  std::vector<std::optional<SurfaceBinding>> binding_;  ///< of own lines, per muscle
};

}  // namespace gracilis
