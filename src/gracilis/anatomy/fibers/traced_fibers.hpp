#pragma once

#include <gracilis/anatomy/fibers/fiber_field.hpp>
#include <gracilis/geometry/triangle_tree.hpp>

#include <optional>
#include <vector>

namespace gracilis {

/// Where fibers may run: inside a muscle's surface, from side to side of the sheets in it that they end on.
class FiberRoom {
 public:
  /// `surface` must outlive it; `sheets` have no faces where there are none. About `nodes_inside` of the grid's nodes
  /// lie inside.
  FiberRoom(const TriangleMesh& surface, const TriangleMesh& sheets, Index nodes_inside);

  const TriangleMesh& surface() const { return surface_; }      ///< m
  const SignedDistance& distance() const { return distance_; }  ///< from the surface
  const SolidGrid& grid() const { return grid_; }               ///< of what lies inside
  /// The surface and the sheets.
  const TriangleTree& bounds() const { return bounds_; }
  /// Whether fibers also end at seams: where sheets are given, all are.
  bool finds_seams() const { return finds_seams_; }

 private:
  const TriangleMesh& surface_;
  SignedDistance distance_;
  SolidGrid grid_;
  TriangleTree bounds_;
  bool finds_seams_;
};

/// The fiber through a place inside, along the field both ways, to where it ends; a line of less than two points where
/// the field does not lead there.
Points traced_fiber(const FiberRoom& room, const FiberField& field, const Vec3& place);

/// `count` fibers that fill the room evenly: of the fibers through its nodes, each of which stands for the more of the
/// section the shorter it is, one out of each of as many parts of equal section, cut across their longer way again and
/// again. Pieces that the room's edges cut off, shorter than a third of the median, are no fibers.
std::vector<Points> evenly_traced(const FiberRoom& room, const FiberField& field, Index count);

}  // namespace gracilis
