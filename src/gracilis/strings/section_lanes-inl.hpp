// How cross-sections turned (cross_sections.hpp), a node per lane. Included once per instruction set.

#if defined(GRACILIS_SECTION_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRACILIS_SECTION_LANES_INL
#undef GRACILIS_SECTION_LANES_INL
#else
#define GRACILIS_SECTION_LANES_INL
#endif

#include <gracilis/strings/lane_forces-inl.hpp>
#include <gracilis/strings/lane_sum-inl.hpp>

HWY_BEFORE_NAMESPACE();
namespace gracilis::HWY_NAMESPACE {

/// Rows of a matrix, one per lane.
struct MatrixLanes {
  Point row[3];
};

HWY_INLINE MatrixLanes load_matrix(const std::array<std::vector<float>, 9>& a, std::size_t at) {
  MatrixLanes m;
  for (std::size_t i = 0; i < 3; ++i) m.row[i] = {load(a[3 * i], at), load(a[3 * i + 1], at), load(a[3 * i + 2], at)};
  return m;
}
HWY_INLINE void store_matrix(const MatrixLanes& m, std::array<std::vector<float>, 9>& a, std::size_t at) {
  for (std::size_t i = 0; i < 3; ++i)
    store(m.row[i].x, a[3 * i], at), store(m.row[i].y, a[3 * i + 1], at), store(m.row[i].z, a[3 * i + 2], at);
}

/// The rotation by 2 atan(|w| / 2) about w, of a vector.
HWY_INLINE Point turned(Point w, Point p) {
  const V four = lanes_of(4), norm = lanes_of(1) / (four + dot<Math>(w, w));
  const Point once = cross(w, p), twice = cross(w, once);
  return p + scaled(norm, scaled(four, once) + scaled(lanes_of(2), twice));
}

/// One step of Newton's towards the rotation R that is nearest to A, which maximizes tr(Rᵀ A): the turn w with
/// (tr(S) - S) w = s, where S is the symmetric part of A Rᵀ and s the axis of its other part.
HWY_INLINE MatrixLanes nearer_rotation(const MatrixLanes& a, const MatrixLanes& r) {
  constexpr float largest_turn = 0.5f, least_spread = 1e-12f, regular = 1e-4f;
  const auto product = [&](int i, int j) HWY_ATTR { return dot<Math>(a.row[i], r.row[j]); };
  const V half = lanes_of(0.5f);
  const V xx = product(0, 0), yy = product(1, 1), zz = product(2, 2);
  const V xy = product(0, 1), yx = product(1, 0), xz = product(0, 2), zx = product(2, 0), yz = product(1, 2),
          zy = product(2, 1);
  const V zero = hn::Zero(D());
  const V spread = hn::Max(hn::Abs(xx) + hn::Abs(yy) + hn::Abs(zz), lanes_of(least_spread));
  const V bit = lanes_of(regular) * spread;
  const SymmetricLanes newton = {yy + zz + bit, zero - half * (xy + yx), zero - half * (xz + zx),
                                 xx + zz + bit, zero - half * (yz + zy), xx + yy + bit};
  Point w = times(inverse(newton), Point{zy - yz, xz - zx, yx - xy});
  const V length = hn::Sqrt(dot<Math>(w, w));
  const V share = hn::Min(lanes_of(1), lanes_of(largest_turn) / hn::Max(length, lanes_of(1e-12f)));
  const auto is_finite = hn::Lt(length, lanes_of(1e6f));
  w = scaled(hn::IfThenElseZero(is_finite, share), w);
  w = {hn::IfThenElseZero(is_finite, w.x), hn::IfThenElseZero(is_finite, w.y), hn::IfThenElseZero(is_finite, w.z)};
  // R's columns are turned.
  MatrixLanes next;
  const Point x = turned(w, {r.row[0].x, r.row[1].x, r.row[2].x}), y = turned(w, {r.row[0].y, r.row[1].y, r.row[2].y}),
              z = turned(w, {r.row[0].z, r.row[1].z, r.row[2].z});
  next.row[0] = {x.x, y.x, z.x}, next.row[1] = {x.y, y.y, z.y}, next.row[2] = {x.z, y.z, z.z};
  return next;
}

/// Turns each section towards where its nodes and the strings' directions are.
HWY_INLINE void turn_sections(int steps, LaneWorkspace& w) {
  for (std::size_t at = 0; at < w.turn[0].size(); at += hn::Lanes(D())) {
    const MatrixLanes correlation = load_matrix(w.correlation, at);
    MatrixLanes turn = load_matrix(w.turn, at);
    for (int step = 0; step < steps; ++step) turn = nearer_rotation(correlation, turn);
    store_matrix(turn, w.turn, at);
  }
}

/// Of the nodes of each section with where they are at rest, as section_turns has it.
HWY_INLINE void correlate_sections(const strings::StringLanes& lanes, LaneWorkspace& w) {
  const D d;
  const auto width = static_cast<std::size_t>(lanes.width), strings = static_cast<std::size_t>(lanes.strings);
  for (std::size_t i = 1; i + 1 < static_cast<std::size_t>(lanes.nodes); ++i) {
    LaneSums<12> sums;  // rows of the matrix, then the direction
    for_lane_parts(width, [&](std::size_t s, std::size_t part) HWY_ATTR {
      const std::size_t at = i * width + s;
      const auto counted = hn::FirstN(d, s < strings ? strings - s : 0);
      const Point x = load(w.place, at), rest = load(lanes.from_section, at);
      const Point along = unit(load(w.place, at + width) - load(w.place, at - width));
      sums.add(0, part, scaled(x.x, rest));
      sums.add(3, part, scaled(x.y, rest));
      sums.add(6, part, scaled(x.z, rest));
      sums.add(9, part,
               Point{hn::IfThenElseZero(counted, along.x), hn::IfThenElseZero(counted, along.y),
                     hn::IfThenElseZero(counted, along.z)});
    });
    const Eigen::Vector3f mean = sums.total_point(9).normalized();
    const Eigen::Vector3f& rest = lanes.section_direction[i];
    for (std::size_t k = 0; k < 9; ++k) {
      const auto row = static_cast<Index>(k / 3), column = static_cast<Index>(k % 3);
      w.correlation[k][i] = sums.total(k) + mean[row] * rest[column];
    }
  }
}

}  // namespace gracilis::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
