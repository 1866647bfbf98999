#include <gracilis/opensim/functions/millard_curves.hpp>

#include <algorithm>

namespace gracilis::opensim {

/// Points from one to the next of which corners are rounded.
static BezierCurve rounded(const std::vector<CurveEnd>& ends, const std::vector<Real>& curviness) {
  BezierCurve curve;
  for (std::size_t i = 1; i < ends.size(); ++i) add_corner(curve, ends[i - 1], ends[i], curviness[i - 1]);
  return curve;
}

static BezierCurve active_curve(const MillardShape& s) {
  const Real x0 = s.min_norm_active_fiber_length, x1 = s.transition_norm_fiber_length;
  const Real x3 = s.max_norm_active_fiber_length, flat = 0.05;  // half the plateau's width
  const Real y1 = 1 - s.shallow_ascending_slope * (1 - flat - x1);
  const CurveEnd rising{(x0 + x1) / 2, y1 / 2, 1.25 * y1 / (x1 - x0)};
  const CurveEnd shallow{(x1 + 1 - flat) / 2, (y1 + 1) / 2, s.shallow_ascending_slope};
  const CurveEnd falling{(1 + flat + x3) / 2, 0.5, -1 / (x3 - flat - (1 + flat))};
  return rounded({{x0, s.minimum_value, 0}, rising, shallow, {1, 1, 0}, falling, {x3, s.minimum_value, 0}},
                 std::vector<Real>(5, 1));
}

static BezierCurve velocity_curve(const MillardShape& s) {
  const Real near = 0.9, gap = 1 - near, largest = s.max_eccentric_velocity_force_multiplier;
  const Real shortening = 0.5 * gap * (s.concentric_slope_near_vmax + s.concentric_slope_at_vmax);
  const Real stretching = largest - 0.5 * gap * (s.eccentric_slope_near_vmax + s.eccentric_slope_at_vmax);
  return rounded({{-1, 0, s.concentric_slope_at_vmax},
                  {-near, shortening, s.concentric_slope_near_vmax},
                  {0, 1, s.isometric_slope},
                  {near, stretching, s.eccentric_slope_near_vmax},
                  {1, largest, s.eccentric_slope_at_vmax}},
                 {s.concentric_curviness, s.concentric_curviness, s.eccentric_curviness, s.eccentric_curviness});
}

static BezierCurve passive_curve(const MillardShape& s) {
  const Real zero = 1 + s.fiber_strain_at_zero_force, one = 1 + s.fiber_strain_at_one_norm_force;
  const Real toe = std::min(0.1 / s.fiber_stiffness_at_one_norm_force, 0.1 * (one - zero));
  const Real low = s.fiber_stiffness_at_low_force;
  return rounded({{zero, 0, 0}, {zero + toe, low * toe / 2, low}, {one, 1, s.fiber_stiffness_at_one_norm_force}},
                 {s.fiber_curviness, s.fiber_curviness});
}

static BezierCurve tendon_curve(const MillardShape& s) {
  const Real one = 1 + s.tendon_strain_at_one_norm_force, stiffness = s.tendon_stiffness_at_one_norm_force;
  const auto straight = [&](Real y) { return one + (y - 1) / stiffness; };  // the line that the curve ends on
  const Real toe = s.norm_force_at_toe_end, foot = 1 + (straight(toe) - 1) / 10;
  const Real steep = toe / 2 / (straight(toe / 2) - foot);
  const Real middle = (foot + straight(toe / 2)) / 2;
  return rounded({{1, 0, 0}, {middle, steep * (middle - foot), steep}, {straight(toe), toe, stiffness}},
                 {s.tendon_curviness, s.tendon_curviness});
}

MillardCurves::MillardCurves(const MillardShape& shape)
    : active(active_curve(shape)),
      velocity(velocity_curve(shape)),
      passive(passive_curve(shape)),
      tendon(tendon_curve(shape)),
      shortest(shape.min_norm_active_fiber_length) {}

static bool in_unit(Real x) { return x >= 0 && x <= 1; }

const char* objection(const MillardShape& s) {
  const Real x1 = s.transition_norm_fiber_length, x3 = s.max_norm_active_fiber_length;
  if (!(s.min_norm_active_fiber_length >= 0 && x1 > s.min_norm_active_fiber_length && x1 < 0.95 && x3 > 1.1))
    return "lengths of its active force do not increase";
  if (!(s.minimum_value >= 0 && s.shallow_ascending_slope >= 0 &&
        s.shallow_ascending_slope < (1 - s.minimum_value) / (1 - x1)))
    return "its active force's plateau is too steep";
  const Real more = s.max_eccentric_velocity_force_multiplier - 1;
  if (!(more > 0 && s.isometric_slope > 1 && s.isometric_slope > more && s.concentric_slope_at_vmax >= 0 &&
        s.concentric_slope_near_vmax > s.concentric_slope_at_vmax && s.concentric_slope_near_vmax <= 1 &&
        s.eccentric_slope_at_vmax >= 0 && s.eccentric_slope_near_vmax >= s.eccentric_slope_at_vmax &&
        s.eccentric_slope_near_vmax < more))
    return "its force-velocity curve has slopes that do not fit";
  const Real strain = s.fiber_strain_at_one_norm_force - s.fiber_strain_at_zero_force;
  if (!(strain > 0 && s.fiber_stiffness_at_one_norm_force > 1 / strain && s.fiber_stiffness_at_low_force > 0 &&
        s.fiber_stiffness_at_low_force < 1 / strain))
    return "its passive force's stiffnesses do not fit its strains";
  if (!(s.tendon_strain_at_one_norm_force > 0 && s.norm_force_at_toe_end > 0 && s.norm_force_at_toe_end < 1 &&
        s.tendon_stiffness_at_one_norm_force > 1 / s.tendon_strain_at_one_norm_force))
    return "its tendon's stiffness does not fit its strain";
  if (!(in_unit(s.concentric_curviness) && in_unit(s.eccentric_curviness) && in_unit(s.fiber_curviness) &&
        in_unit(s.tendon_curviness)))
    return "a curviness is not between 0 and 1";
  return "";
}

}  // namespace gracilis::opensim
