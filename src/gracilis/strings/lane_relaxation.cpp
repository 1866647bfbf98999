#include <gracilis/strings/lane_relaxation.hpp>

#include <gracilis/dynamics/simd/group_width.hpp>
#include <gracilis/strings/relaxation.hpp>

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "gracilis/strings/lane_relaxation.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, as Highway asks.
#include <gracilis/strings/lane_forces-inl.hpp>
#include <gracilis/strings/section_lanes-inl.hpp>

HWY_BEFORE_NAMESPACE();
namespace gracilis::HWY_NAMESPACE {

using strings::BoneDistances;
using strings::LanePlaces;
using strings::MuscleStrings;
using strings::Relaxation;
using strings::StringLanes;
using strings::StringSettings;

using Doubles = hn::CappedTag<double, group_width / 2>;
using Affine3d = Eigen::Matrix<Real, 3, 4>;

void carry_lanes(const StringLanes& lanes, const std::vector<RigidTransform>& before,
                 const std::vector<RigidTransform>& now, LanePlaces& places) {
  const Doubles d;
  const hn::Rebind<float, Doubles> floats;
  using N = hn::Vec<Doubles>;
  std::vector<Affine3d> motions;
  for (const Index body : lanes.bodies) {
    const auto b = static_cast<std::size_t>(body);
    motions.emplace_back((now[b] * before[b].inverse()).affine());
  }
  for (std::size_t at = 0; at < places[0].size(); at += hn::Lanes(d)) {
    const N x = hn::LoadU(d, &places[0][at]), y = hn::LoadU(d, &places[1][at]), z = hn::LoadU(d, &places[2][at]);
    N sum[3] = {hn::Zero(d), hn::Zero(d), hn::Zero(d)}, shares = hn::Zero(d);
    for (std::size_t b = 0; b < motions.size(); ++b) {
      const N share = hn::PromoteTo(d, hn::LoadU(floats, &lanes.shares[b][at]));
      shares = shares + share;
      for (Index row = 0; row < 3; ++row) {
        const auto number = [&](Index column) HWY_ATTR { return hn::Set(d, motions[b](row, column)); };
        const N moved = hn::MulAdd(number(0), x, hn::MulAdd(number(1), y, hn::MulAdd(number(2), z, number(3))));
        sum[row] = hn::MulAdd(share, moved, sum[row]);
      }
    }
    for (std::size_t axis = 0; axis < 3; ++axis) hn::StoreU(sum[axis] / shares, d, &places[axis][at]);
  }
}

/// Relaxes the strings of one muscle in one pose.
class LaneRelaxation {
 public:
  LaneRelaxation(const MuscleStrings& muscle, const BoneDistances& bones, LaneWorkspace& workspace)
      : muscle_(muscle),
        lanes_(muscle.lanes),
        bones_(bones),
        w_(workspace),
        width_(static_cast<std::size_t>(lanes_.width)),
        inner_(static_cast<std::size_t>(lanes_.nodes - 1)) {}

  void begin(const std::vector<RigidTransform>& bodies, const LanePlaces& places) {
    w_.center.setZero();
    for (std::size_t axis = 0; axis < 3; ++axis)
      w_.center[static_cast<Index>(axis)] = (places[axis].front() + places[axis].back()) / 2;
    place_nodes(places);
    place_ties(bodies);
    place_bones(bodies);
    if (has_neighbors()) begin_sections(bodies);
    w_.last_move.assign(width_, std::numeric_limits<float>::infinity());
    w_.travelled.assign(width_, 0);
  }

  void relax(const Relaxation& relaxation) {
    const V stop = lanes_of(std::max(static_cast<float>(relaxation.stop_move), strings::least_lane_move));
    for (int iteration = 0; iteration < relaxation.iterations; ++iteration) {
      if (has_neighbors()) look_at_sections(iteration);
      const auto taken = static_cast<float>(strings::taken_share(relaxation, iteration));
      bool any_moves = false;
      for (std::size_t s = 0; s < width_; s += hn::Lanes(D())) {
        if (hn::AllTrue(D(), hn::Lt(load(w_.last_move, s), stop))) continue;
        assemble(s);
        for (std::size_t b = 0; b < w_.bones.size(); ++b) keep_from_bone(b, s);
        solve(s);
        move(s, stop, taken);
        any_moves |= !hn::AllTrue(D(), hn::Lt(load(w_.last_move, s), stop));
      }
      if (!any_moves) return;
    }
  }

