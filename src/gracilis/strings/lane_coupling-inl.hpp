// How strings of a muscle hold each other's places, and how that changes where they move. Included once per instruction
// set.

#if defined(GRACILIS_LANE_COUPLING_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRACILIS_LANE_COUPLING_INL
#undef GRACILIS_LANE_COUPLING_INL
#else
#define GRACILIS_LANE_COUPLING_INL
#endif

#include <gracilis/strings/lane_sum-inl.hpp>
#include <gracilis/strings/matrix_lanes-inl.hpp>
#include <gracilis/strings/rate_workspace.hpp>
#include <gracilis/strings/section_lanes-inl.hpp>

#include <Eigen/LU>

HWY_BEFORE_NAMESPACE();
namespace gracilis::HWY_NAMESPACE {

using strings::RateWorkspace;

/// The part of the forces' derivative by places that goes from string to string: neighbors' mean places, and the turns
/// of cross-sections.
class LaneCoupling {
 public:
  LaneCoupling(const strings::MuscleStrings& muscle, LaneWorkspace& workspace, RateWorkspace& rates)
      : lanes_(muscle.lanes),
        neighbor_(static_cast<float>(1 / (muscle.settings.neighbor_length * muscle.settings.neighbor_length))),
        w_(workspace),
        r_(rates),
        width_(static_cast<std::size_t>(lanes_.width)),
        inner_(static_cast<std::size_t>(lanes_.nodes - 1)) {}

  bool is_there() const { return !lanes_.neighbor_weight.empty(); }

  /// Turns the cross-sections to where nodes are now, and places the nodes among their neighbors.
  void look() {
    if (!is_there()) return;
    constexpr int steps = 4;
    correlate_sections(lanes_, w_);
    turn_sections(steps, w_);
    const std::size_t count = 3 * width_ * (inner_ + 1);
    for (std::vector<float>* each : {&r_.arm, &r_.section_arm, &r_.wanted, &places_}) each->resize(count);
    r_.sections.resize(inner_ + 1);
    for (std::size_t at = 0; at < width_ * (inner_ + 1); at += hn::Lanes(D()))
      store_point(load(w_.place, at), &places_[3 * at]);
    for (std::size_t i = 1; i < inner_; ++i) {
      Eigen::Matrix3f turn;
      for (Index k = 0; k < 9; ++k) turn(k / 3, k % 3) = w_.turn[static_cast<std::size_t>(k)][i];
      Affine turned;
      turned << turn, Eigen::Vector3f::Zero();
      measure_section(i, turn);
      for (std::size_t s = 0; s < width_; s += hn::Lanes(D())) {
        const std::size_t at = i * width_ + s;
        store_point(gracilis::HWY_NAMESPACE::turn(turned, load(lanes_.from_section, at)), &r_.section_arm[3 * at]);
        store_point(gracilis::HWY_NAMESPACE::turn(turned, load(lanes_.from_neighbors, at)), &r_.arm[3 * at]);
      }
      for_neighbor_means(lanes_.neighbor_weight, places_, i, [&](std::size_t at, Point mean) HWY_ATTR {
        store_point(mean + load_point(&r_.arm[3 * at]), &r_.wanted[3 * at]);
      });
    }
  }

  /// Adds what moving nodes does to the forces on others'; 3 numbers per node.
  void add(const std::vector<float>& moves, std::vector<float>& forces) const {
    if (!is_there()) return;
    for (std::size_t i = 1; i < inner_; ++i) {
      const Point turning = lanes_of(section_turning(moves, i));
      for_neighbor_means(lanes_.neighbor_weight, moves, i, [&](std::size_t at, Point mean) HWY_ATTR {
        const Point wanted = mean + cross(turning, load_point(&r_.arm[3 * at]));
        const V pull = stiffness(at) * hn::LoadU(D(), &r_.free[at]);
        store_point(plus_scaled(load_point(&forces[3 * at]), hn::Zero(D()) - pull, across(direction(at), wanted)),
                    &forces[3 * at]);
      });
    }
  }

  /// The transposed: from weights of free nodes to weights of all nodes.
  void add_transposed(const std::vector<float>& weights, std::vector<float>& of_moves) {
    if (!is_there()) return;
    pulled_.assign(3 * width_ * (inner_ + 1), 0);
    for (std::size_t i = 1; i < inner_; ++i) {
      LaneSums<3> turning;
      for_lane_parts(width_, [&](std::size_t s, std::size_t part) HWY_ATTR {
        const std::size_t at = i * width_ + s;
        const V pull = stiffness(at) * hn::LoadU(D(), &r_.free[at]);
        const Point there = scaled(hn::Zero(D()) - pull, across(direction(at), load_point(&weights[3 * at])));
        store_point(there, &pulled_[3 * at]);
        turning.add(0, part, cross(load_point(&r_.arm[3 * at]), there));
      });
      for_neighbor_means(lanes_.neighbor_weight_of, pulled_, i, [&](std::size_t at, Point sum) HWY_ATTR {
        store_point(load_point(&of_moves[3 * at]) + sum, &of_moves[3 * at]);
      });
      turn_transposed(i, turning.total_point(0), of_moves);
    }
  }

  /// How fast a cross-section turns where nodes move, rad per unit.
  Eigen::Vector3f section_turning(const std::vector<float>& moves, std::size_t i) const {
    LaneSums<6> sums;  // of moments and of directions
    for_lane_parts(width_, [&](std::size_t s, std::size_t part) HWY_ATTR {
      const std::size_t at = i * width_ + s;
      sums.add(0, part, cross(load_point(&r_.section_arm[3 * at]), load_point(&moves[3 * at])));
      const Point difference = load_point(&moves[3 * (at + width_)]) - load_point(&moves[3 * (at - width_)]);
      sums.add(3, part, scaled(counted(s), direction_rate(at, difference)));
    });
    const RateWorkspace::Section& section = r_.sections[i];
    return section.softness * (sums.total_point(0) + section.direction.cross(section.mean_rate * sums.total_point(3)));
  }

