#pragma once

#include <gracilis/geometry/polylines.hpp>
#include <gracilis/geometry/surface_binding.hpp>
#include <gracilis/geometry/topology.hpp>
#include <gracilis/scene/frame.hpp>
#include <gracilis/scene/scene.hpp>

#include <optional>
#include <vector>

namespace gracilis {

/// What a muscle's fibers say at one instant.
struct MuscleFibers {
  Polylines lines;                       ///< m; empty for a muscle without fibers
  std::vector<Real> lengths;             ///< m
  Real mean_length = 0;                  ///< m
  Real mean_strain = 0;                  ///< mean over fibers of length over length in the capture pose, less 1
  Real cross_section = 0;                ///< m², largest area across the mean fiber; 0 without a surface
  Real physiological_cross_section = 0;  ///< m², volume over mean length; 0 without a surface
};

/// Follows the fibers of all muscles of a scene. Those that a method knows itself are where its frames say; all others
/// are carried along with their surfaces, to which they are bound in the capture pose.
class FiberTracker {
 public:
  /// Makes and binds all fibers; takes seconds. Not those that stand in `capture`, the method's frame in the capture
  /// pose; all frames to come must have these, too. The scene must outlive this.
  explicit FiberTracker(const Scene& scene, const Frame* capture = nullptr);

  /// The fibers of every muscle, in the scene's order; deterministic for any number of threads.
  std::vector<MuscleFibers> follow(const Frame& frame) const;

  /// A muscle's fibers in the capture pose; empty for one without.
  const Polylines& rest(std::size_t muscle) const { return muscles_[muscle].rest; }

 private:
  struct Bound {
    Polylines rest;
    std::vector<Real> rest_lengths;
    std::optional<SurfaceBinding> binding;
    MeshTopology topology;
  };
  MuscleFibers follow(std::size_t muscle, const MuscleShape& shape) const;

  const Scene& scene_;
  std::vector<Bound> muscles_;
};

/// The largest area of a muscle's sections across its mean fiber (the mean of the fibers' points, all of which must
/// have as many), taken between a fifth and four fifths of its length, m².
Real largest_cross_section(const TriangleMesh& surface, const MeshTopology& topology, const Polylines& fibers);

}  // namespace gracilis