  void end(LanePlaces& places) const {
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (std::size_t at = 0; at < places[axis].size(); ++at)
        places[axis][at] += static_cast<double>(w_.moved[axis][at]);
  }

 private:
  bool has_neighbors() const { return !lanes_.neighbor_weight.empty(); }
  const StringSettings& settings() const { return muscle_.settings; }

  void place_nodes(const LanePlaces& places) {
    const std::size_t count = width_ * (inner_ + 1);
    const auto stride = static_cast<std::ptrdiff_t>(width_);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::vector<double>& p = places[axis];
      const double center = w_.center[static_cast<Index>(axis)];
      std::vector<float>&begun = w_.begun[axis], &bend = w_.bend[axis];
      begun.resize(count), bend.resize(count);
      w_.moved[axis].assign(count, 0);
      for (std::size_t at = 0; at < count; ++at) begun[at] = static_cast<float>(p[at] - center);
      const double* here = p.data();
      for (std::size_t at = width_; at < count - width_; ++at)
        bend[at] = static_cast<float>(2 * here[at] - here[static_cast<std::ptrdiff_t>(at) - stride] -
                                      here[static_cast<std::ptrdiff_t>(at) + stride]);
      w_.place[axis] = begun;
      for (LanePoints* each : {&w_.gradient, &w_.direction, &w_.solution}) (*each)[axis].resize(count);
    }
    for (std::vector<float>& each : w_.stiffness) each.resize(count);
    for (std::vector<float>& each : w_.inverse) each.resize(count);
  }

  void place_ties(const std::vector<RigidTransform>& bodies) {
    std::vector<Affine> here;
    for (const Index body : lanes_.bodies) {
      const RigidTransform& pose = bodies[static_cast<std::size_t>(body)];
      Affine& each = here.emplace_back();
      each.leftCols<3>() = pose.linear().cast<float>();
      each.col(3) = (pose * lanes_.center - w_.center).cast<float>();
    }
    for (LanePoints* each : {&w_.tied_to, &w_.support, &w_.normal})
      for (std::vector<float>& axis : *each) axis.resize(w_.begun[0].size());
    const V zero = hn::Zero(D());
    for (std::size_t at = width_; at < inner_ * width_; at += hn::Lanes(D())) {
      const Point taut = load(lanes_.taut, at), fiber = load(lanes_.fiber, at), normal = load(lanes_.normal, at);
      Point tied{zero, zero, zero}, support = tied, posed_normal = tied;
      for (std::size_t b = 0; b < here.size(); ++b) {
        const V share = load(lanes_.shares[b], at);
        tied = tied + scaled(share, apply(here[b], taut));
        support = support + scaled(share, apply(here[b], fiber));
        posed_normal = posed_normal + scaled(share, turn(here[b], normal));
      }
      store(tied, w_.tied_to, at), store(support, w_.support, at), store(unit(posed_normal), w_.normal, at);
    }
  }

  void place_bones(const std::vector<RigidTransform>& bodies) {
    w_.bones.resize(bones_.fields.size());
    for (std::size_t b = 0; b < w_.bones.size(); ++b) {
      const FieldGrid& grid = bones_.fields[b].grid;
      const RigidTransform& body = bodies[static_cast<std::size_t>(bones_.bodies[b])];
      const Vec3 scale = grid.cells_per_metre.cast<Real>();
      LaneWorkspace::Bone& bone = w_.bones[b];
      const RigidTransform to_bone = body.inverse();
      bone.to_cells.leftCols<3>() = (scale.asDiagonal() * to_bone.linear()).cast<float>();
      bone.to_cells.col(3) =
          scale.cwiseProduct(to_bone * w_.center - grid.origin.cast<Real>()).cast<float>();
      bone.from_cells.setZero();
      bone.from_cells.leftCols<3>() = (body.linear() * scale.asDiagonal()).cast<float>();
      find_far_nodes(b);
    }
  }

