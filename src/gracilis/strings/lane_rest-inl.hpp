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

/// Takes strings from where `follow` left them to rest: some steps of Gauss-Newton, then Newton's, each string held
/// where its own system is not stable and damped where it turns around.
class LaneRest {
 public:
  /// All must outlive this.
  LaneRest(const strings::MuscleStrings& muscle, const strings::BoneDistances& bones, LaneWorkspace& workspace,
           RateWorkspace& rates, LaneEquilibrium& equilibrium)
      : lanes_(muscle.lanes),
        steps_(muscle, bones, workspace),
        w_(workspace),
        r_(rates),
        equilibrium_(equilibrium),
        width_(static_cast<std::size_t>(lanes_.width)),
        strings_(static_cast<std::size_t>(lanes_.strings)) {}

  /// Leaves the equilibrium differentiated there. Returns how far each string's farthest node had to go last, m.
  std::vector<float> find() {
    constexpr strings::Relaxation first{16, 3e-5};
    constexpr int most_steps = 16;
    std::fill(w_.last_move.begin(), w_.last_move.end(), std::numeric_limits<float>::infinity());
    steps_.relax(first);
    Step last;
    std::vector<float> share(width_, 1);
    for (int step = 0;; ++step) {
      equilibrium_.differentiate();
      const bool any_held = hold_unstable();
      const float tolerance = step > 0 && last.longest() < short_step ? last_tolerance : first_tolerance;
      Step now{equilibrium_.moves(r_.force, tolerance), {}};
      now.farthest = farthest_of(now.moves);
      const bool rests = now.longest() < static_cast<float>(strings::unsettled_move);
      if (rests || step == most_steps) {
        if (rests) take_back(now, std::vector<float>(width_, 1));
        if (any_held) equilibrium_.leave_out(std::vector<char>(strings_, 0));
        now.farthest.resize(strings_);
        return now.farthest;
      }
      if (step > 0) choose_shares(now, last, share);
      take_back(now, share);
      last = std::move(now);
    }
  }

 private:
  /// Of its first guess a step leaves the first of these to the next; the second where the last was this short, m: all
  /// strings may move easily together, so that little force that is left may be a long way.
  static constexpr float first_tolerance = 0.1f, last_tolerance = 1e-3f, short_step = 2e-4f;
  /// A longer step may lead to another equilibrium than that which is near, m.
  static constexpr float longest_step = 1e-3f;

  struct Step {
    Numbers moves;
    std::vector<float> farthest;  ///< of each string's nodes, m

    float longest() const { return *std::max_element(farthest.begin(), farthest.end()); }
  };

  /// Towards a maximum a step would go with the forces: strings whose own systems are not positive are held where they
  /// are until these are (Levenberg-Marquardt). Returns whether any is.
  bool hold_unstable() {
    constexpr int most_tries = 8;
    bool any_held = false;
    for (int tries = 0; tries < most_tries; ++tries) {
      bool more = false;
      for (std::size_t s = 0; s < strings_; ++s)
        if (!r_.stable[s]) more = true, r_.held[s] = std::max(4 * r_.held[s], lanes_.tension[s] / 2);
      if (!more) break;
      any_held = true;
      equilibrium_.eliminate();
    }
    return any_held;
  }

  /// A string that turned around goes to where, between its last two places, it would rest; one that leaves a place
  /// where it cannot stay goes further each time.
  void choose_shares(const Step& now, const Step& last, std::vector<float>& share) const {
    constexpr float least = 0.125f, most = 1, most_held = 8;
    std::vector<float> along(width_, 0);
    for (std::size_t at = 0; 3 * at < now.moves.size(); at += hn::Lanes(D())) {
      const V product = dot<Math>(load_point(&now.moves[3 * at]), load_point(&last.moves[3 * at]));
      store(load(along, at % width_) + product, along, at % width_);
    }
    for (std::size_t s = 0; s < strings_; ++s) {
      const float before = last.farthest[s], next = now.farthest[s];
      if (along[s] < 0 && next > before / 4)
        share[s] = std::max(share[s] * before / (before + next), least);
      else
        share[s] = std::min(2 * share[s], r_.held[s] > 0 ? most_held : most);
    }
  }

  std::vector<float> farthest_of(const Numbers& moves) const {
    std::vector<float> farthest(width_, 0);
    for (std::size_t at = 0; 3 * at < moves.size(); at += hn::Lanes(D())) {
      const Point move = load_point(&moves[3 * at]);
      store(hn::Max(load(farthest, at % width_), hn::Sqrt(dot<Math>(move, move))), farthest, at % width_);
    }
    return farthest;
  }

  void take_back(const Step& step, std::vector<float> share) {
    for (std::size_t s = 0; s < width_; ++s) {
      share[s] = std::min(share[s], longest_step / std::max(step.farthest[s], 1e-12f));
      w_.travelled[s] += share[s] * step.farthest[s];
    }
    for (std::size_t at = 0; 3 * at < step.moves.size(); at += hn::Lanes(D())) {
      const Point moved = load(w_.moved, at) - scaled(load(share, at % width_), load_point(&step.moves[3 * at]));
      store(moved, w_.moved, at);
      store(load(w_.begun, at) + moved, w_.place, at);
    }
  }

  const strings::StringLanes& lanes_;
  LaneSteps steps_;
  LaneWorkspace& w_;
  RateWorkspace& r_;
  LaneEquilibrium& equilibrium_;
  std::size_t width_, strings_;
};

}  // namespace gracilis::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
