#pragma once

#include <gracilis/scene/twist.hpp>
#include <gracilis/strings/section_rates.hpp>

#include <vector>

namespace gracilis::strings {

/// The derivative of all forces on the free nodes of a muscle's strings (NodeForces) in one state, by the places of all
/// nodes and by the motions of bodies. Everything counts: how directions turn, how bones curve, how neighbors and their
/// cross-sections move (docs/mathematics.md, "Moment arms of strings"). Forces are over the tension, so in 1.
class ForceRates {
 public:
  /// `places`: of the nodes, world, m. The muscle must outlive this.
  ForceRates(const MuscleStrings& muscle, const BoneDistances& bones, const Points& places,
             const std::vector<RigidTransform>& bodies);

  /// What moving nodes (columns of `rates`, m per unit) does to the forces; zero at nodes that are not free.
  Points by_places(const Points& rates) const;
  /// Its transposed: from weights of free nodes to weights of all nodes.
  Points by_places_transposed(const Points& weights) const;
  /// What moving bodies does to the forces where nodes stay.
  Points by_bodies(const std::vector<Twist>& twists) const;
  /// Its transposed: a force and a moment about the world's origin per body (6 × bodies).
  Eigen::MatrixXd by_bodies_transposed(const Points& weights) const;

  /// The part of a string's own nodes, blocks of 3 × 3 per node: by the node before, itself, and the node after.
  const std::vector<Eigen::Matrix3d>& before() const { return before_; }
  const std::vector<Eigen::Matrix3d>& here() const { return here_; }
  const std::vector<Eigen::Matrix3d>& after() const { return after_; }

 private:
  struct Node;
  using BodyRate = Eigen::Matrix<Real, 3, 6>;
  /// How the force of a bone on a point changes with the point and with the turn of the bone's body.
  struct Pressure {
    Eigen::Matrix3d pull, by_turn;
  };

  void tie(const Node& node);
  void hold_among_neighbors(const Node& node);
  void support_by_plane(const Node& node, Real share);
  Real support_by_bones(const Node& node, const BoneDistances& bones);
  void find_bones_around(const BoneDistances& bones);
  void find_near_bones(Index string, const BoneDistances& bones);
  void keep_from_bones(const Node& node, const BoneDistances& bones);
  void press_out(Index p, Index body, const Pressure& pressure, Real share);
  void press_middle(Index p, Index body, const Pressure& pressure, bool is_first);

  void turn_with_string(const Node& node, const Eigen::Matrix3d& by_difference);
  void go_with_body(const Node& node, Index body, const Eigen::Matrix3d& pull, const Vec3& place);
  void turn_with_body(const Node& node, Index body, const Eigen::Matrix3d& by_turn);
  BodyRate& body_rate(Index node, Index body) { return by_body_[static_cast<std::size_t>(node * bodies_ + body)]; }
  /// Calls act(string, i, p) for every node that is free, p its column.
  template <class Act>
  void for_each_free_node(const Act& act) const {
    for (Index s = 0; s < muscle_.strings; ++s)
      for (Index i = 1; i + 1 < muscle_.nodes; ++i)
        if (body_holding(muscle_, s, i) < 0) act(s, i, muscle_.node(s, i));
  }

  const MuscleStrings& muscle_;
  const Points places_;
  const std::vector<RigidTransform> poses_;
  Index bodies_;
  SectionRates sections_;
  std::vector<Eigen::Matrix3d> before_, here_, after_;
  std::vector<Eigen::Matrix3d> neighbor_pull_;  ///< per node, by the mean place of its neighbors
  Points neighbor_arms_;                        ///< per node: from that mean place to where they want the node, m
  std::vector<BodyRate> by_body_;               ///< node by node
  std::vector<std::size_t> bones_around_;       ///< of the muscle
  std::vector<std::size_t> near_bones_;         ///< of the string whose nodes are looked at
};

}  // namespace gracilis::strings