  /// Beyond its grid a bone is as far away as the grid.
  void find_far_nodes(std::size_t b) {
    LaneWorkspace::Bone& bone = w_.bones[b];
    const StringLanes::Bone& kept = lanes_.bones[b];
    bone.asked_from.resize(w_.begun[0].size()), bone.asked_from_middle.resize(w_.begun[0].size());
    bone.clear_until.resize(width_);
    const auto bound = [&](Point place) HWY_ATTR {
      return distance_beyond(bones_.fields[b], apply(bone.to_cells, place));
    };
    const V border = lanes_of(bones_.fields[b].border), zero = hn::Zero(D());
    for (std::size_t s = 0; s < width_; s += hn::Lanes(D())) {
      V clear = hn::Inf(D());
      for (std::size_t i = 1; i < inner_; ++i) {
        const std::size_t at = i * width_ + s;
        const Point here = load(w_.begun, at);
        const auto until = [&](Point place, V far) HWY_ATTR {
          const V least = bound(place);
          const V travel = hn::IfThenElse(hn::Gt(least, border), least - far, zero);
          clear = hn::Min(clear, travel);
          return travel;
        };
        store(until(here, farthest_asked(kept, at)), bone.asked_from, at);
        if (i + 1 == inner_) continue;
        const Point middle = scaled(lanes_of(0.5f), here + load(w_.begun, at + width_));
        store(until(middle, load(kept.kept_middle, at)), bone.asked_from_middle, at);
      }
      store(clear, bone.clear_until, s);
    }
  }

  /// Up to which distance a bone acts on a node.
  HWY_INLINE V farthest_asked(const StringLanes::Bone& kept, std::size_t at) const {
    const V slides = load(kept.slide_share, at);
    const V slide = hn::IfThenElse(hn::Gt(slides, hn::Zero(D())), load(kept.slide_distance, at), lanes_of(-1));
    return hn::Max(load(kept.kept, at), slide);
  }

  void begin_sections(const std::vector<RigidTransform>& bodies) {
    const std::size_t count = (inner_ + group_width) / group_width * group_width;
    for (std::vector<float>& each : w_.correlation) each.assign(count, 0);
    for (std::vector<float>& each : w_.turn) each.assign(count, 0);
    std::vector<Eigen::Quaterniond> turns;
    for (const Index body : lanes_.bodies) {
      turns.emplace_back(bodies[static_cast<std::size_t>(body)].linear());
      if (turns.back().dot(turns.front()) < 0) turns.back().coeffs() *= -1;
    }
    for (std::size_t i = 0; i < count; ++i) {
      Eigen::Vector4d blended = Eigen::Vector4d::Zero();
      for (std::size_t b = 0; b < turns.size(); ++b)
        blended += lanes_.section_shares[b][std::min(i, inner_)] * turns[b].coeffs();
      const Eigen::Matrix3f turn = Eigen::Quaterniond(blended).normalized().toRotationMatrix().cast<float>();
      for (Index k = 0; k < 9; ++k) w_.turn[static_cast<std::size_t>(k)][i] = turn(k / 3, k % 3);
    }
  }

  void look_at_sections(int iteration) {
    constexpr int first_steps = 6, further_steps = 2;
    w_.before = w_.place;
    correlate_sections(lanes_, w_);
    turn_sections(iteration == 0 ? first_steps : further_steps, w_);
  }

