#pragma once

#include <Eigen/Core>

#include <vector>

namespace gracilis::strings {

/// A direction that a solver tried.
struct TriedDirection {
  std::vector<float> tried, image;  ///< what the matrix makes of it, less what points along images before, unit
  std::vector<float> of_images;     ///< shares of all images up to its own in what the matrix makes of it
};

/// How the forces on a muscle's strings change with the places of their nodes and with its bodies, in one state, for
/// the vector kernel. Nodes in the order of StringLanes; what a node has several numbers of lies group by group, number
/// by number (matrix_lanes-inl.hpp).
struct RateWorkspace {
  std::vector<float> free;                 ///< 1 for nodes that the equilibrium places, otherwise 0
  std::vector<float> force;                ///< 3 per node, 1
  std::vector<float> before, here, after;  ///< 9 per node, 1/m: by the node before, itself, and the node after
  std::vector<float> inverse, upper;       ///< 9 per node: each string's own part, eliminated
  std::vector<float> held;                 ///< per string: what its nodes are held with where they are, 1/m
  std::vector<char> stable;                ///< per string: no pivot of it is negative

  std::vector<float> direction;      ///< 3 per node: of the string, unit
  std::vector<float> inverse_reach;  ///< per node: 1 over the distance between its neighbors along the string, 1/m
  std::vector<float> arm;            ///< 3 per node: from its neighbors' mean place to where they want it, m
  std::vector<float> wanted;         ///< 3 per node: that place, m
  std::vector<float> section_arm;    ///< 3 per node: where its section has turned it about the center, m

  /// How a cross-section turns with its nodes.
  struct Section {
    Eigen::Matrix3f softness;   ///< from a moment to a turn
    Eigen::Matrix3f mean_rate;  ///< of the unit mean direction, by the sum of directions
    Eigen::Vector3f direction;  ///< where it has turned its direction, times its spread, m²
  };
  std::vector<Section> sections;

  /// By a body that moves: 9 numbers per node for its velocity at the workspace's center and 9 for its turning.
  struct Body {
    std::vector<float> by_velocity, by_turning;
  };
  std::vector<Body> bodies;

  std::vector<TriedDirection> directions, adjoint_directions;  ///< room for solvers
};

}  // namespace gracilis::strings
