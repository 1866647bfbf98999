#pragma once

namespace gracilis {

/// Kinds of constraints; what each is called and does in an iteration: constraint_table.hpp.
enum class ConstraintKind {
  none,
  distance,
  tension,
  dihedral,
  volume,
  strain_limit,
  shape_limit,
  muscle_contact,
  slivers,
  rest_proximities,
  bone_contact
};

}  // namespace gracilis
