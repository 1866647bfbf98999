#include <gracilis/anatomy/builtin_hip_bones.hpp>
#include <gracilis/geometry/implicit_surface_spline.hpp>

namespace gracilis::builtin_hip_shapes {

namespace {

/// The wing: a thin curved blade between the crest (first row) and the line above the acetabulum, from the anterior
/// spines (first column) to the posterior ones.
ImplicitSolid iliac_wing() {
  const ThickNet blade{
      4,
      6,
      {
          thick(66, 72, 37, 5),      thick(46, 108, 46, 6),   thick(14, 140, 26, 5),  thick(-26, 150, -8, 5),
          thick(-58, 131, -34, 6.5), thick(-75, 100, -45, 8), thick(59, 62, 33, 5),   thick(40, 84, 34, 4),
          thick(12, 100, 12, 3.2),   thick(-18, 103, -11, 4), thick(-48, 98, -32, 7), thick(-72, 84, -46, 8),
          thick(48, 48, 25, 6),      thick(32, 58, 20, 5),    thick(9, 63, 8, 4.5),   thick(-12, 63, -4, 6),
          thick(-38, 68, -24, 8),    thick(-63, 74, -45, 7),  thick(38, 33, 16, 7),   thick(28, 34, 9, 9),
          thick(9, 36, 1, 10),       thick(-9, 40, -9, 10),   thick(-26, 52, -22, 9), thick(-44, 66, -36, 7),
      }};
  const ImplicitSolid crest =
      thick_curve({thick(66, 72, 37.5, 6), thick(58, 92, 44, 6), thick(45, 110, 46, 7.5), thick(14, 142, 26, 6),
                   thick(-26, 152, -8, 6), thick(-58, 132, -34, 7), thick(-75, 98, -45, 8)});
  const ImplicitSolid lower_anterior_spine = thick_curve({thick(30, 30, 10, 9), thick(41, 36, 16, 7)});
  const ImplicitSolid sacral_side =
      thick_curve({thick(-6, 58, -24, 9), thick(-26, 78, -32, 9), thick(-50, 98, -40, 9), thick(-62, 110, -42, 7)});
  return smooth_union({thick_sheet(blade), crest, lower_anterior_spine, sacral_side}, 0.008);
}

/// From the sacral joint along the pelvic brim to the symphysis, back along the lower ramus to the seat bone and up
/// again to the sciatic notch; the obturator foramen stays open between them.
ImplicitSolid ischium_and_pubis() {
  const ImplicitSolid brim =
      thick_curve({thick(-10, 58, -22, 11), thick(6, 40, -24, 12), thick(18, 22, -26, 12), thick(27, 8, -32, 10.5),
                   thick(35, -4, -43, 8.5), thick(41, -13, -55, 7.5), thick(44, -20, -66, 7.5)});
  const ThickNet body{2,
                      3,
                      {thick(44, -20, -64, 7.5), thick(43, -23, -72, 7), thick(41, -25, -76, 6), thick(33, -38, -66, 5),
                       thick(30, -43, -72, 6), thick(27, -46, -76, 6)}};
  const ImplicitSolid lower_ramus =
      thick_curve({thick(27, -45, -74, 6.5), thick(15, -51, -69, 6), thick(0, -55, -62, 6), thick(-16, -57, -52, 7.5),
                   thick(-32, -57, -42, 10)});
  const ImplicitSolid posterior_column =
      thick_curve({thick(-22, 54, -23, 10), thick(-25, 34, -21, 12), thick(-26, 12, -20, 14), thick(-28, -12, -18, 14),
                   thick(-36, -30, -22, 13), thick(-45, -44, -27, 14), thick(-40, -54, -33, 12)});
  const ImplicitSolid spine = thick_curve({thick(-32, 2, -26, 8), thick(-43, 4, -36, 5), thick(-50, 4, -43, 2.5)});
  return smooth_union({brim, thick_sheet(body), lower_ramus, posterior_column, spine}, 0.008);
}

/// The outside of the cup, open towards the side, the front and below.
const Vec3 socket_axis = Vec3(0.30, -0.58, 0.76).normalized();

ImplicitSolid cup() {
  const ImplicitSolid outside = ball(millimetres(-1, 2, -1), 0.034);
  return smooth_intersection(outside, half_space(0.004 * socket_axis, socket_axis, outside.bounds), 0.006);
}

/// The socket itself, the rough fossa in its floor and the notch at its lower rim.
ImplicitSolid socket() {
  const ImplicitSolid notch = thick_curve({thick(0, -8, -20, 9), thick(6, -22, -14, 9), thick(10, -34, -4, 9)});
  // The joint opens outwards so that the neck never meets bone.
  const ImplicitSolid mouth = thick_curve({{Vec3::Zero(), socket_radius}, {0.05 * socket_axis, socket_radius + 0.012}});
  return smooth_union({ball(Vec3::Zero(), socket_radius), mouth, notch}, 0.003);
}

}  // namespace

ImplicitSolid right_hip_bone() {
  const ImplicitSolid whole = smooth_union({iliac_wing(), ischium_and_pubis(), cup()}, 0.010);
  return smooth_difference(whole, socket(), 0.003);
}

ImplicitSolid sacrum(const ImplicitSolid& right_hip_bone) {
  const Real m = 1e3 * median_plane;
  // Rows: alae and first segment down to the tip of the coccyx; columns from left to right.
  struct Row {
    Real x, y, half_width, back, edge_y, middle, edge;  // `back`: how far the sides lie behind the middle
  };
  const Row rows[] = {{-8, 104, 50, 16, -2, 15, 10}, {-34, 84, 45, 8, 2, 13, 10}, {-56, 60, 36, 4, 4, 10, 7.5},
                      {-70, 36, 27, 2, 3, 8.5, 6},   {-75, 14, 17, -1, 2, 7, 5},  {-73, -6, 8, -2, 0, 5, 4},
                      {-65, -22, 3, 0, 0, 4, 3}};
  ThickNet shield{7, 5, {}};
  for (const Row& row : rows)
    for (int column = 0; column < 5; ++column) {
      const Real side = (column - 2) / 2.0, s2 = side * side;
      shield.points.push_back(thick(row.x - row.back * s2, row.y + row.edge_y * s2, m + side * row.half_width,
                                    row.middle + (row.edge - row.middle) * s2));
    }
  std::vector<ImplicitSolid> parts = {thick_sheet(shield)};
  parts.push_back(
      thick_curve({thick(-44, 112, m, 6), thick(-62, 92, m, 6), thick(-78, 66, m, 5), thick(-84, 40, m, 4)}));
  // The upper end plate and the two joint processes behind it.
  parts.push_back(thick_curve({thick(-8, 108, m - 12, 12), thick(-8, 108, m + 12, 12)}));
  for (int side : {-1, 1})
    parts.push_back(thick_curve({thick(-36, 106, m + side * 21, 7), thick(-38, 122, m + side * 22, 6)}));
  ImplicitSolid whole = smooth_union(parts, 0.010);
  // Shallow pits where the nerves leave.
  std::vector<ImplicitSolid> pits;
  for (int side : {-1, 1})
    for (int level = 0; level < 4; ++level) {
      const Vec3 front[] = {millimetres(-6, 82, 0), millimetres(-34, 62, 0), millimetres(-52, 40, 0),
                            millimetres(-60, 20, 0)};
      pits.push_back(ball(front[level] + millimetres(0, 0, m + side * (20 - 2.5 * level)), 0.007));
    }
  whole = smooth_difference(whole, smooth_union(pits, 0.002), 0.004);

  // A joint gap of 1.2 mm on either side.
  const auto widened = [](ImplicitSolid solid) {
    return ImplicitSolid{[solid](const Vec3& p) { return solid.distance(p) - 0.0012; }, solid.bounds};
  };
  const ImplicitSolid right = widened(right_hip_bone), left = mirrored_in_z(right, median_plane);
  return smooth_difference(smooth_difference(whole, right, 0.002), left, 0.002);
}

}  // namespace gracilis::builtin_hip_shapes
