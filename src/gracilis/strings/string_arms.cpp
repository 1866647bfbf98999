#include <gracilis/strings/string_arms.hpp>

#include <gracilis/strings/coupled_solver.hpp>

#include <algorithm>
#include <utility>

namespace gracilis::strings {

namespace {

/// A string one of whose nodes moves so many times as fast as bodies carry any node of its muscle is about to snap ...
constexpr Real fastest = 6;
/// ... but not one that hardly moves, m per unit of a coordinate.
constexpr Real least_speed = 0.001;

/// The derivative of each string's length by its nodes.
Points length_rates(const MuscleStrings& muscle, const Points& places) {
  Points rates = Points::Zero(3, places.cols());
  for (Index s = 0; s < muscle.strings; ++s)
    for (Index i = 0; i + 1 < muscle.nodes; ++i) {
      const Index p = muscle.node(s, i);
      const Vec3 along = (places.col(p + 1) - places.col(p)).normalized();
      rates.col(p) -= along, rates.col(p + 1) += along;
    }
  return rates;
}

/// By how much a node goes with each body where it is not free: fully with the one that holds it; by the bodies' shares
/// where its string is left out; empty where it is free.
Eigen::VectorXd carried_by(const MuscleStrings& muscle, Index string, Index i, bool left_out) {
  const Index body = body_holding(muscle, string, i);
  if (body >= 0) return Eigen::VectorXd::Unit(muscle.shares.rows(), body);
  return left_out ? Eigen::VectorXd(muscle.shares.col(muscle.node(string, i))) : Eigen::VectorXd();
}

/// The velocity of a place that goes with bodies by these shares.
Vec3 carried_velocity(const Eigen::VectorXd& shares, const std::vector<Twist>& twists, const Vec3& place) {
  Vec3 velocity = Vec3::Zero();
  for (Index body = 0; body < shares.size(); ++body)
    velocity += shares[body] * twists[static_cast<std::size_t>(body)].velocity_at(place);
  return velocity;
}

Points string_columns(const MuscleStrings& muscle, const Points& columns, Index string) {
  return columns.middleCols(muscle.node(string, 0), muscle.nodes);
}

/// The derivative of a muscle's strings at rest, and what follows from it.
class Equilibrium {
 public:
  /// `left_out`: strings that go with the bodies by their shares, for all others, too. All must outlive this.
  Equilibrium(const MuscleStrings& muscle, const ForceRates& rates, const Points& places,
              const std::vector<char>& left_out)
      : muscle_(muscle),
        places_(places),
        rates_(rates),
        left_out_(left_out),
        solver_(muscle, rates, left_out),
        by_length_(length_rates(muscle, places)) {}

  bool is_stable(Index string) const { return solver_.is_stable(string); }

  /// -dL/dq of each string about a coordinate. Marks those that run off.
  Eigen::VectorXd arms(const std::vector<Twist>& twists, std::vector<char>& runs_off) const {
    Eigen::VectorXd arms = Eigen::VectorXd::Zero(muscle_.strings);
    Points motions = carried_motions(twists);
    const Real usual = std::max(fastest_carried(twists), motions.colwise().norm().maxCoeff());
    const Points forces = rates_.by_places(motions) + rates_.by_bodies(twists);
    motions -= solver_.moves(forces);
    for (Index s = 0; s < muscle_.strings; ++s) {
      const Points of_string = string_columns(muscle_, motions, s);
      arms[s] = -of_string.cwiseProduct(string_columns(muscle_, by_length_, s)).sum();
      if (!of_string.allFinite() || of_string.colwise().norm().maxCoeff() > fastest * usual)
        runs_off[static_cast<std::size_t>(s)] = 1;
    }
    return arms;
  }

  /// Force and moment on each of the bodies by the strings that are not doubtful, whose tensions sum to 1.
  Eigen::MatrixXd wrenches(const std::vector<char>& doubtful) const {
    const auto counted = static_cast<Real>(std::count(doubtful.begin(), doubtful.end(), 0));
    Points weights = by_length_;
    for (Index s = 0; s < muscle_.strings; ++s)
      weights.middleCols(muscle_.node(s, 0), muscle_.nodes) *= doubtful[static_cast<std::size_t>(s)] ? 0 : 1 / counted;
    const Points adjoint = solver_.transposed(weights);
    Eigen::MatrixXd wrenches = rates_.by_bodies_transposed(adjoint);
    const Points at_carried = rates_.by_places_transposed(adjoint) - weights;
    for (Index p = 0; p < places_.cols(); ++p) {
      const Vec3 force = at_carried.col(p), place = places_.col(p);
      const Eigen::VectorXd shares = carried(p);
      for (Index body = 0; body < shares.size(); ++body) {
        wrenches.col(body).head<3>() += shares[body] * force;
        wrenches.col(body).tail<3>() += shares[body] * place.cross(force);
      }
    }
    return wrenches;
  }

