// How a muscle's strings answer motions of bodies and forces at their nodes, in one state. Included once per
// instruction set.

#if defined(GRACILIS_LANE_EQUILIBRIUM_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRACILIS_LANE_EQUILIBRIUM_INL
#undef GRACILIS_LANE_EQUILIBRIUM_INL
#else
#define GRACILIS_LANE_EQUILIBRIUM_INL
#endif

#include <gracilis/scene/twist.hpp>
#include <gracilis/strings/krylov_lanes-inl.hpp>
#include <gracilis/strings/lane_coupling-inl.hpp>
#include <gracilis/strings/lane_elimination-inl.hpp>
#include <gracilis/strings/lane_rates-inl.hpp>

#include <utility>

HWY_BEFORE_NAMESPACE();
namespace gracilis::HWY_NAMESPACE {

/// A body's velocity at the workspace's center, and its turning.
struct LaneTwist {
  Eigen::Vector3f velocity, turning;
};

/// The derivative of all forces, and what follows from it where these are to stay zero. Vectors have 3 numbers per
/// node, in the order of RateWorkspace.
class LaneEquilibrium {
 public:
  /// All must outlive this.
  LaneEquilibrium(const strings::MuscleStrings& muscle, const strings::BoneDistances& bones,
                  const std::vector<RigidTransform>& bodies, LaneWorkspace& workspace, RateWorkspace& rates)
      : muscle_(muscle),
        lanes_(muscle.lanes),
        bones_(bones),
        bodies_(bodies),
        w_(workspace),
        r_(rates),
        coupling_(muscle, workspace, rates),
        elimination_(lanes_, rates),
        krylov_(rates.directions),
        width_(static_cast<std::size_t>(lanes_.width)),
        inner_(static_cast<std::size_t>(lanes_.nodes - 1)),
        count_(width_ * (inner_ + 1)) {}

  /// Where the nodes are now. All strings are free.
  void differentiate() {
    coupling_.look();
    LaneRates(muscle_, bones_, bodies_, w_, r_).differentiate();
    leave_out(std::vector<char>(static_cast<std::size_t>(lanes_.strings), 0));
  }

  /// Strings that are left out go with bodies by their shares, for all others, too.
  void leave_out(const std::vector<char>& left_out) {
    r_.free.assign(count_, 0);
    for (std::size_t i = 1; i < inner_; ++i)
      for (std::size_t s = 0; s < static_cast<std::size_t>(lanes_.strings); ++s)
        if (!left_out[s]) r_.free[i * width_ + s] = lanes_.free[i * width_ + s];
    r_.held.assign(width_, 0);
    eliminate();
  }

  /// Again, with strings held as the workspace says.
  void eliminate() {
    elimination_.eliminate();
    krylov_.forget();
  }

  /// How free nodes move so that forces change by `forces`, to this share of the first guess.
  Numbers moves(Numbers forces, float tolerance) {
    scale_free(forces);
    elimination_.solve(forces);
    if (!coupling_.is_there()) return forces;
    const auto multiply = [&](const Numbers& p, Numbers& q) {
      coupling_.add(p, q);
      elimination_.solve(q);
      add(p, q);
    };
    Numbers result;
    krylov_.solve(multiply, tolerance * length_of(forces), most_directions, forces, result);
    return result;
  }

  /// The transposed: weights of forces from weights of free nodes.
  Numbers transposed(Numbers weights, float tolerance) {
    scale_free(weights);
    elimination_.solve_transposed(weights);
    const auto multiply = [&](const Numbers& p, Numbers& q) {
      coupling_.add_transposed(p, q);
      scale_free(q);
      elimination_.solve_transposed(q);
      add(p, q);
    };
    Numbers result;
    KrylovLanes krylov(r_.adjoint_directions);
    krylov.solve(multiply, tolerance * length_of(weights), most_directions, weights, result);
    return result;
  }

  /// What moving nodes does to the forces on free ones.
  Numbers by_places(const Numbers& moves) const {
    Numbers forces(3 * count_, 0);
    elimination_.multiply(moves, forces);
    coupling_.add(moves, forces);
    return forces;
  }

  /// The transposed: from weights of free nodes to weights of all nodes.
  Numbers by_places_transposed(const Numbers& weights) {
    Numbers of_moves(3 * count_, 0);
    elimination_.add_transposed(weights, of_moves);
    coupling_.add_transposed(weights, of_moves);
    return of_moves;
  }

