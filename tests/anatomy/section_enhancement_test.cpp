#include <gracilis/anatomy/sections/enhancement.hpp>
#include <gracilis/anatomy/sections/surface_slices.hpp>
#include <gracilis/geometry/section_frames.hpp>
#include <gracilis/geometry/signed_distance.hpp>

#include <shaped_hip.hpp>
#include <shapes.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace gracilis {

static Eigen::VectorXd even_angles(int rays) { return Eigen::VectorXd::LinSpaced(rays + 1, 0, 2 * pi).head(rays); }

static SectionCut cut_at_origin(const TriangleMesh& mesh) { return {mesh, Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY()}; }

/// A tube bent like a bow, away from the straight line between its ends.
static TriangleMesh bow(Points& line) {
  line.resize(3, 33);
  for (int i = 0; i <= 32; ++i) line.col(i) = Vec3(0.03 * std::sin(pi * i / 32), 0, 0.2 * i / 32);
  const SectionFrames frames = section_frames(line, Vec3::UnitY());
  return {section_vertices(line, frames, Eigen::MatrixXd::Constant(24, 33, 0.01)), section_faces(33, 24)};
}

TEST(SectionCut, a_ray_enters_at_front_faces_and_leaves_at_back_faces) {
  const SectionCut cut = cut_at_origin(shapes::box({0.02, -0.01, -0.05}, {0.05, 0.01, 0.05}));
  const std::vector<RayHit> hits = cut.hits({0, 0.003}, {1, 0});
  ASSERT_EQ(hits.size(), 2u);
  EXPECT_NEAR(hits[0].distance, 0.02, 1e-15);
  EXPECT_FALSE(hits[0].back);
  EXPECT_NEAR(hits[1].distance, 0.05, 1e-15);
  EXPECT_TRUE(hits[1].back);
  EXPECT_THAT(cut.hits({0, 0.003}, {-1, 0}), testing::IsEmpty());
  EXPECT_TRUE(cut.contains({0.03, 0.002}));
  EXPECT_FALSE(cut.contains({0, 0}));
}

TEST(SectionCut, a_plane_through_vertices_is_met_as_often_from_the_front_as_from_behind) {
  const SectionCut cut = cut_at_origin(shapes::sphere(Vec3::Zero(), 0.03, 2));  // the plane holds a ring of vertices
  for (int i = 0; i < 100; ++i) {
    const Real angle = 0.0628 * i;
    const std::vector<RayHit> hits = cut.hits({-0.1, 0.0003 * i}, {std::cos(0.1 * angle), std::sin(0.1 * angle)});
    int balance = 0;
    for (const RayHit& hit : hits) balance += hit.back ? 1 : -1;
    EXPECT_EQ(balance, 0) << i;
  }
}

TEST(SectionCut, outlines_close_and_run_counterclockwise) {
  const SectionCut cut = cut_at_origin(shapes::box({0.02, -0.01, -0.05}, {0.05, 0.01, 0.05}));
  ASSERT_EQ(cut.outlines().size(), 1u);
  const Eigen::Matrix2Xd outline = cut.outlines()[0];
  Real twice = 0;
  for (Eigen::Index i = 0; i < outline.cols(); ++i) {
    const Eigen::Vector2d a = outline.col(i), b = outline.col((i + 1) % outline.cols());
    twice += a.x() * b.y() - a.y() * b.x();
  }
  EXPECT_NEAR(twice / 2, 0.03 * 0.02, 1e-15);
}

