// Gauss-Newton steps of a muscle's strings in one pose. Included once per instruction set.

#if defined(GRACILIS_LANE_STEP_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRACILIS_LANE_STEP_INL
#undef GRACILIS_LANE_STEP_INL
#else
#define GRACILIS_LANE_STEP_INL
#endif

#include <gracilis/strings/lane_pose-inl.hpp>
#include <gracilis/strings/relaxation.hpp>
#include <gracilis/strings/section_lanes-inl.hpp>
#include <gracilis/strings/section_shift-inl.hpp>

HWY_BEFORE_NAMESPACE();
namespace gracilis::HWY_NAMESPACE {

/// Moves the strings of one muscle in one pose; the workspace is that of LanePose.
class LaneSteps {
 public:
  LaneSteps(const strings::MuscleStrings& muscle, const strings::BoneDistances& bones, LaneWorkspace& workspace)
      : lanes_(muscle.lanes),
        settings_(muscle.settings),
        bones_(bones),
        w_(workspace),
        width_(static_cast<std::size_t>(lanes_.width)),
        inner_(static_cast<std::size_t>(lanes_.nodes - 1)),
        sections_move_(settings_.sections_first && has_neighbors()) {
    if (has_neighbors()) list_neighbors();
  }

  void relax(const strings::Relaxation& relaxation) {
    const float stop_move = std::max(static_cast<float>(relaxation.stop_move), strings::least_lane_move);
    const V stop = lanes_of(stop_move);
    for (int iteration = 0; iteration < relaxation.iterations; ++iteration) {
      if (has_neighbors()) look_at_sections(iteration);
      const auto taken = static_cast<float>(strings::taken_share(relaxation, iteration));
      for_moving_groups(stop, [&](std::size_t s) HWY_ATTR {
        assemble(s);
        for (std::size_t b = 0; b < w_.bones.size(); ++b) keep_from_bone(b, s);
      });
      shift_sections(stop_move);
      bool any_moves = sections_move_;
      for_moving_groups(stop, [&](std::size_t s) HWY_ATTR {
        solve(s);
        move(s, stop, taken, iteration);
        any_moves |= !hn::AllTrue(D(), hn::Lt(load(w_.last_move, s), stop));
      });
      if (!any_moves) return;
    }
  }

 private:
  bool has_neighbors() const { return !lanes_.neighbor_weight.empty(); }

  /// Groups none of whose strings moves are left out, but where their sections take them along.
  template <class Act>
  void for_moving_groups(V stop, const Act& act) {
    for (std::size_t s = 0; s < width_; s += hn::Lanes(D()))
      if (sections_move_ || !hn::AllTrue(D(), hn::Lt(load(w_.last_move, s), stop))) act(s);
  }

  void shift_sections(float stop_move) {
    sections_shifted_ = sections_move_;
    if (!sections_shifted_) return;
    const auto neighbor = static_cast<float>(1 / (settings_.neighbor_length * settings_.neighbor_length));
    sections_move_ = SectionShift(lanes_, neighbor, w_).apply() >= stop_move;
  }

  void look_at_sections(int iteration) {
    constexpr int first_steps = 6, further_steps = 2;
    w_.before = w_.place;
    correlate_sections(lanes_, w_);
    turn_sections(iteration == 0 ? first_steps : further_steps, w_);
  }

  /// Per group of lanes, the strings that are a neighbor in any of them: most are in none.
  void list_neighbors() {
    w_.neighbors.clear(), w_.neighbors_end.clear();
    for (std::size_t s = 0; s < width_; s += hn::Lanes(D())) {
      for (std::size_t j = 0; j < static_cast<std::size_t>(lanes_.strings); ++j)
        if (!hn::AllTrue(D(), hn::Eq(load(lanes_.neighbor_weight, j * width_ + s), hn::Zero(D()))))
          w_.neighbors.push_back(j);
      w_.neighbors_end.push_back(w_.neighbors.size());
    }
  }