 private:
  HWY_INLINE Point direction(std::size_t at) const { return load_point(&r_.direction[3 * at]); }
  HWY_INLINE V stiffness(std::size_t at) const { return lanes_of(neighbor_) * load(lanes_.node_length, at % width_); }
  /// 1 for strings, 0 for what is beyond the last.
  HWY_INLINE V counted(std::size_t s) const {
    const auto strings = static_cast<std::size_t>(lanes_.strings);
    return hn::IfThenElseZero(hn::FirstN(D(), s < strings ? strings - s : 0), lanes_of(1));
  }
  /// How a node's direction changes where its neighbors along the string part by `difference`.
  HWY_INLINE Point direction_rate(std::size_t at, Point difference) const {
    return scaled(hn::LoadU(D(), &r_.inverse_reach[at]), across(direction(at), difference));
  }

  /// Calls act with the weighted sum of a section's nodes for each group of its strings.
  template <class Act>
  HWY_INLINE void for_neighbor_means(const std::vector<float>& weights, const std::vector<float>& points, std::size_t i,
                                     const Act& act) const {
    std::size_t s = 0;
    for (; s + 3 * hn::Lanes(D()) <= width_; s += 3 * hn::Lanes(D())) sum_neighbors<3>(weights, points, i, s, act);
    for (; s < width_; s += hn::Lanes(D())) sum_neighbors<1>(weights, points, i, s, act);
  }

  /// Some groups together, which share what they read of the others.
  template <std::size_t Together, class Act>
  HWY_INLINE void sum_neighbors(const std::vector<float>& weights, const std::vector<float>& points, std::size_t i,
                                std::size_t s, const Act& act) const {
    const std::size_t lanes = hn::Lanes(D());
    const V zero = hn::Zero(D());
    Point sums[Together];
    for (Point& sum : sums) sum = {zero, zero, zero};
    const float* weight = weights.data() + s;
    for (std::size_t j = 0; j < static_cast<std::size_t>(lanes_.strings); ++j, weight += width_) {
      const float* from = points.data() + 3 * (i * width_ + j / lanes * lanes) + j % lanes;
      const Point other{lanes_of(from[0]), lanes_of(from[lanes]), lanes_of(from[2 * lanes])};
      for (std::size_t t = 0; t < Together; ++t)
        sums[t] = plus_scaled(sums[t], hn::LoadU(D(), weight + t * lanes), other);
    }
    for (std::size_t t = 0; t < Together; ++t) act(i * width_ + s + t * lanes, sums[t]);
  }

  void measure_section(std::size_t i, const Eigen::Matrix3f& turn) {
    RateWorkspace::Section& section = r_.sections[i];
    LaneSums<3> sum;
    for_lane_parts(width_, [&](std::size_t s, std::size_t part) HWY_ATTR {
      const std::size_t at = i * width_ + s;
      sum.add(0, part, scaled(counted(s), unit(load(w_.place, at + width_) - load(w_.place, at - width_))));
    });
    const Eigen::Vector3f directions = sum.total_point(0), mean = directions.normalized();
    section.mean_rate = (Eigen::Matrix3f::Identity() - mean * mean.transpose()) / directions.norm();
    section.direction = turn * lanes_.section_direction[i];
    Eigen::Matrix3f correlation;
    for (Index k = 0; k < 9; ++k) correlation(k / 3, k % 3) = w_.correlation[static_cast<std::size_t>(k)][i];
    // With M = S R, S symmetric, and a turn w: (tr S - S) w is the axial vector of dM Rᵀ - R dMᵀ.
    const Eigen::Matrix3f stretch = correlation * turn.transpose();
    const Eigen::Matrix3f symmetric = (stretch + stretch.transpose()) / 2;
    const Eigen::Matrix3f moment = symmetric.trace() * Eigen::Matrix3f::Identity() - symmetric;
    section.softness.setZero();
    if (std::abs(moment.determinant()) > 0) section.softness = moment.inverse();
  }

  HWY_INLINE void turn_transposed(std::size_t i, const Eigen::Vector3f& turning, std::vector<float>& of_moves) const {
    const RateWorkspace::Section& section = r_.sections[i];
    const Eigen::Vector3f moment = section.softness.transpose() * turning;
    const Point by_moment = lanes_of(moment),
                by_direction = lanes_of(section.mean_rate * moment.cross(section.direction));
    const auto add = [&](std::size_t at, Point p)
                         HWY_ATTR { store_point(load_point(&of_moves[3 * at]) + p, &of_moves[3 * at]); };
    for (std::size_t s = 0; s < width_; s += hn::Lanes(D())) {
      const std::size_t at = i * width_ + s;
      add(at, cross(by_moment, load_point(&r_.section_arm[3 * at])));
      const Point along = scaled(counted(s), direction_rate(at, by_direction));
      add(at + width_, along), add(at - width_, scaled(lanes_of(-1), along));
    }
  }

  const strings::StringLanes& lanes_;
  const float neighbor_;  ///< what neighbors hold a node with over its length, 1/m²
  LaneWorkspace& w_;
  RateWorkspace& r_;
  std::size_t width_, inner_;
  std::vector<float> places_, pulled_;
};

}  // namespace gracilis::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
