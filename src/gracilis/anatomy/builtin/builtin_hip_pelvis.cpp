#include <gracilis/anatomy/builtin/builtin_hip_pelvis.hpp>

#include <gracilis/geometry/implicit_surface_spline.hpp>

namespace gracilis::builtin_hip_shapes {

namespace {

/// The wing: a thin curved blade between the crest (first row) and the line above the acetabulum, from the anterior
/// spines (first column) to the posterior ones.
ImplicitSolid iliac_wing() {
  // clang-format off
  const ThickNet blade{4, 6, {
      thick(66, 72, 37, 5), thick(46, 106, 49, 6), thick(15, 140, 29, 5), thick(-24, 150, -6, 5), thick(-57, 131, -35, 6.5), thick(-75, 100, -47, 8),
      thick(59, 62, 33, 5), thick(41, 84, 34, 4), thick(13, 100, 9, 3.2), thick(-18, 104, -13, 4), thick(-48, 98, -33, 7), thick(-72, 84, -47, 8),
      thick(48, 48, 25, 6), thick(33, 58, 20, 5), thick(10, 64, 6, 4.5), thick(-12, 64, -6, 6), thick(-38, 68, -25, 8), thick(-63, 74, -46, 7),
      thick(38, 33, 16, 7), thick(28, 34, 9, 9), thick(9, 36, 1, 10), thick(-9, 40, -9, 10), thick(-26, 52, -22, 9), thick(-44, 66, -37, 7),
  }};
  // clang-format on
  const ImplicitSolid crest =
      thick_curve({thick(66, 72, 37.5, 6), thick(59, 91, 46, 6), thick(44, 110, 49, 7.5), thick(15, 142, 29, 6),
                   thick(-24, 152, -6, 5.5), thick(-57, 132, -35, 7), thick(-75, 98, -47, 8)});
  const ImplicitSolid lower_anterior_spine = thick_curve({thick(30, 30, 10, 9), thick(41, 36, 16, 7)});
  const ImplicitSolid sacral_side =
      thick_curve({thick(-6, 58, -24, 9), thick(-26, 78, -32, 9), thick(-50, 98, -40, 9), thick(-62, 110, -42, 7)});
  // Where the wing of the sacrum leans against it.
  const ImplicitSolid sacral_shoulder =
      thick_curve({thick(-22, 76, -30, 8), thick(-27, 98, -26, 9), thick(-42, 118, -32, 7)});
  return smooth_union({thick_sheet(blade), crest, lower_anterior_spine, sacral_side, sacral_shoulder}, 0.013);
}

/// From the pelvic brim to the symphysis; flat behind it, its lower branch a blade with the edge turned outwards.
ImplicitSolid pubis() {
  const ImplicitSolid brim =
      thick_curve({thick(-10, 58, -22, 11), thick(6, 40, -24, 12), thick(18, 22, -26, 12), thick(27, 8, -32, 10.5),
                   thick(35, -4, -43, 8.5), thick(41, -13, -55, 7.5), thick(44, -20, -66, 7.5)});
  // clang-format off
  const ThickNet body{3, 3, {
      thick(44, -19, -60, 8), thick(44, -21, -69, 8), thick(42, -22, -75, 6.5),
      thick(38, -29, -61, 6.5), thick(37, -32, -69, 7), thick(35, -34, -75.5, 6),
      thick(29, -42, -64, 6), thick(26, -46, -71, 6.5), thick(24, -48, -75.5, 5.5),
  }};
  const ThickNet lower_ramus{4, 2, {
      thick(28, -41, -71, 5), thick(24, -49, -74, 5.5),
      thick(12, -48, -65, 4.5), thick(9, -57, -67, 5),
      thick(-6, -50, -55, 5), thick(-9, -60, -57, 5.5),
      thick(-24, -46, -38, 8), thick(-28, -59, -45, 9),
  }};
  // clang-format on
  return smooth_union({brim, thick_sheet(body), thick_sheet(lower_ramus)}, 0.006);
}

/// The seat bone, its spine below the sciatic notch, and the flat inner wall between it and the brim.
ImplicitSolid ischium() {
  const ImplicitSolid posterior_column =
      thick_curve({thick(-22, 54, -23, 10), thick(-25, 34, -21, 12), thick(-26, 12, -20, 14), thick(-28, -12, -18, 14),
                   thick(-34, -30, -20, 13), thick(-42, -44, -26, 13), thick(-36, -53, -36, 11)});
  const ImplicitSolid tuberosity = thick_curve(
      {thick(-46, -22, -18, 8), thick(-52, -38, -22, 10), thick(-48, -54, -30, 10), thick(-36, -62, -40, 6)});
  const ImplicitSolid spine = thick_curve({thick(-32, 2, -26, 9), thick(-42, 3, -35, 6), thick(-48, 3, -41, 3)});
  // clang-format off
  const ThickNet wall{3, 3, {
      thick(22, 14, -30, 7), thick(6, 34, -26, 8), thick(-10, 52, -24, 8),
      thick(14, 0, -32, 5), thick(-6, 14, -29, 6), thick(-23, 32, -25, 8),
      thick(2, -18, -28, 5), thick(-14, -8, -27, 7), thick(-28, 8, -24, 8),
  }};
  // clang-format on
  return smooth_union({posterior_column, tuberosity, spine, thick_sheet(wall)}, 0.008);
}

/// The outside of the cup, open towards the side, the front and below.
const Vec3 socket_axis = Vec3(0.30, -0.58, 0.76).normalized();

ImplicitSolid cup() {
  const ImplicitSolid outside = ball(millimetres(-1, 2, -1), 0.034);
  return smooth_intersection(outside, half_space(0.004 * socket_axis, socket_axis, outside.bounds), 0.006);
}

/// The socket itself, and the notch at its lower rim.
ImplicitSolid socket() {
  const ImplicitSolid notch = thick_curve({thick(4, -17, -16, 8), thick(8, -26, -10, 9), thick(10, -38, 0, 9)});
  // The joint opens outwards so that the neck never meets bone.
  const ImplicitSolid mouth = thick_curve({{Vec3::Zero(), socket_radius}, {0.05 * socket_axis, socket_radius + 0.012}});
  return smooth_union({ball(Vec3::Zero(), socket_radius), mouth, notch}, 0.003);
}

}  // namespace

ImplicitSolid right_hip_bone() {
  const ImplicitSolid whole = smooth_union({iliac_wing(), pubis(), ischium(), cup()}, 0.010);
  return smooth_difference(whole, socket(), 0.003);
}

}  // namespace gracilis::builtin_hip_shapes
