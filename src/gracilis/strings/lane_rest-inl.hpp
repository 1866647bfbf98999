// Brings a muscle's strings to rest in one pose. Included once per instruction set.

#if defined(GRACILIS_LANE_REST_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRACILIS_LANE_REST_INL
#undef GRACILIS_LANE_REST_INL
#else
#define GRACILIS_LANE_REST_INL
#endif

#include <gracilis/strings/lane_equilibrium-inl.hpp>
#include <gracilis/strings/lane_step-inl.hpp>

#include <algorithm>

HWY_BEFORE_NAMESPACE();
namespace gracilis::HWY_NAMESPACE {

/// Takes strings from where `follow` left them to rest: some steps of Gauss-Newton, then Newton's, where these are
/// short and get shorter; otherwise Gauss-Newton until they settle, as `settle_nearly`.
class LaneRest {
 public:
  /// All must outlive this.
  LaneRest(const strings::MuscleStrings& muscle, const strings::BoneDistances& bones, LaneWorkspace& workspace,
           const RateWorkspace& rates, LaneEquilibrium& equilibrium)
      : muscle_(muscle), bones_(bones), w_(workspace), r_(rates), equilibrium_(equilibrium) {}

  /// Leaves the equilibrium differentiated there. Returns how far a node of each string moved last, m.
  std::vector<float> find() {
    relax({24, 3e-5});
    if (const std::vector<float> farthest = step_to_rest(); !farthest.empty()) return farthest;
    relax(strings::settling_nearly);
    equilibrium_.differentiate();
    return {w_.last_move.begin(), w_.last_move.begin() + muscle_.strings};
  }

 private:
  /// Of its first guess a step leaves this to the next.
  static constexpr float step_tolerance = 0.1f;
  /// A longer step may lead to another equilibrium than that which is near, m.
  static constexpr float longest_step = 1e-3f;

  /// How far nodes moved last; nothing, and no node has moved, where the steps do not end.
  std::vector<float> step_to_rest() {
    const LanePoints moved = w_.moved, place = w_.place;
    float last = longest_step;
    for (;;) {
      equilibrium_.differentiate();
      const Numbers moves = equilibrium_.moves(r_.force, step_tolerance);
      const std::vector<float> farthest = farthest_of(moves);
      const float now = *std::max_element(farthest.begin(), farthest.end());
      const bool rests = now < static_cast<float>(strings::unsettled_move);
      // Towards a maximum it would go with the forces.
      if (!(now < last) || !(rests || product(r_.force, moves) > 0)) {
        w_.moved = moved, w_.place = place;
        return {};
      }
      take_back(moves, farthest);
      if (rests) return farthest;
      last = now / 2;
    }
  }

  void relax(const strings::Relaxation& relaxation) {
    std::fill(w_.last_move.begin(), w_.last_move.end(), std::numeric_limits<float>::infinity());
    LaneSteps(muscle_, bones_, w_).relax(relaxation);
  }

  std::vector<float> farthest_of(const Numbers& moves) const {
    const std::size_t width = w_.travelled.size();
    std::vector<float> farthest(width, 0);
    for (std::size_t at = 0; 3 * at < moves.size(); at += hn::Lanes(D())) {
      const Point move = load_point(&moves[3 * at]);
      store(hn::Max(load(farthest, at % width), hn::Sqrt(dot<Math>(move, move))), farthest, at % width);
    }
    farthest.resize(static_cast<std::size_t>(muscle_.strings));
    return farthest;
  }

  void take_back(const Numbers& moves, const std::vector<float>& farthest) {
    for (std::size_t at = 0; 3 * at < moves.size(); at += hn::Lanes(D())) {
      const Point moved = load(w_.moved, at) - load_point(&moves[3 * at]);
      store(moved, w_.moved, at);
      store(load(w_.begun, at) + moved, w_.place, at);
    }
    for (std::size_t s = 0; s < farthest.size(); ++s) w_.travelled[s] += farthest[s];
  }

  const strings::MuscleStrings& muscle_;
  const strings::BoneDistances& bones_;
  LaneWorkspace& w_;
  const RateWorkspace& r_;
  LaneEquilibrium& equilibrium_;
};

}  // namespace gracilis::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
