// What acts on a muscle's strings in one pose, before they move: lanes of LaneWorkspace. Included once per instruction
// set.

#if defined(GRACILIS_LANE_POSE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRACILIS_LANE_POSE_INL
#undef GRACILIS_LANE_POSE_INL
#else
#define GRACILIS_LANE_POSE_INL
#endif

#include <gracilis/strings/lane_forces-inl.hpp>
#include <gracilis/strings/lane_relaxation.hpp>

HWY_BEFORE_NAMESPACE();
namespace gracilis::HWY_NAMESPACE {

/// Fills the workspace of one muscle for one pose.
class LanePose {
 public:
  LanePose(const strings::MuscleStrings& muscle, const strings::BoneDistances& bones,
           const std::vector<RigidTransform>& bodies, LaneWorkspace& workspace)
      : lanes_(muscle.lanes),
        bones_(bones),
        bodies_(bodies),
        w_(workspace),
        width_(static_cast<std::size_t>(lanes_.width)),
        inner_(static_cast<std::size_t>(lanes_.nodes - 1)) {}

  /// `places`: where the bodies carried the nodes.
  void begin(const strings::LanePlaces& places) {
    w_.center.setZero();
    for (std::size_t axis = 0; axis < 3; ++axis)
      w_.center[static_cast<Index>(axis)] = (places[axis].front() + places[axis].back()) / 2;
    place_nodes(places);
    place_ties();
    place_bones();
    if (!lanes_.neighbor_weight.empty()) begin_sections();
    w_.last_move.assign(width_, std::numeric_limits<float>::infinity());
    w_.travelled.assign(width_, 0);
  }

 private:
  void place_nodes(const strings::LanePlaces& places) {
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
      for (LanePoints* each : {&w_.gradient, &w_.direction, &w_.solution, &w_.last_solution, &w_.last_step})
        (*each)[axis].resize(count);
    }
    for (std::vector<float>& each : w_.stiffness) each.resize(count);
    for (std::vector<float>& each : w_.inverse) each.resize(count);
  }

  void place_ties() {
    std::vector<Affine> here;
    for (const Index body : lanes_.bodies) {
      const RigidTransform& pose = bodies_[static_cast<std::size_t>(body)];
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

  void place_bones() {
    w_.bones.resize(bones_.fields.size());
    for (std::size_t b = 0; b < w_.bones.size(); ++b) {
      const FieldGrid& grid = bones_.fields[b].grid;
      const RigidTransform& body = bodies_[static_cast<std::size_t>(bones_.bodies[b])];
      const Vec3 scale = grid.cells_per_metre.cast<Real>();
      LaneWorkspace::Bone& bone = w_.bones[b];
      const RigidTransform to_bone = body.inverse();
      bone.to_cells.leftCols<3>() = (scale.asDiagonal() * to_bone.linear()).cast<float>();
      bone.to_cells.col(3) = scale.cwiseProduct(to_bone * w_.center - grid.origin.cast<Real>()).cast<float>();
      bone.from_cells.setZero();
      bone.from_cells.leftCols<3>() = (body.linear() * scale.asDiagonal()).cast<float>();
      find_far_nodes(b);
    }
  }

  /// Beyond its grid a bone is as far away as the grid.
  void find_far_nodes(std::size_t b) {
    LaneWorkspace::Bone& bone = w_.bones[b];
    const strings::StringLanes::Bone& kept = lanes_.bones[b];
    bone.asked_from.resize(w_.begun[0].size()), bone.asked_from_middle.resize(w_.begun[0].size());
    bone.clear_until.resize(width_);
    const auto bound = [&](Point place)
                           HWY_ATTR { return distance_beyond(bones_.fields[b], apply(bone.to_cells, place)); };
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
        store(until(here, load(kept.acts_within, at)), bone.asked_from, at);
        if (i + 1 == inner_) continue;
        const Point middle = scaled(lanes_of(0.5f), here + load(w_.begun, at + width_));
        store(until(middle, load(kept.kept_middle, at)), bone.asked_from_middle, at);
      }
      store(clear, bone.clear_until, s);
    }
  }

  void begin_sections() {
    const std::size_t count = (inner_ + group_width) / group_width * group_width;
    for (std::vector<float>& each : w_.correlation) each.assign(count, 0);
    for (std::vector<float>& each : w_.turn) each.assign(count, 0);
    std::vector<Eigen::Quaterniond> turns;
    for (const Index body : lanes_.bodies) {
      turns.emplace_back(bodies_[static_cast<std::size_t>(body)].linear());
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

  const strings::StringLanes& lanes_;
  const strings::BoneDistances& bones_;
  const std::vector<RigidTransform>& bodies_;
  LaneWorkspace& w_;
  std::size_t width_, inner_;  ///< inner_: the last node's number, which does not move
};

}  // namespace gracilis::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
