// The laws of material.hpp with a cell per lane, in double precision. Included once per instruction set.

#if defined(GRACILIS_MATERIAL_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRACILIS_MATERIAL_LANES_INL
#undef GRACILIS_MATERIAL_LANES_INL
#else
#define GRACILIS_MATERIAL_LANES_INL
#endif

#include <gracilis/dynamics/simd/number_lanes-inl.hpp>
#include <gracilis/methods/tissue/cell_lanes.hpp>

#include <hwy/contrib/math/math-inl.h>

HWY_BEFORE_NAMESPACE();
namespace gracilis::HWY_NAMESPACE {

using Doubles = hn::CappedTag<double, tissue::cells_in_group>;
using N = hn::Vec<Doubles>;
using DoubleMath = Lanes<Doubles>;
using Vectors = Vector3<N>;

HWY_INLINE N number(Real x) { return hn::Set(Doubles(), x); }
HWY_INLINE Vectors plus_scaled(Vectors a, N s, Vectors b) {
  return {hn::MulAdd(s, b.x, a.x), hn::MulAdd(s, b.y, a.y), hn::MulAdd(s, b.z, a.z)};
}

struct MatrixLanes {
  Vectors column[3];
};
HWY_INLINE MatrixLanes scaled(N s, const MatrixLanes& m) {
  return {{scaled(s, m.column[0]), scaled(s, m.column[1]), scaled(s, m.column[2])}};
}
HWY_INLINE MatrixLanes plus_scaled(const MatrixLanes& a, N s, const MatrixLanes& b) {
  return {{plus_scaled(a.column[0], s, b.column[0]), plus_scaled(a.column[1], s, b.column[1]),
           plus_scaled(a.column[2], s, b.column[2])}};
}

struct LawOfLanes {
  N shear, stiffening, lambda, bulk, rest_tension, stiffness, active, optimal, least_strain;
  Vectors direction;
};

HWY_INLINE LawOfLanes load_law(const tissue::LawLanes& laws, std::size_t at) {
  const auto load = [&](const std::vector<Real>& numbers) HWY_ATTR { return hn::LoadU(Doubles(), &numbers[at]); };
  return {load(laws.shear),        load(laws.stiffening),
          load(laws.lambda),       load(laws.bulk),
          load(laws.rest_tension), load(laws.stiffness),
          load(laws.active),       load(laws.optimal),
          load(laws.least_strain), {load(laws.direction[0]), load(laws.direction[1]), load(laws.direction[2])}};
}

/// A deformation gradient and what follows from it.
struct Deformation {
  MatrixLanes gradient, cofactors;
  N volume_ratio;
};

HWY_INLINE Deformation deformation_of(const MatrixLanes& f) {
  const MatrixLanes c = {
      {cross(f.column[1], f.column[2]), cross(f.column[2], f.column[0]), cross(f.column[0], f.column[1])}};
  return {f, c, dot<DoubleMath>(f.column[0], c.column[0])};
}

struct CurveLanes {
  N energy, slope;
};

/// `shear_curve` of material.hpp.
HWY_INLINE CurveLanes shear_curve_lanes(const LawOfLanes& law, N squared_size) {
  const N strain = squared_size - number(3), drawn_out = hn::Max(strain, number(0));
  const N stiffer = law.stiffening * drawn_out * drawn_out;
  return {number(0.5) * law.shear * hn::MulAdd(number(1.0 / 3) * stiffer, drawn_out, strain),
          hn::MulAdd(law.shear, stiffer, law.shear)};
}

HWY_INLINE CurveLanes volume_curve_lanes(const LawOfLanes& law, N j) {
  const N growth = j - number(1);
  CurveLanes sum = {growth * hn::MulSub(number(0.5) * law.lambda, growth, law.shear),
                    hn::MulSub(law.lambda, growth, law.shear)};
  const auto is_flat = hn::Lt(j, number(tissue::barrier_begin));
  if (HWY_LIKELY(hn::AllFalse(Doubles(), is_flat))) return sum;
  const N d = hn::Min(j - number(tissue::barrier_begin), number(0));
  const N log = hn::Log(Doubles(), hn::Min(j * number(1 / tissue::barrier_begin), number(1)));
  const N k = hn::Max(law.lambda, number(tissue::barrier_per_shear) * law.shear);
  sum.energy = sum.energy - k * d * d * log;
  sum.slope = sum.slope - k * (number(2) * d * log + d * d / j);
  return sum;
}

/// `force_length` of material.cpp.
HWY_INLINE CurveLanes force_length_lanes(N x) {
  const N zero = number(0), two_thirds_of_a_fifth = number(0.024);
  // Each piece is entered as far as x goes into it.
  const N rising = hn::Min(hn::Max(x - number(0.4), zero), number(0.2));
  const N middle = hn::Min(hn::Max(x, number(0.6)), number(1.4)) - number(1);
  const N falling = hn::Min(hn::Max(x, number(1.4)), number(1.6)) - number(1.6);
  const N middle_begin = number(-0.4 + 4.0 / 3 * 0.064);
  const N energy = number(3) * rising * rising * rising +
                   (middle - number(4.0 / 3) * middle * middle * middle - middle_begin) +
                   (number(3) * falling * falling * falling + two_thirds_of_a_fifth);
  const N at_rise = number(9) * rising * rising, at_fall = number(9) * falling * falling;
  const N at_middle = number(1) - number(4) * middle * middle;
  const N slope =
      hn::IfThenElse(hn::Lt(x, number(0.6)), at_rise, hn::IfThenElse(hn::Gt(x, number(1.4)), at_fall, at_middle));
  return {energy, slope};
}

HWY_INLINE CurveLanes fiber_curve_lanes(const LawOfLanes& law, N stretch, bool any_active) {
  const N strain = stretch - number(1), taut = hn::Max(strain, law.least_strain);
  const N tension = hn::MulAdd(law.stiffness, taut, law.rest_tension);
  CurveLanes sum = {taut * hn::MulAdd(number(0.5) * law.stiffness, taut, law.rest_tension) + tension * (strain - taut),
                    tension};
  if (!any_active) return sum;
  const CurveLanes active = force_length_lanes(stretch / law.optimal);
  sum.energy = sum.energy + law.active * law.optimal * active.energy;
  sum.slope = hn::MulAdd(law.active, active.slope, sum.slope);
  return sum;
}

/// `tissue_energy` of material.hpp.
HWY_INLINE N tissue_energy_lanes(const LawOfLanes& law, const Deformation& deformation, bool any_active,
                                 MatrixLanes& stress) {
  const MatrixLanes& f = deformation.gradient;
  const CurveLanes volume = volume_curve_lanes(law, deformation.volume_ratio);
  const CurveLanes shear =
      shear_curve_lanes(law, dot<DoubleMath>(f.column[0], f.column[0]) + dot<DoubleMath>(f.column[1], f.column[1]) +
                                 dot<DoubleMath>(f.column[2], f.column[2]));
  stress = plus_scaled(scaled(shear.slope, f), volume.slope, deformation.cofactors);
  const Vectors d = law.direction;
  const Vectors along = plus_scaled(plus_scaled(scaled(d.x, f.column[0]), d.y, f.column[1]), d.z, f.column[2]);
  // Where there is no direction nothing pulls either.
  const N stretch = hn::Sqrt(hn::Max(dot<DoubleMath>(along, along), number(1e-30)));
  const CurveLanes fiber = fiber_curve_lanes(law, stretch, any_active);
  const Vectors pull = scaled(fiber.slope / stretch, along);
  stress.column[0] = plus_scaled(stress.column[0], d.x, pull);
  stress.column[1] = plus_scaled(stress.column[1], d.y, pull);
  stress.column[2] = plus_scaled(stress.column[2], d.z, pull);
  return shear.energy + volume.energy + fiber.energy;
}

}  // namespace gracilis::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
