#include <gracilis/strings/string_arms.hpp>

#include <gracilis/strings/lane_relaxation.hpp>

#include <algorithm>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "gracilis/strings/string_arms.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, as Highway asks.
#include <gracilis/strings/lane_rest-inl.hpp>

HWY_BEFORE_NAMESPACE();
namespace gracilis::HWY_NAMESPACE {

/// Relative residuals that are left: of motions, whose arms it moves by micrometres, and of weights, whose work with
/// the same motions is the mean arm.
inline constexpr float motion_tolerance = 1e-3f, weight_tolerance = 1e-4f;
/// A string one of whose nodes moves so many times as fast as bodies carry any node of its muscle is about to snap ...
inline constexpr float fastest = 6;
/// ... but not one that hardly moves, m per unit of a coordinate.
inline constexpr float least_speed = 0.001f;

/// What a muscle's strings at rest say of its arms and forces.
class LaneActions {
 public:
  LaneActions(const strings::MuscleStrings& muscle, LaneWorkspace& workspace, RateWorkspace& rates,
              LaneEquilibrium& equilibrium)
      : muscle_(muscle),
        lanes_(muscle.lanes),
        w_(workspace),
        r_(rates),
        equilibrium_(equilibrium),
        width_(static_cast<std::size_t>(lanes_.width)),
        by_length_(length_rates()) {}

  void find_directions(FiberActions& actions) const {
    actions.origin_directions.resize(3, muscle_.strings), actions.insertion_directions.resize(3, muscle_.strings);
    const auto last = static_cast<std::size_t>(muscle_.nodes - 1);
    for (Index s = 0; s < muscle_.strings; ++s) {
      const auto string = static_cast<std::size_t>(s);
      actions.origin_directions.col(s) = -vector_at(by_length_, string, 0).normalized();
      actions.insertion_directions.col(s) = -vector_at(by_length_, string, last).normalized();
    }
  }

  /// A string that is about to snap would drag its neighbors along: found out, it is held, and all begins again.
  void find_arms(const std::vector<std::vector<Twist>>& coordinates, FiberActions& actions) {
    std::vector<char> left_out(actions.doubtful.size(), 0);
    for (bool found = true; found;) {
      std::vector<char> snap;
      for (const char stable : r_.stable) snap.push_back(!stable);
      actions.arms.resize(muscle_.strings, static_cast<Index>(coordinates.size()));
      for (std::size_t c = 0; c < coordinates.size(); ++c)
        actions.arms.col(static_cast<Index>(c)) = arms_about(coordinates[c], snap);
      found = false;
      for (std::size_t s = 0; s < snap.size(); ++s)
        if (snap[s]) found |= !left_out[s], left_out[s] = actions.doubtful[s] = 1;
      if (found) equilibrium_.leave_out(left_out);
    }
  }

  /// Force and moment on each of the bodies by the strings, whose tensions are equal and sum to 1.
  void find_wrenches(std::size_t bodies, FiberActions& actions) {
    std::vector<float> tension(width_, 0);
    std::fill_n(tension.begin(), muscle_.strings, 1 / static_cast<float>(muscle_.strings));
    Numbers weights = by_length_;
    for (std::size_t at = 0; 3 * at < weights.size(); at += hn::Lanes(D()))
      store_point(scaled(load(tension, at % width_), load_point(&weights[3 * at])), &weights[3 * at]);
    const Numbers adjoint = equilibrium_.transposed(weights, weight_tolerance);
    actions.wrenches.setZero(6, static_cast<Index>(bodies));
    for (std::size_t b = 0; b < bodies; ++b) {
      const auto [force, moment] = equilibrium_.on_body(b, adjoint);
      add_wrench(actions.wrenches, static_cast<Index>(b), force, moment + w_.center.cross(force));
    }
    // What the solve left over is taken for nodes that bodies carry, so that all forces balance whatever that is.
    const Numbers at_nodes = equilibrium_.by_places_transposed(adjoint);
    for (std::size_t c = 0; c < lanes_.bodies.size(); ++c) {
      LaneSums<6> sums;  // of forces and of moments
      for_lane_parts(weights.size() / 3, [&](std::size_t at, std::size_t part) HWY_ATTR {
        const Point each =
            scaled(load(lanes_.shares[c], at), load_point(&at_nodes[3 * at]) - load_point(&weights[3 * at]));
        sums.add(0, part, each), sums.add(3, part, cross(load(w_.place, at), each));
      });
      const Vec3 force = sums.total_point(0).cast<Real>();
      add_wrench(actions.wrenches, lanes_.bodies[c], force, sums.total_point(3).cast<Real>() + w_.center.cross(force));
    }
  }

