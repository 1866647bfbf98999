#pragma once

#include <gracilis/methods/tissue/lattice.hpp>

#include <vector>

namespace gracilis::tissue {

/// How firmly attachments grip a field: a cell's side of attached surface so many times as firmly as one cell grips the
/// next.
inline constexpr Real attachment_grip = 100;

/// Draws a field to a value at a point: `grip` (m) times half the squared difference.
struct FieldGrip {
  EmbeddedPoint at;
  Real grip = 0;
  Index column = 0;  ///< of the fields, the one that is drawn to 1 there, while all others are drawn to 0
};

/// Discrete harmonic fields on the lattice, weighted by how full its cells are: nodes × `columns`. Inside the surface
/// they are within 0 and 1, at nodes beyond it they may go on. A grip with a column outside of them draws all to 0.
/// Parts of the lattice that nothing grips get 0. Throws QualityError where the fields have no solution.
Eigen::MatrixXd harmonic_lattice_fields(const Lattice& lattice, const std::vector<FieldGrip>& grips, Index columns);

/// What flows into a field at a point, m times the field's unit.
struct FieldSource {
  EmbeddedPoint at;
  Real flow = 0;
};

/// The discrete harmonic field of the lattice, weighted as above, that is fed by these sources: a value per node, to
/// which each part of the lattice adds a constant. Precondition: sources of each part sum to zero.
Eigen::VectorXd fed_lattice_field(const Lattice& lattice, const std::vector<FieldSource>& sources);

/// Gradient of a field in the middle of every cell: 3 × cells, 1/m.
Points cell_gradients(const Lattice& lattice, const Eigen::VectorXd& field);

}  // namespace gracilis::tissue
