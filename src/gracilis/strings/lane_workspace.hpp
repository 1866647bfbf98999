#pragma once

#include <gracilis/strings/string_lanes.hpp>

#include <Eigen/Core>

#include <array>
#include <vector>

namespace gracilis::strings {

/// What the vector kernel needs for one muscle in one pose, in the order of StringLanes; m, seen from `center`.
struct LaneWorkspace {
  Vec3 center = Vec3::Zero();
  LanePoints begun, moved, place;  ///< where the nodes were carried, how far they moved since, and the sum
  LanePoints before;               ///< `place` at the beginning of an iteration
  LanePoints bend;                 ///< second difference of `begun`, from double precision
  LanePoints tied_to, support, normal;

  std::vector<float> last_move, travelled;  ///< per string, m

  /// Strings that are a neighbor in any lane of a group, group after group, and where each group's end.
  std::vector<std::size_t> neighbors, neighbors_end;

  /// A bone from here: to cells of its grid, and from there back for directions.
  struct Bone {
    Eigen::Matrix<float, 3, 4> to_cells, from_cells;
    /// How far a string must have travelled before a node, or the middle after it, can be near the bone; m. The least
    /// of all nodes per string.
    std::vector<float> asked_from, asked_from_middle, clear_until;
  };
  std::vector<Bone> bones;

  /// Of one group of strings: the system of each node.
  std::array<std::vector<float>, 6> stiffness, inverse;
  LanePoints gradient, direction, solution;
  LanePoints last_solution, last_step;  ///< of the iteration before, where steps take back of it

  /// A cross-section that moves as one: its system, solved to the shift, m; the coupling is to the next.
  struct Section {
    Eigen::Matrix3f stiffness = Eigen::Matrix3f::Zero();
    Eigen::Vector3f shift = Eigen::Vector3f::Zero();
    float coupling = 0;
  };
  std::vector<Section> sections;

  std::array<std::vector<float>, 9> correlation, turn;  ///< of the cross-sections, row by row; a node per lane
};

}  // namespace gracilis::strings