TEST(SurfaceSlices, lie_across_the_longest_axis_and_know_their_shape) {
  const std::vector<SurfaceSlice> box = surface_slices(shapes::box({-0.01, -0.1, -0.01}, {0.01, 0.1, 0.01}), 3);
  ASSERT_EQ(box.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(box[k].place, 0.05 * static_cast<Real>(k + 1), 1e-12);
  for (const SurfaceSlice& slice : box) {
    EXPECT_EQ(slice.outlines, 1);
    EXPECT_NEAR(slice.shape.area, 4e-4, 1e-12);
    EXPECT_NEAR(slice.shape.quotient, pi / 4, 1e-9);
    EXPECT_TRUE(slice.shape.convex);
  }
  Points middle;
  const std::vector<SurfaceSlice> tube = surface_slices(bow(middle), 1);
  EXPECT_NEAR(tube[0].shape.quotient, 0.994, 2e-3);  // 24 corners
  EXPECT_NEAR(tube[0].outline.rowwise().mean().norm(), 0, 1e-3);
}

TEST(SectionFrames, planes_look_along_both_neighbors_or_the_next_one_or_down) {  // Figure 3.9
  Points line(3, 3);
  line.col(0) = Vec3(0, 0, 0);
  line.col(1) = Vec3(0, -1, 0);
  line.col(2) = Vec3(1, -1, 0);
  const Vec3 down(0, -1, 0), across(1, 0, 0), between = Vec3(1, -1, 0).normalized();
  const auto normals = [&](SectionPlanes planes) { return section_frames(line, Vec3::UnitZ(), planes).normals; };
  Points centered(3, 3), forward(3, 3), fixed(3, 3);
  centered << down, between, across;
  forward << down, across, across;
  fixed << down, down, down;
  EXPECT_TRUE(normals(SectionPlanes::centered).isApprox(centered));
  EXPECT_TRUE(normals(SectionPlanes::forward).isApprox(forward));
  EXPECT_TRUE(normals(SectionPlanes::fixed).isApprox(fixed));
  EXPECT_TRUE(section_frames(line, Vec3::UnitZ()).normals.isApprox(centered));
}

TEST(Enhancement, the_surface_is_cut_by_the_planes_that_are_asked_for) {
  Points middle;
  const TriangleMesh surface = bow(middle);
  const auto corners_off_their_height = [&](SectionPlanes planes) {
    EnhancementSettings settings;
    settings.planes = planes;
    Points turned(3, middle.cols());  // the bow goes down
    turned << middle.row(0), -middle.row(2), middle.row(1);
    TriangleMesh down = surface;
    down.vertices << surface.vertices.row(0), -surface.vertices.row(2), surface.vertices.row(1);
    const EnhancedSections sections =
        enhance(turned, Vec3::UnitX(), Eigen::MatrixXd::Constant(8, turned.cols(), 0.005), down, settings);
    Real most = 0;
    for (Eigen::Index k = 1; k + 1 < turned.cols(); ++k)
      for (Eigen::Index i = 0; i < 8; ++i)
        most = std::max(most, std::abs(sections.radii(i, k) * sections.frames.ray(k, i, 8).y()));
    return most;
  };
  EXPECT_LT(corners_off_their_height(SectionPlanes::fixed), 1e-12);
  const Real centered = corners_off_their_height(SectionPlanes::centered),
             forward = corners_off_their_height(SectionPlanes::forward);
  EXPECT_GT(centered, 0.002);
  EXPECT_GT(forward, 0.002);
  EXPECT_GT(std::abs(centered - forward), 1e-6);
}

TEST(Enhancement, rays_prefer_far_backs_outwards_and_near_fronts_inwards) {
  // Two boxes on the right: outwards the far one's back, inwards from beyond them the near side of the far one.
  TriangleMesh boxes = shapes::box({0.02, -0.01, -0.05}, {0.03, 0.01, 0.05});
  const TriangleMesh far = shapes::box({0.04, -0.01, -0.05}, {0.05, 0.01, 0.05});
  TriangleMesh both;
  both.vertices.resize(3, 16);
  both.vertices << boxes.vertices, far.vertices;
  both.faces.resize(3, 24);
  both.faces << boxes.faces, Eigen::Matrix3Xi(far.faces.array() + 8);
  const Eigen::VectorXd angles = Eigen::Vector2d(0, pi);
  const CastRadii inside = cast_radii(cut_at_origin(both), angles, Eigen::Vector2d(0.01, 0.01));
  EXPECT_NEAR(inside.radii[0], 0.05, 1e-12);
  EXPECT_NEAR(inside.radii[1], -0.02, 1e-12);  // through the center to the first front
  const CastRadii beyond = cast_radii(cut_at_origin(both), angles, Eigen::Vector2d(0.06, 0.01));
  EXPECT_NEAR(beyond.radii[0], 0.05, 1e-12);
}

/// Six rays that all meet the surface, with the signs of the first three; the opposite ones have the other sign.
static std::vector<Index> positive_rays(int a, int b, int c) {
  CastRadii cast{Eigen::VectorXd(6), std::vector<bool>(6, true)};
  cast.radii << a, b, c, -a, -b, -c;
  std::vector<Index> rays;
  for (const RayMatch& match : find_matches(cast)) {
    rays.push_back(match.positive);
    EXPECT_EQ((match.positive + 3) % 6, match.negative);
  }
  return rays;
}

TEST(Enhancement, matches_wind_through_the_section_as_published) {  // table 3.4
  using testing::ElementsAre;
  EXPECT_THAT(positive_rays(1, 1, 1), ElementsAre(0, 1, 2));
  EXPECT_THAT(positive_rays(1, 1, -1), ElementsAre(5, 0, 1));
  EXPECT_THAT(positive_rays(1, -1, -1), ElementsAre(4, 5, 0));
  EXPECT_THAT(positive_rays(-1, -1, -1), ElementsAre(3, 4, 5));
  EXPECT_THAT(positive_rays(-1, -1, 1), ElementsAre(2, 3, 4));
  EXPECT_THAT(positive_rays(-1, 1, 1), ElementsAre(1, 2, 3));
}

TEST(Enhancement, a_ray_that_finds_nothing_makes_no_match) {
  CastRadii cast{Eigen::VectorXd(6), {true, false, true, true, true, true}};
  cast.radii << 1, 1, 1, -1, -1, 1;  // 0 with 3; 1 not found; 2 with 5 on both sides
  EXPECT_THAT(find_matches(cast), testing::ElementsAre(RayMatch{0, 3}));
}

TEST(Enhancement, the_inner_point_is_the_middle_matchs_middle_or_a_quadrilaterals_centroid) {
  const Eigen::VectorXd angles = even_angles(6);
  Eigen::VectorXd radii(6);
  radii << 3, 2, 2, -1, -1, -1;
  EXPECT_TRUE(inner_point({{0, 3}}, angles, radii).isApprox(Eigen::Vector2d(2, 0)));
  // Rays at 0 and 60 degrees with 3 and 1, and 2 and 1: two triangles from the center, the larger less the smaller.
  const Eigen::Vector2d u(1, 0), v(0.5, std::sqrt(0.75));
  const Real large = 3 * 2, small = 1;
  const Eigen::Vector2d expected = (large * (3 * u + 2 * v) / 3 - small * (u + v) / 3) / (large - small);
  EXPECT_TRUE(inner_point({{0, 3}, {1, 4}}, angles, radii).isApprox(expected, 1e-12));
}

TEST(Enhancement, sections_move_into_the_surface_and_their_corners_onto_it) {
  Points middle;
  const TriangleMesh surface = bow(middle);
  Points ends(3, 2);
  ends << middle.col(0), middle.col(32);
  const Points line = subdivide_line(ends, 4);
  const EnhancedSections sections =
      enhance(line, Vec3::UnitY(), Eigen::MatrixXd::Constant(8, line.cols(), 0.005), surface, {.more_rays = 5});
  const SignedDistance distance(surface);
  for (Eigen::Index k = 1; k + 1 < line.cols(); ++k) {
    EXPECT_LT(distance.query(sections.centers.col(k)).distance, -0.003) << k;
    for (Eigen::Index i = 0; i < 8; ++i) {
      const Vec3 corner = sections.centers.col(k) + sections.radii(i, k) * sections.frames.ray(k, i, 8);
      EXPECT_NEAR(distance.query(corner).distance, 0, 1e-9) << k << ' ' << i;
    }
  }
  EXPECT_EQ(sections.centers.col(0), line.col(0));
  EXPECT_EQ(sections.centers.col(16), line.col(16));
  // Both points of a match lie on the surface, and a center in the middle of what they span.
  std::map<Index, std::vector<MatchedPoints>> of_section;
  for (const MatchedPoints& match : sections.matches) {
    EXPECT_NEAR(distance.query(match.positive).distance, 0, 1e-9);
    EXPECT_NEAR(distance.query(match.negative).distance, 0, 1e-9);
    of_section[match.section].push_back(match);
  }
  EXPECT_GT(of_section.size(), 8U);
  for (const auto& [k, matches] : of_section)
    if (matches.size() % 2 == 1 && k > 0 && k < 16) {
      const MatchedPoints& between = matches[matches.size() / 2];
      EXPECT_LT((sections.centers.col(k) - (between.positive + between.negative) / 2).norm(), 1e-12) << k;
    }
}

TEST(Enhancement, a_center_that_the_published_heuristic_does_not_find_is_mended_or_stays) {
  // Beside the line and thinner than the angle between six rays.
  const TriangleMesh surface = shapes::box({0.03, 0.01, -0.05}, {0.032, 0.012, 0.05});
  Points line(3, 3);
  line << 0, 0, 0, 0, 0, 0, -0.04, 0, 0.04;
  const Eigen::MatrixXd radii = Eigen::MatrixXd::Constant(6, 3, 0.005);
  const SignedDistance distance(surface);
  const EnhancedSections published = enhance(line, Vec3::UnitX(), radii, surface, {.mend = false});
  EXPECT_EQ(published.centers, line);
  EXPECT_LT(distance.query(enhance(line, Vec3::UnitX(), radii, surface).centers.col(1)).distance, 0);
  EXPECT_LT(distance.query(enhance(line, Vec3::UnitX(), radii, surface, {12, false}).centers.col(1)).distance, 0);
}

TEST(Enhancement, the_inner_point_of_matches_that_lie_on_each_other_is_their_middle) {
  Eigen::VectorXd radii(6);
  radii << 2, 2, 1, -2, -2, -1;
  EXPECT_TRUE(
      inner_point({{0, 3}, {1, 4}}, even_angles(6), radii).isApprox(Eigen::Vector2d(1.5, std::sqrt(0.75)), 1e-12));
}

TEST(Enhancement, a_center_between_parts_of_a_section_is_mended_into_the_longest_of_them) {
  const auto plate = [](Real from, Real to) { return shapes::box({from, -0.02, -0.05}, {to, 0.02, 0.05}); };
  Points line(3, 3);
  line << 0, 0, 0, 0, 0, 0, -0.04, 0, 0.04;
  // From 20 to 60 mm beside the line; its middle at 40 mm lies between plates.
  const auto center = [&](const TriangleMesh& first, const TriangleMesh& second, const TriangleMesh& third) -> Vec3 {
    const TriangleMesh plates = shapes::both(shapes::both(first, second), third);
    return enhance(line, Vec3::UnitX(), Eigen::MatrixXd::Constant(6, 3, 0.005), plates).centers.col(1);
  };
  EXPECT_LT((center(plate(0.02, 0.024), plate(0.03, 0.036), plate(0.05, 0.06)) - Vec3(0.055, 0, 0)).norm(), 1e-9);
  EXPECT_LT((center(plate(0.02, 0.032), plate(0.034, 0.036), plate(0.05, 0.06)) - Vec3(0.026, 0, 0)).norm(), 1e-9);
  EXPECT_LT((center(plate(0.02, 0.022), plate(0.026, 0.038), plate(0.05, 0.06)) - Vec3(0.032, 0, 0)).norm(), 1e-9);
}

TEST(Enhancement, rays_that_meet_nothing_take_the_mean_of_those_that_do) {
  // Two rods: the point between them that the published heuristic finds lies outside, and some rays miss both.
  const TriangleMesh one = shapes::box({0.03, -0.005, -0.05}, {0.05, 0.005, 0.05}),
                     other = shapes::box({0.013, 0.028, -0.05}, {0.027, 0.042, 0.05});
  const TriangleMesh rods = shapes::both(one, other);
  Points line(3, 3);
  line << 0, 0, 0, 0, 0, 0, -0.04, 0, 0.04;
  const EnhancedSections sections =
      enhance(line, Vec3::UnitX(), Eigen::MatrixXd::Constant(6, 3, 0.005), rods, {.mend = false});
  ASSERT_FALSE(sections.inside[1]);
  const Vec3 x = sections.frames.first_rays.col(1), y = sections.frames.normals.col(1).cross(x);
  const CastRadii cast =
      cast_radii({rods, sections.centers.col(1), x, y}, even_angles(6), Eigen::VectorXd::Constant(6, 0.005));
  Real sum = 0;
  int met = 0;
  for (Eigen::Index i = 0; i < 6; ++i)
    if (cast.found[static_cast<std::size_t>(i)] && cast.radii[i] > 0) sum += cast.radii[i], ++met;
  ASSERT_GT(met, 0);
  ASSERT_LT(met, 6);
  for (Eigen::Index i = 0; i < 6; ++i) {
    const bool has_met = cast.found[static_cast<std::size_t>(i)] && cast.radii[i] > 0;
    EXPECT_NEAR(sections.radii(i, 1), has_met ? cast.radii[i] : sum / met, 1e-12) << i;
  }
}

TEST(Enhancement, sections_beyond_the_surface_stay) {
  const TriangleMesh surface = shapes::box({-0.01, -0.01, 0.05}, {0.01, 0.01, 0.095});
  Points ends(3, 2);
  ends << Vec3(0.002, 0, 0), Vec3(0.002, 0, 0.16);
  const Points line = subdivide_line(ends, 3);
  const EnhancedSections sections = enhance(line, Vec3::UnitX(), Eigen::MatrixXd::Constant(6, 9, 0.003), surface);
  EXPECT_THAT(sections.cut, testing::ElementsAre(false, false, false, true, true, false, false, false, false));
  EXPECT_EQ(sections.centers.col(1), line.col(1));
  EXPECT_NEAR(sections.radii(0, 1), 0.003, 1e-15);
  EXPECT_NEAR(sections.radii(0, 3), 0.008, 1e-12);
}

TEST(Enhancement, with_36_rays_all_centers_lie_inside_the_built_in_muscles) {
  for (const Muscle& muscle : shaped_hip().muscles) {
    Points ends = Points::Zero(3, 2);
    Eigen::Vector2d counts = Eigen::Vector2d::Zero();
    for (const Attachment& attachment : muscle.attachments)
      for (const Index v : attachment.vertices) {
        const int end = attachment.end == AttachmentEnd::origin ? 0 : 1;
        ends.col(end) += muscle.surface.vertices.col(v);
        counts[end] += 1;
      }
    ends.col(0) /= counts[0];
    ends.col(1) /= counts[1];
    const SignedDistance distance(muscle.surface);
    for (const int scaling : {1, 2, 4}) {
      const Points line = subdivide_line(ends, scaling);
      const EnhancedSections sections =
          enhance(line, Vec3::UnitX(), Eigen::MatrixXd::Constant(36, line.cols(), 0.01), muscle.surface);
      for (Eigen::Index k = 1; k + 1 < line.cols(); ++k) {
        EXPECT_TRUE(sections.cut[static_cast<std::size_t>(k)]) << muscle.name << ' ' << scaling << ' ' << k;
        EXPECT_LT(distance.query(sections.centers.col(k)).distance, 0) << muscle.name << ' ' << scaling << ' ' << k;
        EXPECT_GT(sections.radii.col(k).minCoeff(), 0) << muscle.name << ' ' << k;
      }
    }
  }
}

}  // namespace gracilis
