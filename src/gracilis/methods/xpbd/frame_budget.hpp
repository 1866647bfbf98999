#pragma once

#include <gracilis/core/types.hpp>
#include <gracilis/methods/method.hpp>

#include <string>
#include <vector>

namespace gracilis::xpbd {

/// Keeps frames to a rate by a share of the iterations that the settings ask for.
struct FrameBudget {
  Real budget = 0;  ///< ms per frame; 0: no rate is asked for
  Real share = 1;   ///< of the iterations
};

/// No fewer iterations are made than this.
inline constexpr int least_iterations = 4;

/// The iterations of the next substep where `asked` are asked for.
int budgeted_iterations(const FrameBudget& budget, int asked);

/// Learns from a frame: spends 85 % of the budget, for no two frames are alike, falling at once and rising slowly.
void see_frame(FrameBudget& budget, Real milliseconds);

/// How a frame kept to the rate, and what that cost.
struct FrameBudgetReport {
  Real target_fps = 0;       ///< 1/s
  Real milliseconds = 0;     ///< that the frame took
  int iterations = 0;        ///< in each substep
  int asked_iterations = 0;  ///< without a rate to hold
  Index triangles = 0;       ///< simulated, all muscles
  Index asked_triangles = 0;
};

/// By name: target_fps, frame_milliseconds, iterations, asked_iterations, triangles, asked_triangles.
Metrics metrics_of(const FrameBudgetReport& frame);

/// What was given up to hold the rate; empty without frames.
std::string remark_on(const std::vector<FrameBudgetReport>& frames);

}  // namespace gracilis::xpbd
