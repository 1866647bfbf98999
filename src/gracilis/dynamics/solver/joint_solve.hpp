#pragma once

#include <gracilis/core/parallel.hpp>
#include <gracilis/dynamics/solver/surface_solve.hpp>

#include <chrono>
#include <vector>

namespace gracilis {

/// Surfaces that are solved together, what acts between them, and which of them move while the others stay.
class JointSolve {
 public:
  /// Resets multipliers and reports. What it is given must outlive it.
  JointSolve(std::vector<SurfaceSolve>& surfaces, const Coupling& coupling, const SolveTrace& trace);

  std::vector<SurfaceSolve>& surfaces;
  const Coupling& coupling;
  Movers movers;

  /// Since it began, ms.
  double elapsed() const { return milliseconds_since(begin_); }

  /// Calls act(i) for the surfaces of which is_wanted(i) holds, side by side; each one's time goes to its report.
  template <class Wanted, class Act>
  void for_each(const Wanted& is_wanted, const Act& act) {
    parallel_for_each(surfaces.size(), [&](std::size_t i) {
      if (!is_wanted(i)) return;
      const Clock::time_point started = Clock::now();
      act(i);
      surfaces[i].report.milliseconds += milliseconds_since(started);
    });
  }

  /// Says that a kind was projected on a surface.
  void tell(std::size_t i, ConstraintKind kind) const {
    if (trace_) trace_(i, kind);
  }

  /// Projects contact between the surfaces once; its time is shared out among all reports.
  void project_contact();

 private:
  using Clock = std::chrono::steady_clock;
  static double milliseconds_since(Clock::time_point begin) {
    return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
  }

  const Clock::time_point begin_ = Clock::now();
  const SolveTrace& trace_;
};

}  // namespace gracilis
