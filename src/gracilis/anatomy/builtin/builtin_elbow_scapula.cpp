#include <gracilis/anatomy/builtin/builtin_elbow_scapula.hpp>

#include <gracilis/geometry/implicit_surface_spline.hpp>

namespace gracilis::builtin_elbow_shapes {

namespace {

/// The thin triangle between its three borders, the lateral one thick.
ImplicitSolid blade() {
  // clang-format off
  // Columns from the side to the median plane.
  const ThickNet plate{5, 3, {
      thick(-36, 303, -64, 5), thick(-58, 318, -92, 3.2), thick(-74, 326, -120, 3.5),
      thick(-42, 285, -74, 8), thick(-64, 288, -100, 3.5), thick(-84, 292, -132, 3.5),
      thick(-48, 255, -74, 5.5), thick(-70, 250, -100, 3.2), thick(-88, 252, -130, 3.5),
      thick(-58, 222, -82, 5), thick(-74, 218, -102, 3.2), thick(-88, 215, -124, 3.5),
      thick(-72, 190, -100, 5), thick(-78, 186, -106, 4.5), thick(-85, 184, -112, 4.5),
  }};
  // clang-format on
  const ImplicitSolid lateral_border = thick_curve(
      {thick(-32, 268, -58, 6), thick(-46, 245, -70, 6), thick(-58, 220, -82, 5.5), thick(-73, 190, -101, 6)});
  return smooth_union({thick_sheet(plate), lateral_border}, 0.006);
}

ImplicitSolid spine_and_acromion() {
  // clang-format off
  const ThickNet spine{2, 3, {
      thick(-84, 291, -130, 3.5), thick(-64, 290, -100, 4), thick(-46, 290, -80, 5),
      thick(-90, 297, -127, 4), thick(-80, 304, -100, 4.5), thick(-66, 313, -68, 5),
  }};
  // clang-format on
  const ImplicitSolid acromion = thick_curve({thick(-66, 313, -68, 5.5), thick(-55, 323, -40, 6.5),
                                              thick(-38, 328, -13, 7), thick(-20, 329, 0, 7), thick(-5, 327, -6, 6)});
  return smooth_union({thick_sheet(spine), acromion}, 0.006);
}

/// The socket with the tubercles above and below it, on which the long heads of biceps and triceps grow.
ImplicitSolid glenoid() {
  const ImplicitSolid neck =
      thick_curve({thick(-25, 300, -53, 10), thick(-28, 286, -56, 13), thick(-30, 270, -55, 10)});
  const ImplicitSolid root = thick_curve({thick(-29, 286, -58, 12), thick(-44, 288, -78, 8)});
  const ImplicitSolid lower_root = thick_curve({thick(-31, 273, -58, 8), thick(-46, 268, -76, 6)});
  return smooth_union({neck, root, lower_root, thick_curve({thick(-27, 302, -51, 7), thick(-18, 306, -45, 5)}),
                       ball(millimetres(-32, 261, -55), 0.006)},
                      0.006);
}

ImplicitSolid coracoid() {
  return thick_curve({thick(-32, 302, -61, 8), thick(-20, 315, -58, 7.5), thick(-1, 318, -50, 7),
                      thick(14, 310, -40, 6.5), thick(20, 300, -33, 6)});
}

}  // namespace

ImplicitSolid right_scapula() {
  const ImplicitSolid whole = smooth_union({blade(), spine_and_acromion(), glenoid(), coracoid()}, 0.008);
  return smooth_difference(whole, ball(humeral_head, humeral_head_radius + joint_gap), 0.003);
}

}  // namespace gracilis::builtin_elbow_shapes
