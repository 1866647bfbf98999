#include <gracilis/anatomy/builtin/builtin_elbow_forearm.hpp>

#include <gracilis/anatomy/builtin/builtin_elbow_humerus.hpp>
#include <gracilis/geometry/implicit_surface_spline.hpp>

namespace gracilis::builtin_elbow_shapes {

ImplicitSolid radial_disc(Real margin) {
  const Vec3 up = Vec3::UnitY();
  const ImplicitSolid rod =
      thick_curve({{radial_head + 0.02 * up, 0.011 + margin}, {radial_head - 0.02 * up, 0.011 + margin}});
  const ImplicitSolid below =
      smooth_intersection(rod, half_space(radial_head + (0.0055 + margin) * up, up, rod.bounds), 0.002);
  return smooth_intersection(below, half_space(radial_head - (0.005 + margin) * up, -up, rod.bounds), 0.003);
}

ImplicitSolid ulnar_head(Real margin) {
  return thick_curve({{millimetres(0, -238, 14), 0.0075 + margin}, {millimetres(0, -244, 14), 0.0078 + margin}});
}

namespace {

/// Olecranon and coronoid process as one hook around the spool, and the shaft.
ImplicitSolid ulna_body() {
  // clang-format off
  const ThickNet hook{5, 2, {
      thick(-17, 13, -12.5, 6.5), thick(-17, 13, -4, 6.5),
      thick(-20, 5, -12.5, 8.5), thick(-20, 5, -3.5, 8.5),
      thick(-18, -9, -12, 9), thick(-18, -9, -3.5, 9),
      thick(-12, -23, -11, 9), thick(-12, -23, -3.5, 9),
      thick(-9, -38, -8, 8.5), thick(-9, -38, -5, 8.5),
  }};
  const ThickNet coronoid{3, 2, {
      thick(-8, -22, -13, 7), thick(-8, -22, -4, 7),
      thick(2, -17.5, -14, 7), thick(2, -17.5, -4, 7),
      thick(8.5, -13, -12, 4.8), thick(8.5, -13, -6, 4.8),
  }};
  // clang-format on
  const ImplicitSolid shaft =
      thick_curve({thick(-9, -34, -6.5, 8.5), thick(-12, -70, -6, 7.6), thick(-14, -120, -3, 7),
                   thick(-11, -170, 4, 6.5), thick(-5, -210, 10, 5.8), thick(0, -236, 14, 6.5)});
  const ImplicitSolid tuberosity = thick_curve({thick(0, -26, -8, 6), thick(-2, -38, -7, 5)});
  const ImplicitSolid styloid = thick_curve({thick(-3, -244, 11, 4), thick(-5, -252, 9, 3)});
  return smooth_union({thick_sheet(hook), thick_sheet(coronoid), shaft, tuberosity, styloid, ulnar_head(0)}, 0.005);
}

/// The neck bends away from the head's axis; the shaft bows to the side.
ImplicitSolid radius_body() {
  const ImplicitSolid shaft = thick_curve({thick(0, -17, 14, 8.5), thick(0, -25, 14, 7.2), thick(0, -45, 15, 7.2),
                                           thick(-1, -85, 20, 6.8), thick(-3, -120, 26, 7.2), thick(-3, -160, 31, 7.4),
                                           thick(-1, -195, 34, 8.5), thick(0, -220, 36, 10)});
  // Faces the ulna, turned forward by 30 degrees.
  const ImplicitSolid tuberosity =
      thick_curve({thick(3, -36, 10, 4.5), thick(3.5, -45, 9.5, 5), thick(2.5, -60, 11.5, 4.5)});
  // clang-format off
  const ThickNet distal{2, 2, {
      thick(0, -222, 33, 9), thick(0, -222, 38, 9),
      thick(0, -236, 31, 9), thick(0, -236, 42, 8.5),
  }};
  // clang-format on
  const ImplicitSolid styloid = thick_curve({thick(0, -238, 45, 6), thick(0, -248, 46, 4)});
  return smooth_union({shaft, tuberosity, thick_sheet(distal), styloid}, 0.006);
}

}  // namespace

ImplicitSolid right_ulna() {
  const ImplicitSolid notched = smooth_difference(ulna_body(), trochlea(joint_gap), 0.003);
  return smooth_difference(notched, radial_disc(joint_gap), 0.003);
}

ImplicitSolid right_radius() {
  const ImplicitSolid wrist_cut = ball(millimetres(0, -256, 32), 0.016);
  const ImplicitSolid whole = smooth_union({radial_disc(0), radius_body()}, 0.004);
  const ImplicitSolid dished =
      smooth_difference(whole, smooth_union({capitulum(joint_gap), trochlea(joint_gap)}, 0), 0.002);
  return smooth_difference(dished, smooth_union({wrist_cut, ulnar_head(joint_gap)}, 0.002), 0.003);
}

}  // namespace gracilis::builtin_elbow_shapes