  /// Adds what moving bodies does to the forces on free nodes where nodes stay.
  void add_by_bodies(const std::vector<LaneTwist>& twists, Numbers& forces) const {
    for (std::size_t b = 0; b < twists.size(); ++b) {
      if (twists[b].velocity.isZero(0) && twists[b].turning.isZero(0)) continue;
      const Point velocity = lanes_of(twists[b].velocity), turning = lanes_of(twists[b].turning);
      for (std::size_t at = width_; at < count_ - width_; at += hn::Lanes(D())) {
        const Point force = times(load_matrix(&r_.bodies[b].by_velocity[9 * at]), velocity) +
                            times(load_matrix(&r_.bodies[b].by_turning[9 * at]), turning);
        store_point(plus_scaled(load_point(&forces[3 * at]), load(r_.free, at), force), &forces[3 * at]);
      }
    }
  }

  /// Its transposed: the force on a body, and the moment about the workspace's center.
  std::pair<Vec3, Vec3> on_body(std::size_t body, const Numbers& weights) const {
    LaneSums<6> sums;  // of forces and of moments
    for_lane_parts(count_ - 2 * width_, [&](std::size_t from_first, std::size_t part) HWY_ATTR {
      const std::size_t at = width_ + from_first;
      const Point weight = scaled(load(r_.free, at), load_point(&weights[3 * at]));
      sums.add(0, part, transposed_times(load_matrix(&r_.bodies[body].by_velocity[9 * at]), weight));
      sums.add(3, part, transposed_times(load_matrix(&r_.bodies[body].by_turning[9 * at]), weight));
    });
    return {sums.total_point(0).cast<Real>(), sums.total_point(3).cast<Real>()};
  }

  /// How bodies carry the nodes: by their shares, or all of it by the one that holds a node.
  Numbers carried(const std::vector<LaneTwist>& twists) const {
    Numbers motions(3 * count_);
    for (std::size_t at = 0; at < count_; at += hn::Lanes(D())) {
      const V zero = hn::Zero(D());
      const Point place = load(w_.place, at);
      Point sum{zero, zero, zero};
      for (std::size_t c = 0; c < lanes_.bodies.size(); ++c) {
        const LaneTwist& twist = twists[static_cast<std::size_t>(lanes_.bodies[c])];
        const Point velocity = lanes_of(twist.velocity) + cross(lanes_of(twist.turning), place);
        sum = plus_scaled(sum, load(lanes_.shares[c], at), velocity);
      }
      store_point(sum, &motions[3 * at]);
    }
    return motions;
  }

  /// How all nodes move with the bodies, from what these carry on, so that no force changes.
  Numbers motions(const std::vector<LaneTwist>& twists, Numbers carried, float tolerance) {
    Numbers forces = by_places(carried);
    add_by_bodies(twists, forces);
    const Numbers back = moves(std::move(forces), tolerance);
    for (std::size_t at = 0; at < carried.size(); at += hn::Lanes(D()))
      hn::StoreU(hn::LoadU(D(), &carried[at]) - hn::LoadU(D(), &back[at]), D(), &carried[at]);
    return carried;
  }

 private:
  static constexpr int most_directions = 40;

  static void add(const Numbers& x, Numbers& to) {
    for (std::size_t at = 0; at < x.size(); at += hn::Lanes(D()))
      hn::StoreU(hn::LoadU(D(), &to[at]) + hn::LoadU(D(), &x[at]), D(), &to[at]);
  }
  void scale_free(Numbers& x) const {
    for (std::size_t at = 0; at < count_; at += hn::Lanes(D()))
      store_point(scaled(load(r_.free, at), load_point(&x[3 * at])), &x[3 * at]);
  }

  const strings::MuscleStrings& muscle_;
  const strings::StringLanes& lanes_;
  const strings::BoneDistances& bones_;
  const std::vector<RigidTransform>& bodies_;
  LaneWorkspace& w_;
  RateWorkspace& r_;
  LaneCoupling coupling_;
  LaneElimination elimination_;
  KrylovLanes krylov_;
  std::size_t width_, inner_, count_;  ///< inner_: the last node's number; count_: nodes
};

}  // namespace gracilis::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
