// Each string's own part of the derivative of its forces, eliminated; a string per lane. Included once per instruction
// set.

#if defined(GRACILIS_LANE_ELIMINATION_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRACILIS_LANE_ELIMINATION_INL
#undef GRACILIS_LANE_ELIMINATION_INL
#else
#define GRACILIS_LANE_ELIMINATION_INL
#endif

#include <gracilis/strings/lane_forces-inl.hpp>
#include <gracilis/strings/matrix_lanes-inl.hpp>
#include <gracilis/strings/rate_workspace.hpp>

HWY_BEFORE_NAMESPACE();
namespace gracilis::HWY_NAMESPACE {

/// The block tridiagonal systems of all strings, where all others stay, by block elimination (Thomas). 3 numbers per
/// node; those of nodes that are not free are zero in what is solved for.
class LaneElimination {
 public:
  LaneElimination(const strings::StringLanes& lanes, strings::RateWorkspace& rates)
      : strings_(static_cast<std::size_t>(lanes.strings)),
        r_(rates),
        width_(static_cast<std::size_t>(lanes.width)),
        inner_(static_cast<std::size_t>(lanes.nodes - 1)) {}

  void eliminate() {
    const std::size_t count = width_ * (inner_ + 1);
    r_.inverse.assign(9 * count, 0), r_.upper.assign(9 * count, 0);
    std::vector<float> least(width_, 1);
    for (std::size_t i = 1; i < inner_; ++i)
      for (std::size_t s = 0; s < width_; s += hn::Lanes(D())) {
        const std::size_t at = i * width_ + s;
        const V free = load(r_.free, at), zero = hn::Zero(D());
        const Matrix before = load_matrix(&r_.before[9 * at]);
        const Matrix here = plus_diagonal(load_matrix(&r_.here[9 * at]), load(r_.held, s));
        const Matrix pivot = here - times(before, load_matrix(&r_.upper[9 * (at - width_)]));
        V determinant;
        const Matrix inverse = HWY_NAMESPACE::inverse(pivot, determinant);
        const auto is_free = hn::Gt(free, zero);
        store(hn::Min(load(least, s), hn::IfThenElse(is_free, determinant, lanes_of(1))), least, s);
        store_matrix(only(is_free, inverse), &r_.inverse[9 * at]);
        const auto both = hn::And(is_free, hn::Gt(load(r_.free, at + width_), zero));
        store_matrix(only(both, times(inverse, load_matrix(&r_.after[9 * at]))), &r_.upper[9 * at]);
      }
    r_.stable.resize(strings_);
    for (std::size_t s = 0; s < strings_; ++s) r_.stable[s] = least[s] > 0;
  }

  /// From forces to the moves that change them so, in place.
  void solve(std::vector<float>& x) const {
    for (std::size_t i = 1; i < inner_; ++i)
      for_groups(i, [&](std::size_t at) HWY_ATTR {
        const Point last = load_point(&x[3 * (at - width_)]);
        const Point rest = load_point(&x[3 * at]) - times(load_matrix(&r_.before[9 * at]), last);
        store_point(times(load_matrix(&r_.inverse[9 * at]), rest), &x[3 * at]);
      });
    for (std::size_t i = inner_ - 1; i > 0; --i)
      for_groups(i, [&](std::size_t at) HWY_ATTR {
        const Point next = load_point(&x[3 * (at + width_)]);
        store_point(load_point(&x[3 * at]) - times(load_matrix(&r_.upper[9 * at]), next), &x[3 * at]);
      });
  }

  /// The transposed: from weights of moves to weights of forces, in place.
  void solve_transposed(std::vector<float>& x) const {
    for (std::size_t i = 1; i < inner_; ++i)
      for_groups(i, [&](std::size_t at) HWY_ATTR {
        const Point last = load_point(&x[3 * (at - width_)]);
        const Point rest = transposed_times(load_matrix(&r_.upper[9 * (at - width_)]), last);
        store_point(load_point(&x[3 * at]) - rest, &x[3 * at]);
      });
    for (std::size_t i = inner_ - 1; i > 0; --i)
      for_groups(i, [&](std::size_t at) HWY_ATTR {
        Point rest = load_point(&x[3 * at]);
        if (i + 1 < inner_)
          rest = rest - transposed_times(load_matrix(&r_.before[9 * (at + width_)]), load_point(&x[3 * (at + width_)]));
        store_point(transposed_times(load_matrix(&r_.inverse[9 * at]), rest), &x[3 * at]);
      });
  }

  /// The systems themselves: what moving nodes does to the forces on their own strings.
  void multiply(const std::vector<float>& moves, std::vector<float>& forces) const {
    for (std::size_t i = 1; i < inner_; ++i)
      for_groups(i, [&](std::size_t at) HWY_ATTR {
        const Point sum = times(load_matrix(&r_.before[9 * at]), load_point(&moves[3 * (at - width_)])) +
                          times(load_matrix(&r_.here[9 * at]), load_point(&moves[3 * at])) +
                          times(load_matrix(&r_.after[9 * at]), load_point(&moves[3 * (at + width_)]));
        store_point(scaled(load(r_.free, at), sum), &forces[3 * at]);
      });
  }

  /// The transposed, added: from weights of free nodes to weights of all nodes.
  void add_transposed(const std::vector<float>& weights, std::vector<float>& of_moves) const {
    for (std::size_t i = 1; i < inner_; ++i)
      for_groups(i, [&](std::size_t at) HWY_ATTR {
        const Point weight = scaled(load(r_.free, at), load_point(&weights[3 * at]));
        const auto add = [&](const std::vector<float>& block, std::size_t to) HWY_ATTR {
          store_point(load_point(&of_moves[3 * to]) + transposed_times(load_matrix(&block[9 * at]), weight),
                      &of_moves[3 * to]);
        };
        add(r_.before, at - width_), add(r_.here, at), add(r_.after, at + width_);
      });
  }

 private:
  static HWY_INLINE Matrix only(hn::Mask<D> mask, Matrix a) {
    const auto point = [&](Point p) HWY_ATTR {
      return Point{hn::IfThenElseZero(mask, p.x), hn::IfThenElseZero(mask, p.y), hn::IfThenElseZero(mask, p.z)};
    };
    return {point(a.x), point(a.y), point(a.z)};
  }

  /// Groups side by side, since each waits for its last node.
  template <class Act>
  HWY_INLINE void for_groups(std::size_t i, const Act& act) const {
    for (std::size_t s = 0; s < width_; s += hn::Lanes(D())) act(i * width_ + s);
  }

  std::size_t strings_;
  strings::RateWorkspace& r_;
  std::size_t width_, inner_;  ///< inner_: the last node's number
};

}  // namespace gracilis::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
