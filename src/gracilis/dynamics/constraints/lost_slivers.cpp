#include <gracilis/dynamics/constraints/lost_slivers.hpp>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "gracilis/dynamics/constraints/lost_slivers.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, as Highway asks.
#include <gracilis/dynamics/simd/particle_lanes-inl.hpp>

HWY_BEFORE_NAMESPACE();
namespace gracilis::HWY_NAMESPACE {

/// What rounding may have changed: m, and of the distance from the side.
constexpr float rounding = 3e-7f, share_rounding = 2e-3f;
/// Below this share of all areas together their sum does not tell the normal so exactly.
constexpr float least_sum = 1e-3f;

using Mask = hn::Mask<D>;

HWY_INLINE V number(float x) { return hn::Set(D(), x); }

struct Areas {
  Point sum;
  V all;  ///< their lengths together
};

/// Twice the areas of the faces around one end of each side, as vectors.
HWY_INLINE Areas areas_around(const Point& end, const AlignedVector<Index>& corners, std::size_t lane,
                              const Particles& particles, Areas areas) {
  constexpr auto width = static_cast<std::size_t>(group_width);
  for (std::size_t at = lane; at < corners.size(); at += 2 * width) {
    const Point next = load_particles(particles.xyzw.data(), corners.data() + at).x - end,
                last = load_particles(particles.xyzw.data(), corners.data() + at + width).x - end;
    const Point area = cross(next, last);
    areas.sum = areas.sum + area;
    areas.all = areas.all + hn::Sqrt(dot<Math>(area, area));
  }
  return areas;
}

/// Which of the lanes from `lane` on are surely where they belong.
HWY_INLINE Mask in_place(const SliverGroup& group, std::size_t lane, const Particles& particles) {
  const D d;
  const auto place_of = [&](const std::array<Index, group_width>& listed)
                            HWY_ATTR { return load_particles(particles.xyzw.data(), listed.data() + lane).x; };
  const auto number_of = [&](const std::array<float, group_width>& numbers)
                             HWY_ATTR { return hn::LoadU(d, numbers.data() + lane); };
  const Point a = place_of(group.a), b = place_of(group.b), side = b - a;
  const V zero = hn::Zero(d);
  Areas areas = {{zero, zero, zero}, zero};
  areas = areas_around(a, group.around_a, lane, particles, areas);
  areas = areas_around(b, group.around_b, lane, particles, areas);
  const Point along = scaled(number(1) / hn::Sqrt(dot<Math>(side, side)), side);
  const Point normal = areas.sum - scaled(dot<Math>(areas.sum, along), along);
  const V length = hn::Sqrt(dot<Math>(normal, normal));
  const Point out = scaled(number(1) / length, normal);
  const Point beside = place_of(group.tip) - (a + scaled(number_of(group.share), side));
  const V u = dot<Math>(beside, cross(out, along)), v = dot<Math>(beside, out);
  const V across = number_of(group.across), up = number_of(group.out);
  const V ahead = u * across + v * up, aside = hn::Abs(u * up - v * across);
  const V reserve = hn::MulAdd(number(share_rounding), hn::Sqrt(u * u + v * v), number(rounding));
  // Comparisons with what is not a number fail.
  return hn::And(hn::Gt(length, number(least_sum) * areas.all),
                 hn::And(hn::Gt(ahead, number_of(group.least) + reserve), hn::Gt(ahead, aside + reserve)));
}

std::uint32_t lost_tips(const SliverGroup& group, const Particles& particles) {
  const std::size_t lanes = hn::Lanes(D());
  std::uint32_t lost = (std::uint32_t{1} << group.members.size()) - 1;
  for (std::size_t lane = 0; lane < group.members.size(); lane += lanes)
    for_each_lane(in_place(group, lane, particles),
                  [&](std::size_t each) { lost &= ~(std::uint32_t{1} << (lane + each)); });
  return lost;
}

}  // namespace gracilis::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gracilis {

HWY_EXPORT(lost_tips);

std::uint32_t lost_tips(const SliverGroup& group, const Particles& particles) {
  return HWY_DYNAMIC_DISPATCH(lost_tips)(group, particles);
}

}  // namespace gracilis
#endif
