// The derivative of the forces on a muscle's strings, a string per lane. Included once per instruction set.

#if defined(GRACILIS_LANE_RATES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRACILIS_LANE_RATES_INL
#undef GRACILIS_LANE_RATES_INL
#else
#define GRACILIS_LANE_RATES_INL
#endif

#include <gracilis/strings/field_curvature_lanes-inl.hpp>
#include <gracilis/strings/lane_forces-inl.hpp>
#include <gracilis/strings/matrix_lanes-inl.hpp>
#include <gracilis/strings/rate_workspace.hpp>
#include <gracilis/strings/relaxation.hpp>

HWY_BEFORE_NAMESPACE();
namespace gracilis::HWY_NAMESPACE {

using strings::RateWorkspace;

/// Differentiates all forces in the state that LanePose and LaneSteps left in a workspace: not only what Gauss-Newton
/// takes of them, but also how directions turn and bones curve. How neighbors and their cross-sections move is
/// LaneCoupling's.
class LaneRates {
 public:
  /// Precondition: LaneCoupling knows this state.
  LaneRates(const strings::MuscleStrings& muscle, const strings::BoneDistances& bones,
            const std::vector<RigidTransform>& bodies, const LaneWorkspace& workspace, RateWorkspace& rates)
      : lanes_(muscle.lanes),
        settings_(muscle.settings),
        bones_(bones),
        w_(workspace),
        r_(rates),
        width_(static_cast<std::size_t>(lanes_.width)),
        inner_(static_cast<std::size_t>(lanes_.nodes - 1)) {
    for (const RigidTransform& pose : bodies) {
      Affine& each = posed_.emplace_back();
      each.leftCols<3>() = pose.linear().cast<float>();
      each.col(3) = (pose * lanes_.center - w_.center).cast<float>();
    }
  }

  void differentiate() {
    const std::size_t count = width_ * (inner_ + 1);
    for (std::vector<float>* each : {&r_.before, &r_.here, &r_.after}) each->resize(9 * count);
    r_.force.resize(3 * count), r_.direction.resize(3 * count);
    r_.inverse_reach.resize(count);
    r_.bodies.resize(posed_.size());
    for (RateWorkspace::Body& body : r_.bodies)
      body.by_velocity.assign(9 * count, 0), body.by_turning.assign(9 * count, 0);
    for (std::size_t s = 0; s < width_; s += hn::Lanes(D())) {
      for (std::size_t i = 1; i < inner_; ++i) own(i, s);
      for (std::size_t b = 0; b < w_.bones.size(); ++b) press_by_bone(b, s);
    }
  }

 private:
  bool has_neighbors() const { return !lanes_.neighbor_weight.empty(); }
  V per_length(Real of_settings, std::size_t s) const {
    return load(lanes_.node_length, s) * lanes_of(static_cast<float>(1 / (of_settings * of_settings)));
  }

  /// A node's place on its string.
  struct Node {
    std::size_t at;
    Point place, direction;
    V inverse_reach;
    /// How a constant vector's part across the string changes, negative, with the difference of the node's neighbors.
    HWY_INLINE Matrix across_rate(Point v) const {
      const V along = dot<Math>(direction, v);
      const Point part = v - scaled(along, direction);
      const Matrix turned = plus_diagonal(outer(direction, part - scaled(along, direction)), along);
      return scaled(inverse_reach, turned);
    }
  };

  HWY_INLINE Node node(std::size_t at) const {
    const Point reach = load(w_.place, at + width_) - load(w_.place, at - width_);
    const V inverse = lanes_of(1) / hn::Sqrt(hn::Max(dot<Math>(reach, reach), lanes_of(1e-20f)));
    return {at, load(w_.place, at), scaled(inverse, reach), inverse};
  }

  /// Tension, ties, neighbors and the support's plane.
  HWY_INLINE void own(std::size_t i, std::size_t s) {
    const std::size_t at = i * width_ + s;
    const Node here = node(at);
    store_point(here.direction, &r_.direction[3 * at]);
    hn::StoreU(here.inverse_reach, D(), &r_.inverse_reach[at]);
    const V tension = load(lanes_.tension, s), zero = hn::Zero(D()), two = lanes_of(2);
    const Point moved = load(w_.moved, at);
    Point force = scaled(
        tension, load(w_.bend, at) + scaled(two, moved) - load(w_.moved, at - width_) - load(w_.moved, at + width_));
    const V tie = load(lanes_.tie, at) * per_length(settings_.tie_length, s);
    V across_string = tie;
    Point pull = scaled(tie, here.place - load(w_.tied_to, at));
    if (has_neighbors()) {
      const V neighbor = per_length(settings_.neighbor_length, s);
      across_string = across_string + neighbor;
      pull = pull + scaled(neighbor, here.place - load_point(&r_.wanted[3 * at]));
    }
    force = force + across(here.direction, pull);
    Matrix turning = scaled(lanes_of(-1), here.across_rate(pull));
    const Matrix projection = plus_diagonal(outer(scaled(lanes_of(-1), here.direction), here.direction), lanes_of(1));
    Matrix stiffness = plus_diagonal(scaled(across_string, projection), two * tension);
    const Point unit_normal = load(w_.normal, at), normal = across(here.direction, unit_normal);
    const Point offset = here.place - load(w_.support, at);
    const V depth = dot<Math>(normal, offset);
    const V plane =
        hn::IfThenElseZero(hn::Lt(depth, zero), load(lanes_.plane_share, at) * per_length(settings_.support_length, s));
    const bool on_plane = !hn::AllTrue(D(), hn::Eq(plane, zero));
    const Matrix by_plane = scaled(plane, outer(normal, normal));
    const Matrix by_normal = scaled(plane, plus_diagonal(outer(normal, offset), depth));
    if (on_plane) {
      force = force + scaled(plane * depth, normal);
      stiffness = stiffness + by_plane;
      turning = turning - times(by_normal, here.across_rate(unit_normal));
    }
    store_point(force, &r_.force[3 * at]);
    store_matrix(stiffness, &r_.here[9 * at]);
    const Matrix tense = plus_diagonal(zero_matrix(), zero - tension);
    store_matrix(tense - turning, &r_.before[9 * at]);
    store_matrix(tense + turning, &r_.after[9 * at]);
    go_with_bodies(at, scaled(tie, projection), by_plane, on_plane ? times(by_normal, projection) : zero_matrix());
  }

