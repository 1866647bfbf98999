#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/mesh_inspection.hpp>
#include <gracilis/prepare/prepare_surfaces.hpp>
#include <gracilis/prepare/solids.hpp>

#include "shapes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

/// Muscles thinner or smaller than triangles: sheets, folds, rings and those of the ear.
namespace gracilis {
namespace {

using shapes::mm;

TriangleMesh prepared(const TriangleMesh& mesh) {
  return prepare_surfaces({{"muscle", mesh}}, {}, PrepareSettings(), [](const std::string&) {}).muscles.front();
}

constexpr Real asked_for = 0.006;  ///< of volumes: 0.005 by default, and what rounding adds
constexpr Real promised = 0.02;    ///< of volumes of whole muscles, where more cannot be reached

/// Sound, with the volume of what it was made of, in about as many triangles as edges of that length (m) make.
void expect_kept(const TriangleMesh& result, const TriangleMesh& mesh, Real edge_length, Real volume_error) {
  EXPECT_TRUE(is_solid(result));
  EXPECT_FALSE(cuts_itself(result, TimeLimit()));
  EXPECT_NEAR(volume_of(result) / volume_of(mesh), 1, volume_error);
  const Real triangles = surface_area(mesh.vertices, mesh.faces) / (std::sqrt(3.0) / 4 * edge_length * edge_length);
  EXPECT_LT(result.face_count(), 2 * triangles);
}

/// A closed strip along a curve in the plane of x and z, of that thickness and width (m).
template <typename Curve>
TriangleMesh strip(const Curve& curve, int steps, Real thickness, Real width) {
  constexpr int across = 8;
  std::vector<Vec3> v;
  std::vector<Eigen::Vector3i> f;
  const auto square = [&](int a, int b, int c, int d) { f.insert(f.end(), {{a, b, c}, {a, c, d}}); };
  for (int i = 0; i <= steps; ++i) {
    const Vec3 along = curve((i + 0.5) / steps) - curve((i - 0.5) / steps);
    const Vec3 out = Vec3(-along.z(), 0, along.x()).normalized() * thickness / 2;
    for (const Real side : {-1.0, 1.0})
      for (int j = 0; j <= across; ++j)
        v.emplace_back(curve(Real(i) / steps) + side * out + Vec3(0, width * j / across, 0));
  }
  const auto at = [&](int i, int side, int j) { return (2 * i + side) * (across + 1) + j; };
  for (int i = 0; i < steps; ++i) {
    for (int j = 0; j < across; ++j) {
      square(at(i, 0, j), at(i, 0, j + 1), at(i + 1, 0, j + 1), at(i + 1, 0, j));
      square(at(i, 1, j), at(i + 1, 1, j), at(i + 1, 1, j + 1), at(i, 1, j + 1));
    }
    square(at(i, 0, 0), at(i + 1, 0, 0), at(i + 1, 1, 0), at(i, 1, 0));
    square(at(i, 0, across), at(i, 1, across), at(i + 1, 1, across), at(i + 1, 0, across));
  }
  for (int j = 0; j < across; ++j) {
    square(at(0, 0, j), at(0, 1, j), at(0, 1, j + 1), at(0, 0, j + 1));
    square(at(steps, 0, j), at(steps, 0, j + 1), at(steps, 1, j + 1), at(steps, 1, j));
  }
  TriangleMesh mesh = shapes::mesh_of(v, f);
  if (volume_of(mesh) < 0) mesh.faces.row(0).swap(mesh.faces.row(1));
  return mesh;
}

TEST(ThinMuscles, a_sheet_stays_as_thin_and_keeps_its_volume_in_triangles_of_the_size_asked_for) {
  const auto wave = [](Real t) { return Vec3(50 * mm * t, 0, 5 * mm * std::sin(4 * t)); };
  const TriangleMesh sheet = strip(wave, 20, 1 * mm, 30 * mm);
  expect_kept(prepared(sheet), sheet, 3 * mm, asked_for);
}

TEST(ThinMuscles, folds_closer_than_a_triangle_is_long_stay_apart) {
  // A sheet of 2 mm bent back over itself, 0.7 mm apart.
  const auto bent = [](Real t) {
    const Real straight = 30 * mm, radius = 1.35 * mm, bow = std::numbers::pi * radius;
    const Real s = t * (2 * straight + bow);
    if (s < straight) return Vec3(s, 0, 0);
    if (s > straight + bow) return Vec3(2 * straight + bow - s, 0, 2 * radius);
    const Real angle = (s - straight) / radius;
    return Vec3(straight + radius * std::sin(angle), 0, radius * (1 - std::cos(angle)));
  };
  const TriangleMesh folded = strip(bent, 60, 2 * mm, 24 * mm);
  ASSERT_FALSE(cuts_itself(folded, TimeLimit()));
  expect_kept(prepared(folded), folded, 1.8 * mm, promised);
}

TEST(ThinMuscles, a_muscle_of_five_millimetres_has_triangles_enough_for_its_shape) {
  TriangleMesh stapedius = shapes::sphere(Vec3::Zero(), 1, 2);
  stapedius.vertices.row(0) *= 2.5 * mm;
  stapedius.vertices.bottomRows(2) *= 0.6 * mm;
  const TriangleMesh result = prepared(stapedius);
  EXPECT_TRUE(is_solid(result));
  EXPECT_NEAR(volume_of(result) / volume_of(stapedius), 1, 0.006);
  EXPECT_GT(result.face_count(), 200);
  EXPECT_LT(result.face_count(), 4000);
}

TEST(ThinMuscles, a_strip_in_triangles_of_the_right_size_keeps_its_volume_where_its_rims_are_rounded) {
  const auto straight = [](Real t) { return Vec3(60 * mm * t, 0, 0); };
  const TriangleMesh flat = strip(straight, 21, 1.2 * mm, 24 * mm);
  expect_kept(prepared(flat), flat, 3 * mm, asked_for);
}

}  // namespace
}  // namespace gracilis