 private:
  /// The derivative of each string's length by its nodes.
  Numbers length_rates() const {
    const std::size_t count = w_.place[0].size();
    Numbers rates(3 * count, 0);
    for (std::size_t at = 0; at + width_ < count; at += hn::Lanes(D())) {
      const Point segment = load(w_.place, at + width_) - load(w_.place, at);
      const V square = hn::Max(dot<Math>(segment, segment), lanes_of(1e-20f));
      const Point along = scaled(lanes_of(1) / hn::Sqrt(square), segment);
      store_point(load_point(&rates[3 * at]) - along, &rates[3 * at]);
      store_point(along, &rates[3 * (at + width_)]);
    }
    return rates;
  }

  Vec3 vector_at(const Numbers& points, std::size_t s, std::size_t i) const {
    const std::size_t lanes = hn::Lanes(D());
    const float* p = &points[3 * (i * width_ + s / lanes * lanes) + s % lanes];
    return Eigen::Vector3f(p[0], p[lanes], p[2 * lanes]).cast<Real>();
  }

  static void add_wrench(Eigen::MatrixXd& wrenches, Index body, const Vec3& force, const Vec3& moment) {
    wrenches.col(body).head<3>() += force, wrenches.col(body).tail<3>() += moment;
  }

  /// -dL/dq of each string. Marks those that run off.
  Eigen::VectorXd arms_about(const std::vector<Twist>& coordinate, std::vector<char>& runs_off) {
    std::vector<LaneTwist> twists;
    for (const Twist& twist : coordinate)
      twists.push_back({twist.velocity_at(w_.center).cast<float>(), twist.turning.cast<float>()});
    const Numbers carried = equilibrium_.carried(twists);
    const std::vector<float> usual = speeds(carried);
    const float bound = fastest * std::max(least_speed, *std::max_element(usual.begin(), usual.end()));
    const Numbers motions = equilibrium_.motions(twists, carried, motion_tolerance);
    const std::vector<float> found = speeds(motions);
    for (std::size_t s = 0; s < runs_off.size(); ++s)
      if (!(found[s] <= bound)) runs_off[s] = 1;
    std::vector<float> shortening(width_, 0);
    for (std::size_t at = 0; 3 * at < motions.size(); at += hn::Lanes(D())) {
      const V by_node = dot<Math>(load_point(&motions[3 * at]), load_point(&by_length_[3 * at]));
      store(load(shortening, at % width_) - by_node, shortening, at % width_);
    }
    return Eigen::Map<const Eigen::VectorXf>(shortening.data(), muscle_.strings).cast<Real>();
  }

  /// Of the fastest node of each string.
  std::vector<float> speeds(const Numbers& motions) const {
    std::vector<float> speeds(width_, 0);
    for (std::size_t at = 0; 3 * at < motions.size(); at += hn::Lanes(D())) {
      const Point motion = load_point(&motions[3 * at]);
      const V speed = hn::Sqrt(dot<Math>(motion, motion));
      // What is not a number stays so.
      store(hn::IfThenElse(hn::Lt(speed, load(speeds, at % width_)), load(speeds, at % width_), speed), speeds,
            at % width_);
    }
    speeds.resize(static_cast<std::size_t>(muscle_.strings));
    return speeds;
  }

  const strings::MuscleStrings& muscle_;
  const strings::StringLanes& lanes_;
  const LaneWorkspace& w_;
  const RateWorkspace& r_;
  LaneEquilibrium& equilibrium_;
  std::size_t width_;
  Numbers by_length_;
};

void find_actions(const strings::MuscleStrings& muscle, const strings::BoneDistances& bones,
                  const strings::StringState& state, const std::vector<std::vector<Twist>>& coordinates,
                  bool with_wrenches, LaneWorkspace& workspace, RateWorkspace& rates, FiberActions& actions) {
  LanePose(muscle, bones, state.bodies, workspace).begin(lane_places(muscle.lanes, state.places));
  LaneEquilibrium equilibrium(muscle, bones, state.bodies, workspace, rates);
  for (const float move : LaneRest(muscle, bones, workspace, rates, equilibrium).find())
    actions.doubtful.push_back(!(static_cast<Real>(move) < strings::unsettled_move));
  LaneActions found(muscle, workspace, rates, equilibrium);
  found.find_directions(actions);
  found.find_arms(coordinates, actions);
  if (with_wrenches) found.find_wrenches(state.bodies.size(), actions);
}

}  // namespace gracilis::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gracilis {

HWY_EXPORT(find_actions);

namespace strings {

FiberActions string_actions(const MuscleStrings& muscle, const BoneDistances& bones, const StringState& state,
                            const std::vector<std::vector<Twist>>& coordinates, bool with_wrenches) {
  // Kept between calls, as in relax_lanes.
  static thread_local LaneWorkspace workspace;
  static thread_local RateWorkspace rates;
  FiberActions actions;
  HWY_DYNAMIC_DISPATCH(find_actions)(muscle, bones, state, coordinates, with_wrenches, workspace, rates, actions);
  // Doubtful ones, too: fibers differ so much in their arms that a mean without some jumps by centimetres.
  actions.mean_arms = actions.arms.colwise().mean();
  return actions;
}

}  // namespace strings
}  // namespace gracilis
#endif
