#include <gracilis/scene/attached_vertices.hpp>
#include <gracilis/simulate/attachment_zone.hpp>
#include <gracilis/simulate/measures.hpp>
#include <gracilis/simulate/surface_flaws.hpp>

#include <scenes_for_tests.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace gracilis {
namespace {

/// A spindle along x, 200 mm long and 40 mm wide, with both ends attached.
Scene spindle() {
  Scene scene;
  scene.bodies = {"ground"};
  Muscle muscle;
  muscle.name = "spindle";
  muscle.surface = shapes::sphere({0, 0, 0}, 0.02, 4);
  muscle.surface.vertices.row(0) *= 5;
  const Points& x = muscle.surface.vertices;
  std::vector<Index> left, right;
  for (Index v = 0; v < x.cols(); ++v) {
    if (x(0, v) < -0.09) left.push_back(v);
    if (x(0, v) > 0.09) right.push_back(v);
  }
  muscle.attachments = {{"left", AttachmentEnd::origin, 0, left, false},
                        {"right", AttachmentEnd::insertion, 0, right, false}};
  scene.muscles = {muscle};
  return scene;
}

/// The gates of shape that these points miss.
std::vector<std::string> missed_by(const Points& points) {
  const Scene scene = spindle();
  Frame frame;
  frame.pose.bodies = {RigidTransform::Identity()};
  frame.muscles = {{points}};
  MuscleMeasures measures = Measurer(scene, nullptr, MeasureLevel::light).measure(frame).at(0);
  measures.volume_ratio = 1;  // of crafted shapes it is what it may
  return missed_gates(measures, {});
}

const Points rest = spindle().muscles[0].surface.vertices;

/// The vertex nearest to a place.
Index vertex_at(const Vec3& place) {
  Index nearest = 0;
  (rest.colwise() - place).colwise().squaredNorm().minCoeff(&nearest);
  return nearest;
}

}  // namespace

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(GatesOfShape, pass_what_muscles_do) {
  EXPECT_THAT(missed_by(rest), IsEmpty());
  Points points = rest;
  points.row(0) *= 0.6, points.bottomRows(2) *= 1.3;
  EXPECT_THAT(missed_by(points), IsEmpty()) << "it contracts and bulges";
  points = rest, points.row(0) *= 1.8, points.bottomRows(2) *= 0.75;
  EXPECT_THAT(missed_by(points), IsEmpty()) << "it is drawn out";
  points = rest, points.row(1) *= 0.5, points.row(2) *= 1.5;
  EXPECT_THAT(missed_by(points), IsEmpty()) << "it lies flat";
  for (Index v = 0; v < rest.cols(); ++v) {  // it bends by 120 degrees around something
    const Real radius = 0.09, angle = rest(0, v) / radius;
    points.col(v) << (radius + rest(1, v)) * std::sin(angle), (radius + rest(1, v)) * std::cos(angle), rest(2, v);
  }
  EXPECT_THAT(missed_by(points), IsEmpty());
}

TEST(GatesOfShape, see_a_spike) {
  Points points = rest;
  points(1, vertex_at({0, 0.02, 0})) += 0.03;
  EXPECT_THAT(missed_by(points), Contains(HasSubstr("a vertex stands out")));
  points = rest, points(1, vertex_at({0, 0.02, 0})) += 0.003;
  EXPECT_THAT(missed_by(points), IsEmpty()) << "a bump";
}

TEST(GatesOfShape, see_a_fin_at_an_attachment) {
  // A ridge of vertices beside the attachment is drawn out sidewards, and those around it half as far.
  Points points = rest;
  for (Index v = 0; v < rest.cols(); ++v) {
    const Real along = std::abs(rest(0, v) - 0.084) / 0.006, beside = std::abs(rest(2, v)) / 0.006;
    if (rest(1, v) > 0) points(1, v) += 0.05 * std::max(0.0, 1 - along) * std::max(0.0, 1 - beside);
  }
  EXPECT_THAT(missed_by(points), Contains(HasSubstr("near an attachment stretched")));
}

TEST(GatesOfShape, see_a_rim_like_a_mushrooms) {
  // Smooth and round: around x = 60 mm four times as thick as at rest.
  Points points = rest;
  for (Index v = 0; v < rest.cols(); ++v) {
    const Real factor = 1 + 3 * std::exp(-std::pow((rest(0, v) - 0.06) / 0.015, 2));
    points.col(v).tail(2) *= factor;
  }
  EXPECT_THAT(missed_by(points), Contains(HasSubstr("times as thick as at rest")));
}

TEST(GatesOfShape, see_a_belly_pressed_to_a_sheet) {
  Points points = rest;
  for (Index v = 0; v < rest.cols(); ++v) points(1, v) *= 1 - 0.97 * std::exp(-std::pow(rest(0, v) / 0.03, 2));
  EXPECT_THAT(missed_by(points), Contains(HasSubstr("times as thin as at rest")));
}

TEST(GatesOfShape, are_a_map_that_is_highest_where_the_flaw_is) {
  Points points = rest;
  const Index tip = vertex_at({0.02, 0.02, 0});
  points(1, tip) += 0.03;
  const SurfaceFlaws flaws(spindle().muscles[0].surface);
  const std::vector<char> near(static_cast<std::size_t>(rest.cols()), 0);
  const std::vector<Real> shares = flaws.shares_of_gates(points, near, {});
  EXPECT_EQ(std::max_element(shares.begin(), shares.end()) - shares.begin(), tip);
  EXPECT_GT(shares[static_cast<std::size_t>(tip)], 1);
  for (const Real share : flaws.shares_of_gates(rest, near, {})) EXPECT_EQ(share, 0);
}

TEST(GatesOfShape, are_a_map_that_judges_edges_as_the_gates_do) {
  const Scene scene = spindle();
  const SurfaceFlaws flaws(scene.muscles[0].surface);
  const std::vector<char> held = attached_vertices(scene.muscles[0]);
  std::vector<Index> attached;
  for (Index v = 0; v < rest.cols(); ++v)
    if (held[static_cast<std::size_t>(v)]) attached.push_back(v);
  ASSERT_FALSE(attached.empty());
  const std::vector<char> near = near_attachments(rest, attached);
  // Drawn out as a whole, so that edges alone tell: they are 4 times as long.
  const Points points = 4 * rest;
  QualityGates edges_alone;
  edges_alone.spike = edges_alone.thickening = edges_alone.thinning = 1e9;
  const std::vector<Real> shares = flaws.shares_of_gates(points, near, edges_alone);
  for (Index v = 0; v < rest.cols(); ++v) {
    const Real to_attached = (rest(Eigen::all, attached).colwise() - rest.col(v)).colwise().norm().minCoeff();
    const Real share = shares[static_cast<std::size_t>(v)];
    if (to_attached < 0.01) {
      EXPECT_LT(share, 1) << "limit 5";
    } else if (to_attached > 0.03) {
      EXPECT_NEAR(share, 1.5, 0.01) << "limit 3";
    }
  }
}

}  // namespace gracilis