  /// What carries ties and planes along.
  HWY_INLINE void go_with_bodies(std::size_t at, Matrix by_tie, Matrix by_plane, Matrix by_unit_normal) {
    const Point taut = load(lanes_.taut, at), fiber = load(lanes_.fiber, at), normal = load(lanes_.normal, at);
    const V zero = hn::Zero(D());
    Point blend{zero, zero, zero};
    for (std::size_t c = 0; c < lanes_.bodies.size(); ++c)
      blend = plus_scaled(blend, load(lanes_.shares[c], at), turn(posed(c), normal));
    const V inverse = Math::inverse_sqrt(hn::Max(dot<Math>(blend, blend), lanes_of(1e-20f)));
    const Point unit_normal = scaled(inverse, blend);
    // By the blend, through its unit vector.
    const Matrix by_blend = scaled(inverse, by_unit_normal - outer(times(by_unit_normal, unit_normal), unit_normal));
    const Matrix by_place = by_tie + by_plane;
    for (std::size_t c = 0; c < lanes_.bodies.size(); ++c) {
      const V share = load(lanes_.shares[c], at);
      if (hn::AllTrue(D(), hn::Eq(share, zero))) continue;
      RateWorkspace::Body& rate = r_.bodies[static_cast<std::size_t>(lanes_.bodies[c])];
      const Matrix by_turning = times_cross(by_tie, apply(posed(c), taut)) +
                                times_cross(by_plane, apply(posed(c), fiber)) -
                                times_cross(by_blend, turn(posed(c), normal));
      store_matrix(scaled(zero - share, by_place), &rate.by_velocity[9 * at]);
      store_matrix(scaled(share, by_turning), &rate.by_turning[9 * at]);
    }
  }

  const Affine& posed(std::size_t carrying) const { return posed_[static_cast<std::size_t>(lanes_.bodies[carrying])]; }

  /// A bone's distance at a point, its unit gradient, and how that changes with the point.
  struct Seen {
    V distance, slope;
    Point outward;
    Matrix outward_rate;
    hn::Mask<D> has_direction;
  };

  HWY_INLINE Seen look(std::size_t b, Point place) const {
    const FieldGrid& grid = bones_.fields[b].grid;
    const Affine& from_cells = w_.bones[b].from_cells;
    const GridPlace at = grid_place(grid, apply(w_.bones[b].to_cells, place));
    const CurvedSplineSample sampled = sample_curved_lanes(grid, at);
    const Point gradient = turn(from_cells, sampled.gradient);
    const V slope = hn::Sqrt(dot<Math>(gradient, gradient)), least = lanes_of(static_cast<float>(strings::least_slope));
    const V inverse = lanes_of(1) / hn::Max(slope, least);
    const Point outward = scaled(inverse, gradient);
    const Matrix cells = full(sampled.curvature);
    const Matrix half_turned = {turn(from_cells, cells.x), turn(from_cells, cells.y), turn(from_cells, cells.z)};
    const auto row = [&](Index k) HWY_ATTR {
      return plus_scaled(
          plus_scaled(scaled(lanes_of(from_cells(k, 2)), half_turned.z), lanes_of(from_cells(k, 1)), half_turned.y),
          lanes_of(from_cells(k, 0)), half_turned.x);
    };
    return {sampled.distance, slope, outward, scaled(inverse, across(outward, Matrix{row(0), row(1), row(2)})),
            hn::And(at.inside, hn::Ge(slope, least))};
  }

  /// A spring by which a bone presses a point out, of stiffness `k` where that is nearer than it may be.
  struct Pressure {
    V k, depth;
    Matrix pull;  ///< the force's derivative by the point
  };

