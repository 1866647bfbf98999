#include <gracilis/anatomy/builtin/builtin_hip_sacrum.hpp>

#include <gracilis/geometry/implicit_surface_spline.hpp>

namespace gracilis::builtin_hip_shapes {

namespace {

constexpr Real m = 1e3 * median_plane;

/// One row of a symmetric net: its middle point, how far it reaches to the sides, how far the sides lie behind and
/// above the middle, and the radii; mm.
struct Row {
  Real x, y, half_width, back, up, middle, edge;
};

template <std::size_t rows>
ThickNet symmetric_net(const Row (&table)[rows]) {
  ThickNet net{static_cast<int>(rows), 5, {}};
  for (const Row& row : table)
    for (int column = -2; column <= 2; ++column) {
      const Real side = column / 2.0, s2 = side * side;
      net.points.push_back(thick(row.x - row.back * s2, row.y + row.up * s2, m + side * row.half_width,
                                 row.middle + (row.edge - row.middle) * s2));
    }
  return net;
}

/// From the wings of the first segment down to the tip of the coccyx, with the flat plate that carries the spine.
ImplicitSolid shield() {
  const ImplicitSolid sheet = thick_sheet(symmetric_net({{-12, 98, 48, 14, -6, 14, 10},
                                                         {-34, 80, 45, 0, 0, 13, 9},
                                                         {-56, 58, 39, -2, 2, 10, 7.5},
                                                         {-70, 36, 33, 2, 3, 8.5, 6},
                                                         {-76, 17, 24, -1, 2, 7, 5},
                                                         {-75, -4, 8, -2, 0, 5, 4},
                                                         {-66, -22, 3.5, 0, 0, 4, 3}}));
  const ImplicitSolid body = thick_curve({thick(-14, 99, m - 10, 17), thick(-14, 99, m + 10, 17)});
  const ImplicitSolid both = smooth_union({sheet, body}, 0.006);
  return smooth_intersection(both, half_space(millimetres(-9, 110, m), Vec3(0.55, 0.83, 0), both.bounds), 0.004);
}

/// Behind the canal: the arches with their median ridge and, at the top, the two joint processes.
ImplicitSolid arches() {
  const Row rows[] = {
      {-44, 106, 24, -4, 0, 8, 8}, {-62, 86, 21, -4, 0, 8, 7}, {-75, 60, 17, -4, 0, 7, 6}, {-82, 36, 11, -3, 0, 6, 5}};
  std::vector<ImplicitSolid> parts = {thick_sheet(symmetric_net(rows))};
  for (const Row& row : rows)
    parts.push_back(thick_curve({thick(row.x - 4, row.y + 4, m, 6), thick(row.x - 8, row.y - 2, m, 5)}));
  for (int side : {-1, 1})
    parts.push_back(thick_curve({thick(-36, 104, m + side * 21, 8), thick(-39, 119, m + side * 22, 6.5)}));
  return smooth_union(parts, 0.006);
}

/// Pits where the nerves leave, in front and behind.
ImplicitSolid nerve_pits() {
  std::vector<ImplicitSolid> pits;
  const Vec3 front[] = {millimetres(-8, 84, m), millimetres(-36, 64, m), millimetres(-54, 42, m),
                        millimetres(-62, 22, m)};
  const Vec3 behind[] = {millimetres(-60, 98, m), millimetres(-75, 74, m), millimetres(-87, 48, m),
                         millimetres(-90, 24, m)};
  for (int side : {-1, 1})
    for (int level = 0; level < 4; ++level) {
      const Vec3 beside = millimetres(0, 0, side * (20 - 2.5 * level));
      pits.push_back(ball(front[level] + beside, 0.0065));
      pits.push_back(ball(behind[level] + beside, 0.0055));
    }
  return smooth_union(pits, 0.002);
}

}  // namespace

ImplicitSolid sacrum(const ImplicitSolid& right_hip_bone) {
  const ImplicitSolid whole = smooth_difference(smooth_union({shield(), arches()}, 0.008), nerve_pits(), 0.004);
  // A joint gap of 1.2 mm on either side.
  const ImplicitSolid right{[right_hip_bone](const Vec3& p) { return right_hip_bone.distance(p) - 0.0012; },
                            right_hip_bone.bounds};
  return smooth_difference(smooth_difference(whole, right, 0.002), mirrored_in_z(right, median_plane), 0.002);
}

}  // namespace gracilis::builtin_hip_shapes