  /// Where its neighbors want a node.
  HWY_INLINE Point among_neighbors(std::size_t i, std::size_t s) const {
    const V zero = hn::Zero(D());
    const std::size_t row = i * width_, group = s / hn::Lanes(D());
    Point there{zero, zero, zero};
    for (std::size_t k = group == 0 ? 0 : w_.neighbors_end[group - 1]; k < w_.neighbors_end[group]; ++k) {
      const std::size_t j = w_.neighbors[k];
      const V weight = load(lanes_.neighbor_weight, j * width_ + s);
      there.x = hn::MulAdd(weight, lanes_of(w_.before[0][row + j]), there.x);
      there.y = hn::MulAdd(weight, lanes_of(w_.before[1][row + j]), there.y);
      there.z = hn::MulAdd(weight, lanes_of(w_.before[2][row + j]), there.z);
    }
    const Point rest = load(lanes_.from_neighbors, row + s);
    const auto turned_row = [&](std::size_t k) HWY_ATTR {
      return hn::MulAdd(lanes_of(w_.turn[3 * k][i]), rest.x,
                        hn::MulAdd(lanes_of(w_.turn[3 * k + 1][i]), rest.y, lanes_of(w_.turn[3 * k + 2][i]) * rest.z));
    };
    return there + Point{turned_row(0), turned_row(1), turned_row(2)};
  }

  /// All but bones.
  void assemble(std::size_t s) {
    const V tension = load(lanes_.tension, s), length = load(lanes_.node_length, s);
    const auto per_length = [](Real of_settings) {
      return lanes_of(static_cast<float>(1 / (of_settings * of_settings)));
    };
    const V tie = length * per_length(settings_.tie_length), support = length * per_length(settings_.support_length),
            neighbor = length * per_length(settings_.neighbor_length);
    const V zero = hn::Zero(D()), two = lanes_of(2);
    for (std::size_t i = 1; i < inner_; ++i) {
      const std::size_t at = i * width_ + s;
      const Point place = load(w_.place, at);
      const Point direction = unit(load(w_.place, at + width_) - load(w_.place, at - width_));
      const Point moved = load(w_.moved, at);
      NodeSystem node{diagonal(two * tension),
                      scaled(tension, load(w_.bend, at) + scaled(two, moved) - load(w_.moved, at - width_) -
                                          load(w_.moved, at + width_))};
      node.add_across(load(lanes_.tie, at) * tie, direction, place - load(w_.tied_to, at));
      if (has_neighbors()) node.add_across(neighbor, direction, place - among_neighbors(i, s));
      const Point normal = across(direction, load(w_.normal, at));
      const V depth = dot<Math>(normal, place - load(w_.support, at));
      node.add_spring(hn::IfThenElseZero(hn::Lt(depth, zero), load(lanes_.plane_share, at) * support), normal, depth);
      store(node.stiffness, w_.stiffness, at);
      store(node.gradient, w_.gradient, at);
      store(direction, w_.direction, at);
    }
  }

  struct Seen {
    V distance;
    Point outward;
    hn::Mask<D> has_direction;
  };

  HWY_INLINE Seen look(std::size_t b, Point place) const {
    const BoundedField& field = bones_.fields[b];
    const GridPlace at = grid_place(field.grid, apply(w_.bones[b].to_cells, place));
    if (hn::AllFalse(D(), at.inside)) return {distance_beyond(field, at.cells), place, at.inside};
    const SplineSample sampled = sample_spline_lanes(field.grid, at);
    const Point gradient = turn(w_.bones[b].from_cells, sampled.gradient);
    const V slope = hn::Sqrt(dot<Math>(gradient, gradient)), least = lanes_of(static_cast<float>(strings::least_slope));
    return {hn::IfThenElse(at.inside, sampled.distance, distance_beyond(field, at.cells)),
            scaled(lanes_of(1) / hn::Max(slope, least), gradient), hn::And(at.inside, hn::Ge(slope, least))};
  }

  HWY_INLINE void add_spring(std::size_t at, hn::Mask<D> acts, V k, Point normal, V stretch) {
    if (hn::AllFalse(D(), acts)) return;
    k = hn::IfThenElseZero(acts, k);
    NodeSystem node{load(w_.stiffness, at), load(w_.gradient, at)};
    node.add_spring(k, normal, stretch);
    store(node.stiffness, w_.stiffness, at);
    store(node.gradient, w_.gradient, at);
  }

