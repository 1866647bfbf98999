#include <gracilis/strings/string_arms.hpp>

#include <gracilis/strings/coupled_solver.hpp>

#include <algorithm>

namespace gracilis::strings {

namespace {

/// A string whose nodes move so many times as fast as the fastest of its muscle's ends is about to snap.
constexpr Real fastest = 6;

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

/// How nodes move that go with bodies.
Points held_motions(const MuscleStrings& muscle, const Points& places, const std::vector<Twist>& twists) {
  Points motions = Points::Zero(3, places.cols());
  for (Index s = 0; s < muscle.strings; ++s)
    for (Index i = 0; i < muscle.nodes; ++i)
      if (const Index body = body_holding(muscle, s, i); body >= 0) {
        const Index p = muscle.node(s, i);
        motions.col(p) = twists[static_cast<std::size_t>(body)].velocity_at(places.col(p));
      }
  return motions;
}

Points string_columns(const MuscleStrings& muscle, const Points& columns, Index string) {
  return columns.middleCols(muscle.node(string, 0), muscle.nodes);
}

/// The derivative of a muscle's strings at rest, and what follows from it.
class Equilibrium {
 public:
  Equilibrium(const MuscleStrings& muscle, const BoneDistances& bones, const StringState& settled)
      : muscle_(muscle),
        places_(settled.places),
        rates_(muscle, bones, settled.places, settled.bodies),
        solver_(muscle, rates_),
        by_length_(length_rates(muscle, settled.places)) {}

  const Points& length_rates_by_nodes() const { return by_length_; }
  bool is_stable(Index string) const { return solver_.is_stable(string); }

  /// -dL/dq of each string about a coordinate. Marks those that run off.
  Eigen::VectorXd arms(const std::vector<Twist>& twists, std::vector<char>& doubtful) const {
    Eigen::VectorXd arms = Eigen::VectorXd::Zero(muscle_.strings);
    Points motions = held_motions(muscle_, places_, twists);
    const Real ends = motions.colwise().norm().maxCoeff();
    const Points forces = rates_.by_places(motions) + rates_.by_bodies(twists);
    motions -= solver_.moves(forces);
    for (Index s = 0; s < muscle_.strings; ++s) {
      const Points of_string = string_columns(muscle_, motions, s);
      arms[s] = -of_string.cwiseProduct(string_columns(muscle_, by_length_, s)).sum();
      const bool runs_off = !of_string.allFinite() || of_string.colwise().norm().maxCoeff() > fastest * ends;
      if (runs_off) doubtful[static_cast<std::size_t>(s)] = 1;
    }
    return arms;
  }

  /// Force and moment on each of the bodies by the strings that count, whose tensions sum to 1.
  Eigen::MatrixXd wrenches(const std::vector<char>& doubtful) const {
    const auto counted = static_cast<Real>(std::count(doubtful.begin(), doubtful.end(), 0));
    Points weights = by_length_;
    for (Index s = 0; s < muscle_.strings; ++s)
      weights.middleCols(muscle_.node(s, 0), muscle_.nodes) *=
          doubtful[static_cast<std::size_t>(s)] ? 0 : 1 / counted;
    const Points adjoint = solver_.transposed(weights);
    Eigen::MatrixXd wrenches = rates_.by_bodies_transposed(adjoint);
    const Points at_held = rates_.by_places_transposed(adjoint) - weights;
    for (Index p = 0; p < places_.cols(); ++p)
      if (const Index body = body_holding(muscle_, p / muscle_.nodes, p % muscle_.nodes); body >= 0) {
        const Vec3 force = at_held.col(p), place = places_.col(p);
        wrenches.col(body).head<3>() += force;
        wrenches.col(body).tail<3>() += place.cross(force);
      }
    return wrenches;
  }

 private:
  const MuscleStrings& muscle_;
  const Points places_;
  ForceRates rates_;
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

}  // namespace

FiberActions string_actions(const MuscleStrings& muscle, const BoneDistances& bones, const StringState& state,
                            const std::vector<std::vector<Twist>>& coordinates) {
  StringState settled = state;
  FiberActions actions;
  actions.doubtful = settle(muscle, bones, settled);
  const Equilibrium equilibrium(muscle, bones, settled);
  actions.arms.resize(muscle.strings, static_cast<Index>(coordinates.size()));
  for (std::size_t c = 0; c < coordinates.size(); ++c)
    actions.arms.col(static_cast<Index>(c)) = equilibrium.arms(coordinates[c], actions.doubtful);
  const Points& by_length = equilibrium.length_rates_by_nodes();
  actions.origin_directions.resize(3, muscle.strings), actions.insertion_directions.resize(3, muscle.strings);
  for (Index s = 0; s < muscle.strings; ++s) {
    if (!equilibrium.is_stable(s)) actions.doubtful[static_cast<std::size_t>(s)] = 1;
    actions.origin_directions.col(s) = -by_length.col(muscle.node(s, 0));
    actions.insertion_directions.col(s) = -by_length.col(muscle.node(s, muscle.nodes - 1));
  }
  actions.mean_arms = mean_of_counted(actions.arms, actions.doubtful);
  actions.wrenches = equilibrium.wrenches(actions.doubtful);
  return actions;
}

}  // namespace gracilis::strings
