#pragma once

#include <gracilis/dynamics/solver/constraint_kind.hpp>
#include <gracilis/dynamics/solver/surface_solve.hpp>

#include <span>

namespace gracilis {

/// When an iteration projects a kind: before contact between surfaces, as that contact, or after it; or only while a
/// surface settles after its iterations.
enum class ConstraintPhase { before_contact, settling, contact, after_contact };

/// What the solver knows of a kind of constraint.
struct ConstraintRow {
  ConstraintKind kind;
  const char* name;  ///< that users read, in the words of their settings
  ConstraintPhase phase;
  void (*project)(SurfaceSolve& surface);  ///< all of its constraints once; null where it is no one surface's
};

/// All kinds in the order in which an iteration projects them; bone contact is last, so that nothing pushes back into a
/// bone.
std::span<const ConstraintRow> constraint_table();

/// "none" for a kind without a row.
const char* name_of(ConstraintKind kind);

/// One projection of all constraints of a kind on one surface; none where that kind is no one surface's. The solver's
/// loop is made of these; benchmarks and tests call them alone.
void project_kind(ConstraintKind kind, SurfaceSolve& surface);

}  // namespace gracilis
