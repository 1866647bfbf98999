#pragma once

#include <gracilis/core/types.hpp>
#include <gracilis/scene/frame.hpp>
#include <gracilis/scene/pose.hpp>

#include <cstddef>
#include <functional>
#include <vector>

namespace gracilis {

/// What happened to one muscle in one frame.
struct MuscleReport {
  int iterations = 0;
  Index triangles = 0;            ///< of the surface that was simulated; 0: the method simulates none
  Real largest_correction = 0;    ///< m, farthest that the solver moved a vertex from where it was predicted
  Index contacts = 0;             ///< points touching a bone at the end
  Index limited_hinges = 0;       ///< hinge projections held back, over all iterations
  Index limited_edges = 0;        ///< edges held at the stretch limit, over all iterations
  Index skipped_constraints = 0;  ///< projections without a usable gradient, over all iterations
  Index virtual_edges = 0;        ///< between this muscle and others; 0 where contact is not by virtual edges
  Index virtual_pushes = 0;       ///< of these, pushed apart in the last iteration
  Index coinciding_edges = 0;     ///< of these, on the same vertices as another at the end
  Real milliseconds = 0;
};

/// How a method kept to a rate of frames, and what that cost.
struct PaceReport {
  Real target_fps = 0;       ///< 1/s; 0: no rate was asked for
  Real milliseconds = 0;     ///< that the frame took
  int iterations = 0;        ///< in each substep
  int asked_iterations = 0;  ///< without a rate to hold
  Index triangles = 0;       ///< simulated, all muscles
  Index asked_triangles = 0;
};

enum class ConstraintKind;  // dynamics/solver.hpp

/// What the constraints of one kind moved of a muscle, all at once.
struct SolverPass {
  std::size_t muscle = 0;
  ConstraintKind kind{};
  int iteration = 0;  ///< of the frame, all its steps counted on; after the last one volume and contact settle
  Points moved = Points(3, 0);  ///< m, one per vertex of the muscle's surface
};
using PassWatch = std::function<void(const SolverPass&)>;

struct StepReport {
  std::vector<MuscleReport> muscles;  ///< in the scene's order
  PaceReport pace = {};
};

/// A way to deform muscles, prepared for one scene. The problem it solves: given where every body is, where are the
/// surfaces of the muscles? At the capture pose the answer is the input itself. Rigid motion of all bodies moves the
/// answer rigidly; the answer is finite, or QualityError is thrown; it has the same bits for any number of threads.
class DeformationMethod {
 public:
  virtual ~DeformationMethod() = default;

  /// Back to the capture pose: frame 0.
  virtual void reset() = 0;
  /// To the next pose. Throws QualityError that names muscle and constraint when a coordinate stops being finite; the
  /// state is then that before the call. Throws Interrupted where a StopScope says so; only reset and restore make
  /// sense then.
  virtual StepReport advance(const Pose& pose) = 0;
  /// Tells what happens inside of the steps to come, for pictures that explain a solver. Calls may come from several
  /// threads at once, each muscle's in their order. An empty function costs nothing. Methods without iterations have
  /// nothing to tell, nor do coarser copies that are simulated in the muscles' place.
  virtual void watch_passes(PassWatch /*watch*/) {}
  /// The present shapes, into frame.muscles.
  virtual void write(Frame& frame) const = 0;
  /// Continues from a recorded frame and the one before it, as if this method had made them: to the same bits from a
  /// frame whose number is a multiple of resume_period(scene). `poses` are those of all frames from the capture pose up
  /// to the last, for what a method follows through them.
  virtual void restore(const std::vector<Pose>& poses, const Frame& before, const Frame& last) = 0;
};

}  // namespace gracilis