 private:
  Eigen::VectorXd carried(Index p) const {
    const Index string = p / muscle_.nodes;
    return carried_by(muscle_, string, p % muscle_.nodes, left_out_[static_cast<std::size_t>(string)] != 0);
  }

  /// By the shares of bodies.
  Real fastest_carried(const std::vector<Twist>& twists) const {
    Real speed = least_speed;
    for (Index p = 0; p < places_.cols(); ++p)
      speed = std::max(speed, carried_velocity(muscle_.shares.col(p), twists, places_.col(p)).norm());
    return speed;
  }

  Points carried_motions(const std::vector<Twist>& twists) const {
    Points motions = Points::Zero(3, places_.cols());
    for (Index p = 0; p < places_.cols(); ++p) motions.col(p) = carried_velocity(carried(p), twists, places_.col(p));
    return motions;
  }

  const MuscleStrings& muscle_;
  const Points& places_;
  const ForceRates& rates_;
  const std::vector<char>& left_out_;
  CoupledSolver solver_;
  Points by_length_;
};

Eigen::VectorXd mean_of_counted(const Eigen::MatrixXd& arms, const std::vector<char>& doubtful) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(arms.cols());
  Real counted = 0;
  for (Index s = 0; s < arms.rows(); ++s)
    if (!doubtful[static_cast<std::size_t>(s)]) sum += arms.row(s).transpose(), ++counted;
  return counted > 0 ? Eigen::VectorXd(sum / counted) : sum;
}

/// Every string about every coordinate. Returns which are about to snap.
std::vector<char> find_arms(const MuscleStrings& muscle, const Equilibrium& equilibrium,
                            const std::vector<std::vector<Twist>>& coordinates, Eigen::MatrixXd& arms) {
  std::vector<char> snap;
  for (Index s = 0; s < muscle.strings; ++s) snap.push_back(!equilibrium.is_stable(s));
  arms.resize(muscle.strings, static_cast<Index>(coordinates.size()));
  for (std::size_t c = 0; c < coordinates.size(); ++c)
    arms.col(static_cast<Index>(c)) = equilibrium.arms(coordinates[c], snap);
  return snap;
}

}  // namespace

FiberActions string_actions(const MuscleStrings& muscle, const BoneDistances& bones, const StringState& state,
                            const std::vector<std::vector<Twist>>& coordinates) {
  StringState settled = state;
  FiberActions actions;
  actions.doubtful = settle_nearly(muscle, bones, settled);
  const Points by_length = length_rates(muscle, settled.places);
  actions.origin_directions.resize(3, muscle.strings), actions.insertion_directions.resize(3, muscle.strings);
  for (Index s = 0; s < muscle.strings; ++s) {
    actions.origin_directions.col(s) = -by_length.col(muscle.node(s, 0));
    actions.insertion_directions.col(s) = -by_length.col(muscle.node(s, muscle.nodes - 1));
  }
  const ForceRates rates(muscle, bones, settled.places, settled.bodies);
  // A string that is about to snap would drag its neighbors along: found out, it is left out, and all begins again.
  std::vector<char> left_out(actions.doubtful.size(), 0);
  for (bool found = true; found;) {
    const Equilibrium equilibrium(muscle, rates, settled.places, left_out);
    const std::vector<char> snap = find_arms(muscle, equilibrium, coordinates, actions.arms);
    found = false;
    for (std::size_t s = 0; s < snap.size(); ++s)
      if (snap[s]) found |= !left_out[s], actions.doubtful[s] = 1;
    if (!found) actions.wrenches = equilibrium.wrenches(actions.doubtful);
    for (std::size_t s = 0; s < snap.size(); ++s) left_out[s] |= snap[s];
  }
  actions.mean_arms = mean_of_counted(actions.arms, actions.doubtful);
  return actions;
}

}  // namespace gracilis::strings