  /// A middle cannot be near before its node is: both travel, and the segment may grow as fast.
  HWY_INLINE void defer_middle(LaneWorkspace::Bone& bone, const strings::StringLanes::Bone& kept, std::size_t at,
                               V travelled, Point segment) const {
    const V half = lanes_of(0.5f);
    const V least = load(bone.asked_from, at) + load(kept.acts_within, at) - travelled -
                    half * hn::Sqrt(dot<Math>(segment, segment)) - load(kept.kept_middle, at);
    store(hn::Max(load(bone.asked_from_middle, at), travelled + half * least), bone.asked_from_middle, at);
  }

  /// Nodes and middles of segments keep to a bone the gap at rest, or less; supports let them slide over it.
  void keep_from_bone(std::size_t b, std::size_t s) {
    LaneWorkspace::Bone& bone = w_.bones[b];
    const strings::StringLanes::Bone& kept = lanes_.bones[b];
    const V travelled = load(w_.travelled, s);
    if (hn::AllTrue(D(), hn::Gt(load(bone.clear_until, s), travelled))) return;
    const V stiffness = lanes_of(static_cast<float>(settings_.bone_stiffness)) * load(lanes_.tension, s);
    const V support = load(lanes_.node_length, s) *
                      lanes_of(static_cast<float>(1 / (settings_.support_length * settings_.support_length)));
    V clear = hn::Inf(D());
    /// Looks if anything may be near, and says from when on to look again.
    const auto ask = [&](Point place, V far, std::vector<float>& from, std::size_t at, Seen& seen) HWY_ATTR {
      V next = load(from, at);
      const auto asked = hn::Le(next, travelled);
      const bool any = !hn::AllFalse(D(), asked);
      if (any) {
        seen = look(b, place);
        next = hn::IfThenElse(asked, travelled + seen.distance - far, next);
        store(next, from, at);
      }
      clear = hn::Min(clear, next);
      return any;
    };
    Seen seen;
    for (std::size_t i = 1; i < inner_; ++i) {
      const std::size_t at = i * width_ + s;
      const Point here = load(w_.place, at);
      if (ask(here, load(kept.acts_within, at), bone.asked_from, at, seen)) {
        const V depth = seen.distance - load(kept.kept, at);
        const auto pressed = hn::And(seen.has_direction, hn::Lt(depth, hn::Zero(D())));
        add_spring(at, pressed, stiffness, seen.outward, depth);
        const V nearer = seen.distance - load(kept.slide_distance, at);
        const auto slides = hn::And(seen.has_direction, hn::Lt(nearer, hn::Zero(D())));
        add_spring(at, slides, load(kept.slide_share, at) * support, across(load(w_.direction, at), seen.outward),
                   nearer);
      }
      if (i + 1 == inner_) continue;
      const Point next_place = load(w_.place, at + width_);
      defer_middle(bone, kept, at, travelled, here - next_place);
      const Point middle = scaled(lanes_of(0.5f), here + next_place);
      if (!ask(middle, load(kept.kept_middle, at), bone.asked_from_middle, at, seen)) continue;
      const V depth = seen.distance - load(kept.kept_middle, at);
      const auto pressed = hn::And(seen.has_direction, hn::Lt(depth, hn::Zero(D())));
      // The middle of a segment is shared by its two nodes.
      const V half = lanes_of(0.5f) * stiffness;
      add_spring(at, pressed, half, seen.outward, depth);
      add_spring(at + width_, pressed, half, seen.outward, depth);
    }
    store(clear, bone.clear_until, s);
  }