  /// Where its neighbors want a node.
  HWY_INLINE Point among_neighbors(std::size_t i, std::size_t s) const {
    const V zero = hn::Zero(D());
    const std::size_t row = i * width_;
    Point there{zero, zero, zero};
    for (std::size_t j = 0; j < static_cast<std::size_t>(lanes_.strings); ++j) {
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
    const auto per_length = [](Real of_settings) { return lanes_of(static_cast<float>(1 / (of_settings * of_settings))); };
    const V tie = length * per_length(settings().tie_length), support = length * per_length(settings().support_length),
            neighbor = length * per_length(settings().neighbor_length);
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
    if (hn::AllFalse(D(), at.inside))
      return {distance_beyond(field, at.cells), place, at.inside};
    const SplineSample sampled = sample_spline_lanes(field.grid, at);
    const Point gradient = turn(w_.bones[b].from_cells, sampled.gradient);
    const V slope = hn::Sqrt(dot<Math>(gradient, gradient)), least = lanes_of(static_cast<float>(strings::least_slope));
    return {hn::IfThenElse(at.inside, sampled.distance, distance_beyond(field, at.cells)),
            scaled(lanes_of(1) / hn::Max(slope, least), gradient), hn::And(at.inside, hn::Ge(slope, least))};
  }

  HWY_INLINE void add_spring(std::size_t at, V k, Point normal, V stretch) {
    NodeSystem node{load(w_.stiffness, at), load(w_.gradient, at)};
    node.add_spring(k, normal, stretch);
    store(node.stiffness, w_.stiffness, at);
    store(node.gradient, w_.gradient, at);
  }

  /// A middle cannot be near before its node is: both travel, and the segment may grow as fast.
  HWY_INLINE void defer_middle(LaneWorkspace::Bone& bone, const StringLanes::Bone& kept, std::size_t at, V travelled,
                               Point segment) const {
    const V half = lanes_of(0.5f);
    const V least = load(bone.asked_from, at) + farthest_asked(kept, at) - travelled -
                    half * hn::Sqrt(dot<Math>(segment, segment)) - load(kept.kept_middle, at);
    store(hn::Max(load(bone.asked_from_middle, at), travelled + half * least), bone.asked_from_middle, at);
  }

  /// Nodes and middles of segments keep to a bone the gap at rest, or less; supports let them slide over it.
  void keep_from_bone(std::size_t b, std::size_t s) {
    LaneWorkspace::Bone& bone = w_.bones[b];
    const StringLanes::Bone& kept = lanes_.bones[b];
    const V travelled = load(w_.travelled, s);
    if (hn::AllTrue(D(), hn::Gt(load(bone.clear_until, s), travelled))) return;
    const V stiffness = lanes_of(static_cast<float>(settings().bone_stiffness)) * load(lanes_.tension, s);
    const V support = load(lanes_.node_length, s) *
                      lanes_of(static_cast<float>(1 / (settings().support_length * settings().support_length)));
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
      if (ask(here, farthest_asked(kept, at), bone.asked_from, at, seen)) {
        const V depth = seen.distance - load(kept.kept, at);
        const auto pressed = hn::And(seen.has_direction, hn::Lt(depth, hn::Zero(D())));
        add_spring(at, hn::IfThenElseZero(pressed, stiffness), seen.outward, depth);
        const V nearer = seen.distance - load(kept.slide_distance, at);
        const auto slides = hn::And(seen.has_direction, hn::Lt(nearer, hn::Zero(D())));
        add_spring(at, hn::IfThenElseZero(slides, load(kept.slide_share, at) * support),
                   across(load(w_.direction, at), seen.outward), nearer);
      }
      if (i + 1 == inner_) continue;
      const Point next_place = load(w_.place, at + width_);
      defer_middle(bone, kept, at, travelled, here - next_place);
      const Point middle = scaled(lanes_of(0.5f), here + next_place);
      if (!ask(middle, load(kept.kept_middle, at), bone.asked_from_middle, at, seen)) continue;
      const V depth = seen.distance - load(kept.kept_middle, at);
      const auto pressed = hn::And(seen.has_direction, hn::Lt(depth, hn::Zero(D())));
      // The middle of a segment is shared by its two nodes.
      const V half = hn::IfThenElseZero(pressed, lanes_of(0.5f) * stiffness);
      add_spring(at, half, seen.outward, depth);
      add_spring(at + width_, half, seen.outward, depth);
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
      store(after, w_.solution, at);
    }
  }

