#include <gracilis/geometry/box_mesh.hpp>
#include <gracilis/geometry/gradient_fit.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/opposite_vertices.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace gracilis {
namespace {

/// A slab, 200 x 60 x 20 mm, its ends in x fixed.
struct Slab {
  TriangleMesh rest = box_mesh(Vec3(0, 0, 0), Vec3(0.2, 0.06, 0.02), {40, 12, 4});
  std::vector<char> is_fixed;
  Eigen::VectorXd trust = Eigen::VectorXd::Ones(rest.vertices.cols());
  std::vector<Eigen::Matrix3d> gradients{static_cast<std::size_t>(rest.vertex_count()), Eigen::Matrix3d::Identity()};

  Slab() {
    for (Index v = 0; v < rest.vertex_count(); ++v)
      is_fixed.push_back(rest.vertices(0, v) < 1e-9 || rest.vertices(0, v) > 0.2 - 1e-9);
  }
  Points fitted(const Points& places, Real smoothing = 0.02, Index largest_factorized = 30000) const {
    return GradientFit(rest, is_fixed, trust, smoothing, largest_factorized)
        .fitted(GradientFit::Aim{places, gradients});
  }
  /// Places that waver by so much (m) from vertex to vertex.
  Points wavering(Real by) const {
    Points places = rest.vertices;
    for (Index v = 0; v < places.cols(); ++v)
      if (!is_fixed[static_cast<std::size_t>(v)]) places(2, v) += by * (v % 2 == 0 ? 1 : -1);
    return places;
  }
};

TEST(GradientFit, places_that_agree_with_the_gradients_are_kept) {
  Slab slab;
  const Eigen::Matrix3d gradient =
      Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix() * Vec3(1.3, 0.8, 0.9).asDiagonal();
  slab.gradients.assign(slab.gradients.size(), gradient);
  const Points places = (gradient * slab.rest.vertices).colwise() + Vec3(1, 2, 3);
  EXPECT_LT((slab.fitted(places) - places).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(GradientFit, fixed_vertices_stay_and_wavering_places_are_smoothed) {
  const Slab slab;
  const Points places = slab.wavering(0.001), fitted = slab.fitted(places);
  for (Index v = 0; v < fitted.cols(); ++v)
    if (slab.is_fixed[static_cast<std::size_t>(v)]) {
      EXPECT_EQ(fitted.col(v), places.col(v));
    }
  EXPECT_LT((fitted - slab.rest.vertices).cwiseAbs().maxCoeff(), 2e-4) << "of 1 mm";
}

TEST(GradientFit, what_is_longer_than_the_smoothing_length_is_followed) {
  const Slab slab;
  Points places = slab.rest.vertices;
  for (Index v = 0; v < places.cols(); ++v) places(2, v) += 0.01 * std::sin(pi * places(0, v) / 0.2);
  const Points near = slab.fitted(places, 0.005), far = slab.fitted(places, 0.1);
  EXPECT_LT((near - places).cwiseAbs().maxCoeff(), 0.0005);
  EXPECT_GT((far - places).cwiseAbs().maxCoeff(), 0.005);
}

TEST(GradientFit, without_trust_a_shift_of_an_end_is_shared_out_evenly) {
  Slab slab;
  slab.trust.setZero();
  Points places = slab.rest.vertices;
  for (Index v = 0; v < places.cols(); ++v)
    if (places(0, v) > 0.2 - 1e-9) places(0, v) += 0.02;
  const Points fitted = slab.fitted(places);
  for (Index v = 0; v < fitted.cols(); ++v)
    EXPECT_NEAR(fitted(0, v), 1.1 * slab.rest.vertices(0, v), 0.0005) << "stretched alike everywhere";
}

TEST(GradientFit, a_thin_body_keeps_its_thickness) {
  Slab slab;
  // One face alone is said to have moved: the other comes along, since they are linked through the body.
  Points places = slab.rest.vertices;
  for (Index v = 0; v < places.cols(); ++v)
    if (!slab.is_fixed[static_cast<std::size_t>(v)] && places(2, v) > 0.02 - 1e-9) places(2, v) += 0.01;
  const Points fitted = slab.fitted(places);
  const Real volume = enclosed_volume(slab.rest.vertices, slab.rest.faces);
  EXPECT_GT(enclosed_volume(places, slab.rest.faces) / volume, 1.4);
  EXPECT_LT(enclosed_volume(fitted, slab.rest.faces) / volume, 1.15);
}

TEST(GradientFit, a_part_that_nothing_holds_stays_finite) {
  Slab slab;
  slab.trust.setZero();
  slab.is_fixed.assign(slab.is_fixed.size(), 0);
  EXPECT_LT((slab.fitted(slab.rest.vertices) - slab.rest.vertices).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(GradientFit, conjugate_gradients_find_what_the_factorization_does) {
  const Slab slab;
  const Points places = slab.wavering(0.002);
  EXPECT_LT((slab.fitted(places) - slab.fitted(places, 0.02, 0)).cwiseAbs().maxCoeff(), 2e-6);
}

TEST(GradientFit, of_two_aims_each_is_fitted_as_alone) {
  const Slab slab;
  const GradientFit::Aim first{slab.wavering(0.002), slab.gradients};
  const GradientFit::Aim second{1.1 * first.places, {slab.gradients.size(), 1.2 * Eigen::Matrix3d::Identity()}};
  GradientFit::AimOf<6> both{Eigen::Matrix<Real, 6, Eigen::Dynamic>(6, first.places.cols()), {}};
  both.places << first.places, second.places;
  for (std::size_t v = 0; v < first.gradients.size(); ++v)
    both.gradients.emplace_back() << first.gradients[v], second.gradients[v];
  for (const Index largest_factorized : {30000, 0}) {
    const GradientFit fit(slab.rest, slab.is_fixed, slab.trust, 0.02, largest_factorized);
    const auto fitted = fit.fitted(both);
    const Points one = fitted.topRows<3>(), other = fitted.bottomRows<3>();
    EXPECT_EQ(one, fit.fitted(first));
    EXPECT_EQ(other, fit.fitted(second));
    EXPECT_NE(one, other);
  }
}

TEST(OppositeVertices, of_a_slab_lie_across_its_thickness) {
  const TriangleMesh slab = Slab().rest;
  const std::vector<Index> opposite = opposite_vertices(slab);
  for (Index v = 0; v < slab.vertex_count(); ++v) {
    const Vec3 place = slab.vertices.col(v);
    if (place.z() > 1e-9 || place.x() < 0.01 || place.x() > 0.19 || place.y() < 0.01 || place.y() > 0.05) continue;
    ASSERT_GE(opposite[static_cast<std::size_t>(v)], 0);
    const Vec3 other = slab.vertices.col(opposite[static_cast<std::size_t>(v)]);
    EXPECT_NEAR(other.z(), 0.02, 1e-9);
    EXPECT_LT((other - place).head<2>().norm(), 0.006);
  }
}

TEST(OppositeVertices, an_open_sheet_has_none) {
  TriangleMesh sheet;
  sheet.vertices.resize(3, 3), sheet.faces.resize(3, 1);
  sheet.vertices << 0, 1, 0, 0, 0, 1, 0, 0, 0;
  sheet.faces << 0, 1, 2;
  for (const Index other : opposite_vertices(sheet)) EXPECT_EQ(other, -1);
}

}  // namespace
}  // namespace gracilis