  /// By block elimination (Thomas), as StringSystem.
  void solve(std::size_t s) {
    constexpr float held_stiffness = 1e4f;
    const V tension = load(lanes_.tension, s), tension2 = tension * tension, zero = hn::Zero(D());
    SymmetricLanes before = diagonal(zero);
    Point solution{zero, zero, zero};
    for (std::size_t i = 1; i < inner_; ++i) {
      const std::size_t at = i * width_ + s;
      const auto is_free = hn::Gt(load(lanes_.free, at), zero);
      SymmetricLanes own = load(w_.stiffness, at);
      Point force = load(w_.gradient, at);
      const V held = lanes_of(held_stiffness) * tension;
      const auto free_or = [&](V x, V otherwise) HWY_ATTR { return hn::IfThenElse(is_free, x, otherwise); };
      own = {free_or(own.xx, held), free_or(own.xy, zero), free_or(own.xz, zero),
             free_or(own.yy, held), free_or(own.yz, zero), free_or(own.zz, held)};
      force = {free_or(force.x, zero), free_or(force.y, zero), free_or(force.z, zero)};
      solution = scaled(tension, times(before, solution)) - force;
      before = inverse(minus_scaled(own, tension2, before));
      store(before, w_.inverse, at);
      store(solution, w_.solution, at);
    }
    Point after{zero, zero, zero};
    for (std::size_t i = inner_ - 1; i > 0; --i) {
      const std::size_t at = i * width_ + s;
      after = times(load(w_.inverse, at), load(w_.solution, at) + scaled(tension, after));
      store(sections_shifted_ ? after + section_shift(lanes_, w_, i, s) : after, w_.solution, at);
    }
  }

  /// What a string takes back of its last move, so that steps which slowly die out are taken at once (Anderson 1965, of
  /// depth one).
  HWY_INLINE V taken_back(std::size_t s) const {
    constexpr float least = -4, most = 0.5f;  // steps that grow or turn around tell little
    V with_change = hn::Zero(D()), change2 = lanes_of(1e-20f);
    for (std::size_t i = 1; i < inner_; ++i) {
      const std::size_t at = i * width_ + s;
      const Point step = load(w_.solution, at), change = step - load(w_.last_solution, at);
      with_change = with_change + dot<Math>(step, change);
      change2 = change2 + dot<Math>(change, change);
    }
    return hn::Min(hn::Max(with_change / change2, lanes_of(least)), lanes_of(most));
  }

  /// Moves those strings that do not rest by a share of the solution.
  void move(std::size_t s, V stop, float taken, int iteration) {
    const V zero = hn::Zero(D()), longest = lanes_of(static_cast<float>(settings_.longest_move));
    const V last = load(w_.last_move, s);
    const auto moves = sections_shifted_ ? hn::Ge(last, hn::Zero(D())) : hn::Ge(last, stop);
    V farthest2 = zero;
    for (std::size_t i = 1; i < inner_; ++i) {
      const Point step = load(w_.solution, i * width_ + s);
      farthest2 = hn::Max(farthest2, dot<Math>(step, step));
    }
    const V farthest = hn::Sqrt(farthest2);
    store(hn::IfThenElse(moves, farthest, last), w_.last_move, s);
    const auto goes = hn::And(moves, hn::Ge(farthest, lanes_of(strings::least_lane_move)));
    const bool remembers = settings_.sections_first && taken == 1, takes_back = remembers && iteration > 0;
    const V back = takes_back ? taken_back(s) : zero;
    V travelled2 = zero;
    for (std::size_t i = 1; i < inner_; ++i) {
      const std::size_t at = i * width_ + s;
      const Point solution = load(w_.solution, at);
      Point step = solution;
      if (takes_back) step = step - scaled(back, load(w_.last_step, at) + solution - load(w_.last_solution, at));
      const V length = hn::Sqrt(hn::Max(dot<Math>(step, step), lanes_of(1e-20f)));
      const V share = hn::IfThenElseZero(goes, lanes_of(taken) * hn::Min(lanes_of(1), longest / length));
      step = scaled(share, step);
      travelled2 = hn::Max(travelled2, dot<Math>(step, step));
      const Point moved = load(w_.moved, at) + step;
      if (remembers) store(solution, w_.last_solution, at), store(step, w_.last_step, at);
      store(moved, w_.moved, at);
      store(load(w_.begun, at) + moved, w_.place, at);
    }
    store(load(w_.travelled, s) + hn::Sqrt(travelled2), w_.travelled, s);
  }

  const strings::StringLanes& lanes_;
  const strings::StringSettings& settings_;
  const strings::BoneDistances& bones_;
  LaneWorkspace& w_;
  std::size_t width_, inner_;      ///< inner_: the last node's number, which does not move
  bool sections_move_;             ///< further than strings that rest may
  bool sections_shifted_ = false;  ///< in this iteration
};

}  // namespace gracilis::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
