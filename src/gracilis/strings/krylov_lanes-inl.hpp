// Linear systems by directions that are remembered. Included once per instruction set.

#if defined(GRACILIS_KRYLOV_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRACILIS_KRYLOV_LANES_INL
#undef GRACILIS_KRYLOV_LANES_INL
#else
#define GRACILIS_KRYLOV_LANES_INL
#endif

#include <gracilis/strings/lane_sum-inl.hpp>
#include <gracilis/strings/rate_workspace.hpp>
#include <gracilis/strings/symmetric_lanes-inl.hpp>

#include <algorithm>
#include <array>
#include <cmath>

HWY_BEFORE_NAMESPACE();
namespace gracilis::HWY_NAMESPACE {

using Numbers = std::vector<float>;
using strings::TriedDirection;

/// Some vectors at once, so that what they are combined with is read once.
inline constexpr std::size_t at_once = 4;
using Together = std::array<const float*, at_once>;

/// for_lane_parts of points that lie group by group, number by number (matrix_lanes-inl.hpp).
template <class Act>
HWY_INLINE void for_point_parts(std::size_t count, const Act& act) {
  for_lane_parts(count / 3, [&](std::size_t at, std::size_t part) HWY_ATTR {
    for (std::size_t k = 0; k < 3; ++k) act(3 * at + k * hn::Lanes(D()), part);
  });
}

HWY_INLINE void products(const Together& a, const Numbers& b, float* sums) {
  const float* of_b = b.data();
  LaneSums<at_once> found;
  for_point_parts(b.size(), [&](std::size_t at, std::size_t part) HWY_ATTR {
    const V x = hn::LoadU(D(), of_b + at);
    for (std::size_t k = 0; k < at_once; ++k) found(k, part) = hn::MulAdd(hn::LoadU(D(), a[k] + at), x, found(k, part));
  });
  for (std::size_t k = 0; k < at_once; ++k) sums[k] = found.total(k);
}

/// b + Σ shares a, in place.
HWY_INLINE void add_all(const Together& a, const float* shares, Numbers& b) {
  float* of_b = b.data();
  V share[at_once];
  for (std::size_t k = 0; k < at_once; ++k) share[k] = lanes_of(shares[k]);
  for (std::size_t at = 0; at < b.size(); at += hn::Lanes(D())) {
    V x = hn::LoadU(D(), of_b + at);
    for (std::size_t k = 0; k < at_once; ++k) x = hn::MulAdd(share[k], hn::LoadU(D(), a[k] + at), x);
    hn::StoreU(x, D(), of_b + at);
  }
}

HWY_INLINE float product(const Numbers& a, const Numbers& b) {
  LaneSums<1> sum;
  for_point_parts(b.size(), [&](std::size_t at, std::size_t part) HWY_ATTR {
    sum(0, part) = hn::MulAdd(hn::LoadU(D(), &a[at]), hn::LoadU(D(), &b[at]), sum(0, part));
  });
  return sum.total(0);
}

HWY_INLINE float length_of(const Numbers& a) { return std::sqrt(product(a, a)); }

HWY_INLINE void scale(Numbers& a, float s) {
  for (std::size_t at = 0; at < a.size(); at += hn::Lanes(D()))
    hn::StoreU(lanes_of(s) * hn::LoadU(D(), &a[at]), D(), &a[at]);
}

/// Solves A x = b for several b: of all combinations of the residuals tried for this b and for those before, that which
/// leaves the least (GMRES, Saad and Schultz 1986, in the form of Eisenstat, Elman and Schultz 1983; directions kept
/// from one right side to the next as Fischer 1998 does). Vectors are
/// points of whole groups of group_width nodes.
class KrylovLanes {
 public:
  /// `directions`: room for them, kept from one use to the next.
  explicit KrylovLanes(std::vector<TriedDirection>& directions) : directions_(directions) {}

  /// Before A changes.
  void forget() { known_ = 0; }

  /// `multiply(p, q)` puts A p into q. Ends with a residual no longer than `tolerance`, or after `most` further
  /// directions; leaves it in `b`, and the solution in `x`.
  template <class Multiply>
  void solve(const Multiply& multiply, float tolerance, int most, Numbers& b, Numbers& x) {
    shares_.clear();
    for (std::size_t k = 0; k < known_; k += at_once) take_out(k, std::min(k + at_once, known_), b, shares_);
    for (int step = 0; step < most && length_of(b) > tolerance; ++step) {
      if (known_ == directions_.size()) directions_.emplace_back();
      TriedDirection& next = directions_[known_];
      next.tried = b;
      next.image.assign(b.size(), 0);
      multiply(next.tried, next.image);
      next.of_images.clear();
      for (std::size_t k = 0; k < known_; k += at_once)
        take_out(k, std::min(k + at_once, known_), next.image, next.of_images);
      const float length = length_of(next.image);
      if (!(length > 0) || !std::isfinite(length)) break;
      scale(next.image, 1 / length);
      next.of_images.push_back(length);
      ++known_;
      take_out(known_ - 1, known_, b, shares_);
    }
    combine(x, b.size());
  }

 private:
  Together images(std::size_t from, std::size_t to) const {
    Together all;
    for (std::size_t k = 0; k < at_once; ++k) all[k] = directions_[std::min(from + k, to - 1)].image.data();
    return all;
  }

  /// Takes what points along some images out of b, and notes how much it was.
  void take_out(std::size_t from, std::size_t to, Numbers& b, Numbers& shares) const {
    const Together all = images(from, to);
    float found[at_once], taken[at_once] = {};
    products(all, b, found);
    for (std::size_t k = 0; k < to - from; ++k) shares.push_back(found[k]), taken[k] = -found[k];
    add_all(all, taken, b);
  }

  /// From shares of images, which are combinations of A times what was tried, to the combination of that.
  void combine(Numbers& x, std::size_t size) {
    x.assign(size, 0);
    for (std::size_t k = known_; k-- > 0;) {
      const Numbers& of_images = directions_[k].of_images;
      shares_[k] /= of_images[k];
      for (std::size_t j = 0; j < k; ++j) shares_[j] -= shares_[k] * of_images[j];
    }
    for (std::size_t k = 0; k < known_; k += at_once) {
      Together tried;
      float shares[at_once] = {};
      for (std::size_t j = 0; j < at_once; ++j) {
        tried[j] = directions_[std::min(k + j, known_ - 1)].tried.data();
        if (k + j < known_) shares[j] = shares_[k + j];
      }
      add_all(tried, shares, x);
    }
  }

  std::vector<TriedDirection>& directions_;
  std::size_t known_ = 0;  ///< of the directions
  Numbers shares_;         ///< of the images in b
};

}  // namespace gracilis::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
