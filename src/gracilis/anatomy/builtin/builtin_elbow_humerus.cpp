#include <gracilis/anatomy/builtin/builtin_elbow_humerus.hpp>

#include <gracilis/geometry/implicit_surface_spline.hpp>

namespace gracilis::builtin_elbow_shapes {

ImplicitSolid trochlea(Real margin) {
  // Balls along the axis fill the groove between them: it is drawn deeper than the 9 mm that it becomes.
  std::vector<ThickPoint> spool = {thick(0, 0, -23, 15), thick(0, 0, -19, 13.5), thick(0, 0, -14, 9.8),
                                   thick(0, 0, -9, 7.8), thick(0, 0, -4, 9.6),   thick(0, 0, -1, 9.8),
                                   thick(0, 0, 2, 7.6),  thick(0, 0, 6, 7)};
  for (ThickPoint& p : spool) p.radius += margin;
  const ImplicitSolid turned = thick_curve(spool);
  return smooth_intersection(turned, half_space({0, 0, -0.022 - margin}, -Vec3::UnitZ(), turned.bounds), 0.005);
}

ImplicitSolid capitulum(Real margin) {
  const ImplicitSolid whole = ball(millimetres(0, 0, 14), 0.0115 + margin);
  return smooth_intersection(whole, half_space({0, 0, 0.0225 + margin}, Vec3::UnitZ(), whole.bounds), 0.003);
}

namespace {

/// Head, tubercles and the groove between them for the long head of biceps.
ImplicitSolid proximal_end() {
  const ImplicitSolid greater_tubercle =
      thick_curve({thick(-2, 258, 0, 13), thick(-3, 280, 6, 12), thick(-9, 289, 5, 9)});
  const ImplicitSolid lesser_tubercle = thick_curve({thick(5, 256, -8, 10), thick(9, 273, -11, 8.5)});
  const ImplicitSolid neck = thick_curve({thick(-5, 248, -7, 14), thick(-6, 268, -9, 18), thick(-10, 280, -18, 20)});
  const ImplicitSolid groove =
      thick_curve({thick(15, 298, -4, 5), thick(19, 279, 0, 5), thick(16, 258, 0, 4.5), thick(13, 232, -1, 4)});
  const ImplicitSolid rounded = smooth_union({neck, greater_tubercle, lesser_tubercle}, 0.006);
  return smooth_difference(smooth_union({ball(humeral_head, humeral_head_radius), rounded}, 0.004), groove, 0.004);
}

ImplicitSolid shaft() {
  const ImplicitSolid tube =
      thick_curve({thick(-9, 46, -3, 9.5), thick(-8, 75, -4, 10.2), thick(-6, 110, -5, 10.6), thick(-5, 150, -6, 11.2),
                   thick(-5, 190, -7, 11.6), thick(-5, 225, -7, 12.5), thick(-5, 252, -7, 15)});
  const ImplicitSolid deltoid_tuberosity =
      thick_curve({thick(0, 178, 2, 5), thick(1, 152, 3, 5.5), thick(0, 128, 1, 5)});
  return smooth_union({tube, deltoid_tuberosity}, 0.006);
}

/// Two columns that carry the joint, with the epicondyles, and the thin plate between them.
ImplicitSolid columns() {
  const ImplicitSolid medial =
      thick_curve({thick(-9, 58, -5, 9), thick(-9, 34, -15, 7.5), thick(-8, 15, -23.5, 7), thick(-7, 3, -29.5, 6)});
  const ImplicitSolid lateral =
      thick_curve({thick(-9, 58, 0, 9), thick(-9, 34, 12, 7.5), thick(-8, 15, 20, 7), thick(-6, 3, 24, 5)});
  const ImplicitSolid behind_capitulum = thick_curve({thick(-8, 13, 16, 6), thick(-6, 4, 14, 6)});
  const ImplicitSolid plate = smooth_union({thick_curve({thick(-5, 15, -18, 5), thick(-5, 15, 10, 5)}),
                                            thick_curve({thick(-8, 28, -12, 5), thick(-8, 28, 8, 5)})},
                                           0.006);
  const ImplicitSolid medial_neck = thick_curve({thick(-4, 8, -18, 6), thick(-1, 2, -17, 7)});
  return smooth_union({medial, lateral, behind_capitulum, plate, medial_neck}, 0.006);
}

/// Room for the tips of the ulna and the rim of the radius at the ends of the motion.
ImplicitSolid fossae() {
  return smooth_union({thick_curve({thick(-18, 17, -16, 9.5), thick(-18, 17, 0, 9.5)}),  // olecranon
                       thick_curve({thick(7, 18, -14, 9), thick(7, 18, -3, 9)}),         // coronoid process
                       thick_curve({thick(9, 18, 8, 9), thick(9, 18, 19, 9)})},          // radial head
                      0.003);
}

/// What is left between the fossae: bone as thin as a sheet.
ImplicitSolid web() {
  return thick_sheet({4,
                      2,
                      {
                          thick(-1, 5, -18, 2.5),
                          thick(-1, 5, 12, 2.5),
                          thick(-4, 12, -20, 2),
                          thick(-4, 12, 14, 2),
                          thick(-6, 21, -18, 2),
                          thick(-6, 21, 12, 2),
                          thick(-9, 34, -10, 3),
                          thick(-9, 34, 6, 3),
                      }});
}

}  // namespace

ImplicitSolid right_humerus() {
  const ImplicitSolid body = smooth_union({proximal_end(), shaft(), columns()}, 0.006);
  const ImplicitSolid hollowed = smooth_union({smooth_difference(body, fossae(), 0.004), web()}, 0.004);
  return smooth_union({hollowed, trochlea(0), capitulum(0)}, 0.002);
}

}  // namespace gracilis::builtin_elbow_shapes