  /// Moves those strings that do not rest by a share of the solution.
  void move(std::size_t s, V stop, float taken) {
    const V zero = hn::Zero(D()), longest = lanes_of(static_cast<float>(settings().longest_move));
    const V last = load(w_.last_move, s);
    const auto moves = hn::Ge(last, stop);
    V farthest2 = zero;
    for (std::size_t i = 1; i < inner_; ++i) {
      const Point step = load(w_.solution, i * width_ + s);
      farthest2 = hn::Max(farthest2, dot<Math>(step, step));
    }
    const V farthest = hn::Sqrt(farthest2);
    store(hn::IfThenElse(moves, farthest, last), w_.last_move, s);
    const auto goes = hn::And(moves, hn::Ge(farthest, lanes_of(strings::least_lane_move)));
    store(load(w_.travelled, s) + hn::IfThenElseZero(goes, hn::Min(farthest, longest)), w_.travelled, s);
    for (std::size_t i = 1; i < inner_; ++i) {
      const std::size_t at = i * width_ + s;
      const Point step = load(w_.solution, at);
      const V length = hn::Sqrt(hn::Max(dot<Math>(step, step), lanes_of(1e-20f)));
      const V share = hn::IfThenElseZero(goes, lanes_of(taken) * hn::Min(lanes_of(1), longest / length));
      const Point moved = load(w_.moved, at) + scaled(share, step);
      store(moved, w_.moved, at);
      store(load(w_.begun, at) + moved, w_.place, at);
    }
  }

  const MuscleStrings& muscle_;
  const StringLanes& lanes_;
  const BoneDistances& bones_;
  LaneWorkspace& w_;
  std::size_t width_, inner_;  ///< inner_: the last node's number, which does not move
};

void relax_lanes(const MuscleStrings& muscle, const BoneDistances& bones, const std::vector<RigidTransform>& bodies,
                 const Relaxation& relaxation, LaneWorkspace& workspace, LanePlaces& places) {
  LaneRelaxation strings(muscle, bones, workspace);
  strings.begin(bodies, places);
  strings.relax(relaxation);
  strings.end(places);
}

}  // namespace gracilis::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gracilis {

HWY_EXPORT(carry_lanes);
HWY_EXPORT(relax_lanes);

namespace strings {

LanePlaces lane_places(const StringLanes& lanes, const Points& places) {
  LanePlaces result;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    result[axis].resize(static_cast<std::size_t>(lanes.width * lanes.nodes));
    for (Index s = 0; s < lanes.width; ++s)
      for (Index i = 0; i < lanes.nodes; ++i)
        result[axis][static_cast<std::size_t>(i * lanes.width + s)] =
            places(static_cast<Index>(axis), std::min(s, lanes.strings - 1) * lanes.nodes + i);
  }
  return result;
}

Points places_of(const StringLanes& lanes, const LanePlaces& places) {
  Points result(3, lanes.strings * lanes.nodes);
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (Index s = 0; s < lanes.strings; ++s)
      for (Index i = 0; i < lanes.nodes; ++i)
        result(static_cast<Index>(axis), s * lanes.nodes + i) =
            places[axis][static_cast<std::size_t>(i * lanes.width + s)];
  return result;
}

void carry_lanes(const StringLanes& lanes, const std::vector<RigidTransform>& before,
                 const std::vector<RigidTransform>& now, LanePlaces& places) {
  HWY_DYNAMIC_DISPATCH(carry_lanes)(lanes, before, now, places);
}

std::vector<float> relax_lanes(const MuscleStrings& muscle, const BoneDistances& bones,
                               const std::vector<RigidTransform>& bodies, const Relaxation& relaxation,
                               LanePlaces& places) {
  // Kept between calls: to ask for its memory each time takes as long as an iteration.
  static thread_local LaneWorkspace workspace;
  HWY_DYNAMIC_DISPATCH(relax_lanes)(muscle, bones, bodies, relaxation, workspace, places);
  return {workspace.last_move.begin(), workspace.last_move.begin() + muscle.strings};
}

}  // namespace strings
}  // namespace gracilis
#endif
