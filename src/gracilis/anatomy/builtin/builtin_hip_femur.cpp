#include <gracilis/anatomy/builtin/builtin_hip_femur.hpp>

namespace gracilis::builtin_hip_shapes {

namespace {

/// Head, neck, trochanters and the crest between them. The neck leaves the shaft at about 127 degrees with about 12
/// degrees of anteversion.
ImplicitSolid proximal_end() {
  const ImplicitSolid neck = thick_curve({thick(-1, -4, 6, 17.5), thick(-3, -13, 17, 14.5), thick(-5, -23, 28, 14.5),
                                          thick(-6, -35, 38, 17.5), thick(-4, -52, 40, 17)});
  const ImplicitSolid greater_trochanter =
      smooth_union({thick_curve({thick(-3, -48, 44, 16), thick(-7, -32, 47, 15.5), thick(-12, -20, 48, 13),
                                 thick(-16, -11, 46, 10)}),
                    thick_curve({thick(-17, -10, 46, 9), thick(-25, -6, 42, 6)}),
                    thick_curve({thick(3, -40, 48, 13), thick(3, -26, 51, 10.5)}),
                    thick_curve({thick(-16, -42, 44, 12), thick(-21, -24, 46, 10.5)})},
                   0.010);
  const ImplicitSolid lesser_trochanter =
      thick_curve({thick(-4, -58, 31, 13), thick(-12, -60, 24, 9.5), thick(-18, -60, 17, 7)});
  const ImplicitSolid crest = thick_curve({thick(-24, -10, 45, 6), thick(-22, -32, 38, 6), thick(-18, -50, 27, 6)});
  const ImplicitSolid rounded = smooth_union({neck, greater_trochanter, lesser_trochanter, crest}, 0.009);
  return smooth_union({ball(Vec3::Zero(), head_radius), rounded}, 0.005);
}

/// A shaft bowed forward, with the gluteal tuberosity and the linea aspera along its back.
ImplicitSolid shaft() {
  const ImplicitSolid tube = thick_curve({thick(-4, -50, 39, 17), thick(-1, -80, 37, 15.2), thick(4, -120, 34, 14),
                                          thick(9, -165, 30, 13.6), thick(11, -211, 26, 13.6), thick(9, -260, 21, 13.9),
                                          thick(4, -310, 14, 15.5), thick(-1, -350, 8, 19), thick(-4, -376, 3, 22)});
  const ImplicitSolid gluteal_tuberosity =
      thick_curve({thick(-10, -60, 47, 6), thick(-10, -85, 44, 5), thick(-6, -115, 38, 4)});
  const ImplicitSolid linea_aspera =
      thick_curve({thick(-8, -80, 31, 3.5), thick(-6, -115, 33, 3.5), thick(-1, -165, 29, 3.5), thick(1, -211, 25, 3.5),
                   thick(-1, -260, 20, 3.5), thick(-6, -300, 15, 3)});
  return smooth_union({tube, gluteal_tuberosity, linea_aspera}, 0.006);
}

/// Two condyles with their epicondyles, the notch between them and the groove in which the patella glides.
ImplicitSolid distal_end() {
  std::vector<ImplicitSolid> parts;
  for (int side : {-1, 1}) {  // medial, lateral
    parts.push_back(thick_curve({thick(9, -382, side * 15.0, 14), thick(8, -400, side * 19.0, 17),
                                 thick(-10, -404, side * 23.0, 19.5), thick(-24, -399, side * 24.0, 18),
                                 thick(-30, -389, side * 23.0, 15)}));
    parts.push_back(thick_curve({thick(-6, -378, side * 15.0, 15), thick(-6, -393, side * 34.0, 8.5)}));
  }
  parts.push_back(thick_curve({thick(-3, -374, 3, 20), thick(4, -390, 0, 17)}));
  const ImplicitSolid notch = thick_curve({thick(-6, -429, 0, 10), thick(-24, -412, 0, 12), thick(-44, -388, 0, 14)});
  const ImplicitSolid groove = thick_curve({thick(43, -372, 2, 12), thick(41, -398, 1, 13), thick(24, -434, 0, 13)});
  return smooth_difference(smooth_difference(smooth_union(parts, 0.009), notch, 0.005), groove, 0.010);
}

}  // namespace

ImplicitSolid right_femur() { return smooth_union({proximal_end(), shaft(), distal_end()}, 0.008); }

}  // namespace gracilis::builtin_hip_shapes
