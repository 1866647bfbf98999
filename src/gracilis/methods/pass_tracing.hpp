#pragma once

#include <gracilis/core/types.hpp>

#include <cstddef>
#include <functional>
#include <string_view>

namespace gracilis {

/// What the constraints of one kind moved of a muscle, all at once.
struct SolverPass {
  std::size_t muscle = 0;
  std::string_view kind;  ///< of constraint
  int iteration = 0;      ///< of the frame, all its steps counted on; after the last one volume and contact settle
  Points moved = Points(3, 0);  ///< m, one per vertex of the muscle's surface
};
using PassTrace = std::function<void(const SolverPass&)>;

/// Of a method whose solver makes passes over its constraints.
class PassTracing {
 public:
  virtual ~PassTracing() = default;
  /// Tells what happens inside of the steps to come, for pictures that explain a solver. Calls may come from several
  /// threads at once, each muscle's in their order. An empty function costs nothing. Coarser copies that are simulated
  /// in the muscles' place have nothing to tell.
  virtual void trace_passes(PassTrace trace) = 0;
};

}  // namespace gracilis
