#pragma once

#include "drafted_scene.hpp"

#include <gracilis/geometry/surface_extraction.hpp>
#include <gracilis/io/mesh/mesh_writer.hpp>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

/// A spine of vertebrae with arches and processes, thin but with all that a joint is found by: discs' gaps of a known
/// height at known places. Forward is x, up y, right z; m.
namespace gracilis::made_spine {

inline constexpr Real gap = 0.008;  ///< between end plates

inline TriangleMesh surface_of(const ImplicitSolid& solid) {
  return largest_component(extract_surface(sample(solid, 0.0025)));
}

/// A body with flat end plates about `middle`, an arch, a spinous process and two transverse ones, turned by `tilt`
/// (rad) about the right: positive leans it back.
inline TriangleMesh vertebra(const Vec3& middle, Real height, Real radius, Real tilt = 0) {
  const auto slab = [&](Real y, Real up) {
    return half_space(Vec3(0, y, 0), Vec3(0, up, 0), Eigen::AlignedBox3d(Vec3::Constant(-0.1), Vec3::Constant(0.1)));
  };
  const Real half = height / 2, r = radius;
  const ImplicitSolid column = thick_curve({{Vec3(0, -2 * half, 0), r}, {Vec3(0, 2 * half, 0), r}});
  const ImplicitSolid body =
      smooth_intersection(smooth_intersection(column, slab(half, 1), 0.002), slab(-half, -1), 0.002);
  const ImplicitSolid whole = smooth_union(
      {body, thick_curve({{Vec3(-0.8 * r, 0, 0), 0.006}, {Vec3(-2.2 * r, -0.2 * height, 0), 0.004}}),
       thick_curve(
           {{Vec3(-0.8 * r, 0, -2 * r), 0.004}, {Vec3(-0.9 * r, 0, 0), 0.006}, {Vec3(-0.8 * r, 0, 2 * r), 0.004}})},
      0.003);
  TriangleMesh mesh = surface_of(whole);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(tilt, Vec3::UnitZ()).toRotationMatrix();
  for (auto point : mesh.vertices.colwise()) point = (turn * point + middle).eval();
  return mesh;
}

inline TriangleMesh rod(const std::vector<ThickPoint>& points) { return surface_of(thick_curve(points)); }

inline void write(const std::filesystem::path& file, const TriangleMesh& mesh) {
  std::filesystem::create_directories(file.parent_path());
  write_surface(file, mesh.vertices, mesh.faces);
}

inline constexpr Real height = 0.028, radius = 0.022, lowest = 1.04;  ///< of lumbar vertebrae; of L5's middle

/// The middle of L5, L4 and so on: an upright column.
inline Vec3 middle_of(int level) { return Vec3(0, lowest + level * (height + gap), 0); }

inline TriangleMesh sacrum() { return vertebra(middle_of(-1), height, radius); }

/// Along the back, close to the spinous processes.
inline TriangleMesh back_muscle(Real from, Real to) {
  const Real x = -0.056, z = 0.016;
  return rod({{Vec3(x, from, z), 0.006}, {Vec3(x, (from + to) / 2, z), 0.01}, {Vec3(x, to, z), 0.006}});
}

/// Sacrum, lumbar vertebrae, T12 with a rib, and a back muscle from end to end.
inline void write_trunk(const std::filesystem::path& folder) {
  write(folder / "sacrum.vtp", sacrum());
  for (int level = 0; level < 5; ++level)
    write(folder / ("L" + std::to_string(5 - level) + ".vtp"), vertebra(middle_of(level), height, radius));
  write(folder / "T12.vtp", vertebra(middle_of(5), height, radius));
  const Real y = middle_of(5).y();
  write(folder / "rib_12_r.vtp", rod({{Vec3(-0.03, y, 0.03), 0.005}, {Vec3(-0.02, y - 0.02, 0.1), 0.005}}));
  write(folder / "erector_spinae_r.vtp", back_muscle(middle_of(-1).y() - 0.01, y + 0.01));
}

}  // namespace gracilis::made_spine