  HWY_INLINE Pressure pressure(const Seen& seen, V k, V kept) const {
    const V depth = seen.distance - kept;
    k = hn::IfThenElseZero(hn::And(seen.has_direction, hn::Lt(depth, hn::Zero(D()))), k);
    const Matrix pull = scaled(seen.slope, outer(seen.outward, seen.outward)) + scaled(depth, seen.outward_rate);
    return {k, depth, scaled(k, pull)};
  }

  /// Nodes and middles of segments keep to a bone the gap at rest, or less; supports let them slide over it.
  void press_by_bone(std::size_t b, std::size_t s) {
    const LaneWorkspace::Bone& bone = w_.bones[b];
    const strings::StringLanes::Bone& kept = lanes_.bones[b];
    const V travelled = load(w_.travelled, s);
    const auto is_far = [&](const std::vector<float>& from, std::size_t at)
                            HWY_ATTR { return hn::AllTrue(D(), hn::Gt(load(from, at), travelled)); };
    if (is_far(bone.clear_until, s)) return;
    RateWorkspace::Body& body = r_.bodies[static_cast<std::size_t>(bones_.bodies[b])];
    const V stiffness = lanes_of(static_cast<float>(settings_.bone_stiffness)) * load(lanes_.tension, s);
    const V support = per_length(settings_.support_length, s);
    for (std::size_t i = 1; i < inner_; ++i) {
      const std::size_t at = i * width_ + s;
      if (!is_far(bone.asked_from, at)) press_node(look(b, load(w_.place, at)), kept, at, stiffness, support, body);
      if (i + 1 == inner_ || is_far(bone.asked_from_middle, at)) continue;
      const Point middle = scaled(lanes_of(0.5f), load(w_.place, at) + load(w_.place, at + width_));
      press_middle(look(b, middle), middle, load(kept.kept_middle, at), at, stiffness, body);
    }
  }

  HWY_INLINE void press_node(const Seen& seen, const strings::StringLanes::Bone& kept, std::size_t at, V stiffness,
                             V support, RateWorkspace::Body& body) {
    const V zero = hn::Zero(D());
    const Pressure keeps = pressure(seen, stiffness, load(kept.kept, at));
    const Pressure slides = pressure(seen, load(kept.slide_share, at) * support, load(kept.slide_distance, at));
    if (hn::AllTrue(D(), hn::Eq(keeps.k + slides.k, zero))) return;
    const Node here = node(at);
    const Matrix pull = keeps.pull + across(here.direction, slides.pull);
    const V kept_force = keeps.k * keeps.depth, slide_force = slides.k * slides.depth;
    const Point sliding = across(here.direction, seen.outward);
    store_point(plus_scaled(plus_scaled(load_point(&r_.force[3 * at]), kept_force, seen.outward), slide_force, sliding),
                &r_.force[3 * at]);
    const Matrix turning = scaled(slide_force, here.across_rate(seen.outward));
    add_matrix(pull, &r_.here[9 * at]);
    add_matrix(turning, &r_.before[9 * at]);
    add_matrix(scaled(lanes_of(-1), turning), &r_.after[9 * at]);
    add_matrix(scaled(lanes_of(-1), pull), &body.by_velocity[9 * at]);
    // The force turns with the body: its part along the string not.
    const Matrix turned =
        plus_diagonal(outer(scaled(zero - slide_force, here.direction), here.direction), kept_force + slide_force);
    add_matrix(times_cross(pull, here.place) - times_cross(turned, seen.outward), &body.by_turning[9 * at]);
  }

  /// The middle of a segment is shared by its two nodes, each of which has half of its stiffness.
  HWY_INLINE void press_middle(const Seen& seen, Point middle, V kept, std::size_t at, V stiffness,
                               RateWorkspace::Body& body) {
    const V half = lanes_of(0.5f);
    const Pressure keeps = pressure(seen, stiffness, kept);
    if (hn::AllTrue(D(), hn::Eq(keeps.k, hn::Zero(D())))) return;
    const V force = half * keeps.k * keeps.depth;
    const Matrix by_node = scaled(lanes_of(0.25f), keeps.pull), by_body = scaled(lanes_of(-0.5f), keeps.pull);
    const Matrix by_turn =
        times_cross(scaled(half, keeps.pull), middle) - times_cross(plus_diagonal(zero_matrix(), force), seen.outward);
    add_matrix(by_node, &r_.after[9 * at]), add_matrix(by_node, &r_.before[9 * (at + width_)]);
    for (const std::size_t each : {at, at + width_}) {
      store_point(plus_scaled(load_point(&r_.force[3 * each]), force, seen.outward), &r_.force[3 * each]);
      add_matrix(by_node, &r_.here[9 * each]);
      add_matrix(by_body, &body.by_velocity[9 * each]);
      add_matrix(by_turn, &body.by_turning[9 * each]);
    }
  }

  const strings::StringLanes& lanes_;
  const strings::StringSettings& settings_;
  const strings::BoneDistances& bones_;
  const LaneWorkspace& w_;
  RateWorkspace& r_;
  std::size_t width_, inner_;  ///< inner_: the last node's number, which does not move
  std::vector<Affine> posed_;  ///< per body: from places seen from the muscle's center to the workspace's
};

}  // namespace gracilis::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
