#include <gracilis/dynamics/contact/surface/surface_ties.hpp>

#include <gtest/gtest.h>

namespace gracilis {
namespace {

Points triangle() {
  Points corners(3, 3);
  corners << 0, 0.03, 0, 0, 0, 0.03, 0, 0, 0;
  return corners;
}

/// A triangle in z = 0, 30 mm wide, and a particle 2 mm above its middle.
struct TiedPoint {
  Particles host = make_particles(triangle(), Eigen::Vector3d(2, 1, 0.5));
  Particles guest = make_particles(Points(Vec3(0.01, 0.01, 0.002)), Eigen::VectorXd::Constant(1, 4));
  std::vector<TiedSurfaces> ties = {tied()};

  TiedSurfaces tied() const {
    TiedSurfaces result;
    result.guest = 0, result.host = 1;
    const Eigen::Vector3f third = Eigen::Vector3f::Constant(1.0f / 3);
    result.ties = {{0, {0, 1, 2}, third, {0, 0, 0.002f}}};
    result.patch = {0, 1, 2};
    result.patch_rest.resize(3, 3);
    for (Index i = 0; i < 3; ++i) result.patch_rest.col(i) = host.position(i);
    result.patch_rest.colwise() -= Eigen::Vector3f(result.patch_rest.rowwise().mean());
    return result;
  }

  void project(const Movers& movers = {}) { project_ties(ties, {&guest, &host}, movers); }
  Eigen::Vector3f middle() const { return (host.position(0) + host.position(1) + host.position(2)) / 3; }
};

TEST(SurfaceTies, at_rest_nothing_moves) {
  TiedPoint tied;
  tied.project();
  EXPECT_LT((tied.guest.position(0) - Eigen::Vector3f(0.01f, 0.01f, 0.002f)).norm(), 1e-8f);
  EXPECT_LT((tied.host.position(1) - Eigen::Vector3f(0.03f, 0, 0)).norm(), 1e-8f);
}

TEST(SurfaceTies, one_projection_brings_the_particle_to_its_place_and_keeps_momentum) {
  TiedPoint tied;
  tied.guest.position(0) += Eigen::Vector3f(0.001f, -0.002f, 0.004f);
  const auto momentum = [&] {
    Eigen::Vector3f sum = tied.guest.position(0) / tied.guest.inverse_mass(0);
    for (Index i = 0; i < 3; ++i) sum += tied.host.position(i) / tied.host.inverse_mass(i);
    return sum;
  };
  const Eigen::Vector3f before = momentum();
  tied.project();
  EXPECT_LT((momentum() - before).norm(), 1e-7f);
  // The triangle turns a little as its corners give way unequally.
  EXPECT_LT((tied.guest.position(0) - tied.middle()).norm() - 0.002f, 1e-6f);
  EXPECT_GT((tied.middle() - Eigen::Vector3f(0.01f, 0.01f, 0)).norm(), 1e-4f);
}

TEST(SurfaceTies, a_corner_with_a_small_share_beside_fixed_ones_goes_twice_the_way_that_is_missing_at_most) {
  TiedPoint tied;
  tied.host = make_particles(triangle(), Eigen::Vector3d(0, 1, 0));
  tied.guest = make_particles(Points(Vec3(0.0003, 0.01, 0)), Eigen::VectorXd::Zero(1));
  tied.ties[0].ties = {{0, {0, 1, 2}, {0.66f, 0.01f, 0.33f}, {0, 0, 0}}};
  const Eigen::Vector3f before = tied.host.position(1);
  tied.guest.position(0).z() += 0.001f;
  tied.project();
  EXPECT_GT(tied.host.position(1).z(), 0);
  EXPECT_LE((tied.host.position(1) - before).norm(), 2.1e-3f) << "its share is a hundredth, 1 mm is missing";
}

TEST(SurfaceTies, the_offset_turns_with_the_patch) {
  TiedPoint tied;
  const Eigen::Matrix3f quarter = Eigen::AngleAxisf(static_cast<float>(pi / 2), Eigen::Vector3f::UnitX()).matrix();
  for (Index i = 0; i < 3; ++i) tied.host.position(i) = quarter * tied.host.position(i);
  place_on_host(tied.ties[0], tied.host, tied.guest);
  EXPECT_LT((tied.guest.position(0) - quarter * Eigen::Vector3f(0.01f, 0.01f, 0.002f)).norm(), 1e-7f);
}

TEST(SurfaceTies, what_does_not_move_is_not_moved) {
  TiedPoint tied;
  tied.guest.position(0) += Eigen::Vector3f(0, 0, 0.01f);
  const Particles host = tied.host;
  tied.project({{1, 0}});
  EXPECT_EQ(tied.host.xyzw, host.xyzw);
  EXPECT_LT((tied.guest.position(0) - Eigen::Vector3f(0.01f, 0.01f, 0.002f)).norm(), 1e-7f);
  const Particles guest = tied.guest;
  tied.host.position(0) += Eigen::Vector3f(0, 0, 0.003f);
  tied.project({{0, 0}});
  EXPECT_EQ(tied.guest.xyzw, guest.xyzw);
}

}  // namespace
}  // namespace gracilis
