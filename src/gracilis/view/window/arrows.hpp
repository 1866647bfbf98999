#pragma once

#include <gracilis/dynamics/solver/constraint_table.hpp>
#include <gracilis/view/pictures/correction_arrows.hpp>
#include <gracilis/view/window/glyphs.hpp>
#include <gracilis/view/window/shape_history.hpp>
#include <gracilis/view/window/window_state.hpp>

#include <vector>

namespace gracilis {

/// Where an arrow begins and what it stands for.
struct Displacement {
  Eigen::Vector3f root, moved;  ///< m
  ConstraintKind kind;
};

/// What each kind moved in a frame, or in one of its iterations, as the state asks: one entry per kind and root of the
/// muscles that are shown, without those that are zero.
std::vector<Displacement> displacements_of(const ShownShapes& shapes, const ShownFrame& frame,
                                           const WindowState& state);

/// How many iterations a frame has.
int iteration_count(const ShownFrame& frame);

/// A round factor (1, 2 or 5 times a power of ten) that makes all but the longest twentieth shorter than 15 mm.
Real arrow_scale(const std::vector<Displacement>& displacements);

/// Arrows `scale` times as long; those that would be shorter than half a millimetre are left out.
ColoredMesh arrow_mesh(const std::vector<Displacement>& displacements, Real scale);

}  // namespace gracilis
