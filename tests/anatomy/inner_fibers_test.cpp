#include <gracilis/anatomy/fibers/inner_fibers.hpp>

#include <gracilis/anatomy/attachments/attachment_samples.hpp>
#include <gracilis/anatomy/fibers/fiber_containment.hpp>
#include <gracilis/anatomy/fibers/fiber_template.hpp>
#include <gracilis/anatomy/fibers/muscle_fibers.hpp>
#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/harmonic_field.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/nearest_triangle.hpp>

#include "anatomy/muscles_for_tests.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace gracilis {
namespace {

/// What must hold for the fibers of any muscle.
void expect_good_fibers(const Muscle& muscle, const Polylines& fibers) {
  ASSERT_EQ(fibers.count(), muscle.fibers.count);
  const Containment inside = containment(SignedDistance(muscle.surface), fibers);
  EXPECT_LE(inside.outside, 0.01 * inside.points);
  EXPECT_LE(inside.farthest, 5e-4);
  const SignedDistance depth(muscle.surface);
  for (Index i = 0; i < fibers.count(); ++i) {
    const Points line = fibers.line(i);
    for (const Index end : {Index{0}, static_cast<Index>(line.cols()) - 1}) {
      const Real below = -depth.query(line.col(end)).distance;
      EXPECT_GT(below, 0) << "ends lie a little inside";
      EXPECT_LT(below, 2e-5);
    }
  }
  for (const AttachmentEnd end : {AttachmentEnd::origin, AttachmentEnd::insertion}) {
    std::vector<char> held(static_cast<std::size_t>(muscle.surface.vertex_count()), 0);
    for (const Attachment& attachment : muscle.attachments)
      if (attachment.end == end)
        for (const Index v : attachment.vertices) held[static_cast<std::size_t>(v)] = 1;
    const NearestTriangle nearest(muscle.surface);
    for (Index i = 0; i < fibers.count(); ++i) {
      EXPECT_EQ(fibers.size(i), muscle.fibers.segments + 1);
      const NearestPoint found =
          nearest.query(fibers.points.col(end == AttachmentEnd::origin ? fibers.begin(i) : fibers.end(i) - 1));
      EXPECT_LT(found.distance, 1e-4);
      int attached = 0;
      for (int k = 0; k < 3; ++k) attached += held[static_cast<std::size_t>(muscle.surface.faces(k, found.face))];
      EXPECT_EQ(attached, 3) << "fiber " << i << " ends on a triangle that is not attached";
    }
  }
}

Real mean(const std::vector<Real>& values) {
  Real sum = 0;
  for (const Real value : values) sum += value;
  return sum / static_cast<Real>(values.size());
}

}  // namespace

TEST(InnerFibers, of_a_cylinder_are_straight_and_as_long_as_it) {
  const Muscle muscle = tube_muscle();
  const Polylines fibers = inner_fibers(muscle);
  expect_good_fibers(muscle, fibers);
  const FiberMeasures measures = measure_fibers(fibers);
  for (std::size_t i = 0; i < measures.lengths.size(); ++i) {
    EXPECT_NEAR(measures.lengths[i], 0.2, 0.004);
    EXPECT_LT(measures.origin_pennation[i], radians(20));
  }
  EXPECT_NEAR(mean(measures.lengths), 0.2, 0.001);
  const Real volume = enclosed_volume(muscle.surface.vertices, muscle.surface.faces);
  EXPECT_NEAR(physiological_cross_section(volume, fibers), volume / 0.2, 0.005 * volume / 0.2);
}

TEST(InnerFibers, fill_the_cross_section_evenly) {
  Muscle muscle = tube_muscle();
  muscle.fibers.count = 400;
  const Polylines fibers = inner_fibers(muscle);
  // Half of the disk's area lies within 1/√2 of its radius; the fibers keep a little clear of the rim.
  int within = 0;
  for (Index i = 0; i < fibers.count(); ++i) within += fibers.line(i).col(7).head<2>().norm() < 0.015 / std::sqrt(2.0);
  EXPECT_NEAR(within, 200, 40);
}

TEST(InnerFibers, of_a_cone_draw_together_as_it_does) {
  const Muscle muscle = cone_muscle();
  const Polylines fibers = inner_fibers(muscle);
  expect_good_fibers(muscle, fibers);
  Real before = 0, behind = 0;
  for (Index i = 0; i < fibers.count(); ++i) {
    const Points line = fibers.line(i);
    before += line.col(4).head<2>().norm();
    behind += line.col(11).head<2>().norm();
  }
  const auto half_width = [&](Index point) { return 1 - 2.5 * 0.2 * point / 15; };
  EXPECT_NEAR(behind / before, half_width(11) / half_width(4), 0.06);
}

TEST(InnerFibers, of_a_bent_tube_follow_its_arcs) {
  const Muscle muscle = bent_muscle();
  const Polylines fibers = inner_fibers(muscle);
  expect_good_fibers(muscle, fibers);
  EXPECT_NEAR(mean_fiber_length(fibers), 0.2, 0.003);
  for (Index i = 0; i < fibers.count(); ++i) {
    // Each runs at its own distance from the center of the bend, and has that arc's length.
    const Points line = fibers.line(i);
    const Real distance = Vec3(line(0, 8), 0, line(2, 8)).norm();
    EXPECT_NEAR(polyline_length(line), distance * pi / 2, 0.04 * 0.2) << "fiber " << i;
  }
}

TEST(InnerFibers, fill_a_thin_tendon_that_bends_sharply) {
  // A belly of 15 mm draws in to a tendon of 3 mm, which turns by 90 degrees around 20 mm, as psoas does in front of
  // the hip, and goes on straight.
  const auto radius = [](Real z) { return 0.003 + 0.012 / (1 + std::exp((z - 0.08) / 0.006)); };
  constexpr Real around = 0.02, from = 0.12, to = from + around * pi / 2;
  const auto bent = [&](const Vec3& p) {
    const Real x = p.x() / 0.015 * radius(p.z()), y = p.y() / 0.015 * radius(p.z());
    if (p.z() < from) return Vec3(x, y, p.z());
    const Real angle = (std::min(p.z(), to) - from) / around, further = std::max(p.z() - to, 0.0);
    const Real out = around + x;
    return Vec3(out * std::cos(angle) - around - further * std::sin(angle), y,
                from + out * std::sin(angle) + further * std::cos(angle));
  };
  Muscle muscle = tube_muscle(bent);
  muscle.fibers.segments = 60;
  const Polylines fibers = inner_fibers(muscle);
  expect_good_fibers(muscle, fibers);
  // Half way around the bend, where a plane through its axis cuts across the tendon.
  const Vec3 along(-std::sqrt(0.5), 0, std::sqrt(0.5)),
      middle(around * std::sqrt(0.5) - around, 0, from + around * std::sqrt(0.5));
  Points crossing(3, fibers.count());
  for (Index i = 0; i < fibers.count(); ++i) {
    const Points line = resampled(fibers.line(i), 2000);
    Eigen::Index at = 0;
    (along.transpose() * (line.colwise() - middle)).cwiseAbs().minCoeff(&at);
    crossing.col(i) = line.col(at);
  }
  const Real spread = std::sqrt((crossing.colwise() - Vec3(crossing.rowwise().mean())).colwise().squaredNorm().mean());
  EXPECT_GT(spread, 0.75 * 0.003 / std::sqrt(2.0));  // of what would fill the section evenly
  const Real off = (crossing.rowwise().mean() - middle).norm();
  EXPECT_LT(off, 0.001);
}

TEST(InnerFibers, one_alone_is_smoothed_as_among_many) {
  Muscle muscle = bent_muscle();
  muscle.fibers.count = 1;
  const Polylines smooth = inner_fibers(muscle);
  muscle.fibers.smoothing = 0;
  EXPECT_GT((smooth.points - inner_fibers(muscle).points).colwise().norm().maxCoeff(), 2e-5);
}

TEST(InnerFibers, do_not_go_past_where_they_end_and_turn_back) {
  Muscle muscle = tube_muscle();
  const Sections sections = cut_into_sections(muscle);
  // Sections go on to the top, but fibers end half way up.
  std::vector<Index>& insertion = muscle.attachments[1].vertices;
  insertion.clear();
  for (Index v = 0; v < muscle.surface.vertex_count(); ++v)
    if (std::abs(muscle.surface.vertices(2, v) - 0.1) < 0.01) insertion.push_back(v);
  const Polylines fibers =
      fibers_through(muscle, sections, [](const Eigen::Vector2d& start, std::size_t) { return start; });
  expect_good_fibers(muscle, fibers);
  for (Index i = 0; i < fibers.count(); ++i) {
    const Points line = fibers.line(i);
    EXPECT_LT(line.row(2).maxCoeff(), 0.115) << "fiber " << i;
    EXPECT_LT(polyline_length(line), 0.14) << "fiber " << i;
  }
}

TEST(InnerFibers, keep_their_mean_length_when_count_or_resolution_double) {
  for (const Muscle& shape : {tube_muscle(), cone_muscle(), bent_muscle()}) {
    Muscle muscle = shape;
    const Real usual = mean_fiber_length(inner_fibers(muscle));
    muscle.fibers.count = 200;
    EXPECT_NEAR(mean_fiber_length(inner_fibers(muscle)) / usual, 1, 0.01);
    muscle.fibers.segments = 30;
    EXPECT_NEAR(mean_fiber_length(inner_fibers(muscle)) / usual, 1, 0.01);
  }
}

TEST(InnerFibers, have_the_same_bits_for_any_number_of_threads) {
  const Muscle muscle = cone_muscle();
  const Polylines several = inner_fibers(muscle);
  const ThreadLimit one(1);
  EXPECT_TRUE(inner_fibers(muscle).points == several.points);
}

TEST(InnerFibers, there_are_none_where_none_are_wanted_and_one_where_one_is) {
  Muscle muscle = tube_muscle();
  muscle.fibers.count = 0;
  EXPECT_EQ(fibers_of(muscle).count(), 0);
  muscle.fibers.count = 1;
  muscle.fibers.segments = 1;
  expect_good_fibers(muscle, fibers_of(muscle));
}

TEST(InnerFibers, of_other_templates_stay_inside_too) {
  Muscle muscle = tube_muscle();
  for (const FiberTemplate shape : {FiberTemplate::pennate, FiberTemplate::curved, FiberTemplate::fan}) {
    muscle.fibers.shape = shape;
    expect_good_fibers(muscle, inner_fibers(muscle));
  }
}

TEST(CutIntoSections, a_tube_has_as_many_as_asked_for_of_equal_areas_between_them_and_knows_its_slenderness) {
  const Muscle muscle = tube_muscle();
  for (const int count : {4, 32}) {
    const Sections sections = cut_into_sections(muscle, count);
    ASSERT_EQ(static_cast<int>(sections.maps.size()), count);
    EXPECT_EQ(sections.left_out, 0);
    EXPECT_EQ(sections.shares.size(), sections.maps.size());
    EXPECT_EQ(sections.levels.size(), sections.maps.size());
    for (int k = 0; k < count; ++k) {
      const auto at = static_cast<std::size_t>(k);
      // Levels are those of vertices, whose rings are an eightieth of the way apart.
      EXPECT_NEAR(sections.shares[at], (k + 0.75) / (count + 0.5), 1.5 / 80) << k;
      EXPECT_NEAR(sections.levels[at], sections.shares[at], 0.01) << "the field grows evenly";
    }
    // Half of the line around it is two sides of a square.
    EXPECT_NEAR(sections.slenderness, 0.2 / (pi * 0.015 / 2), 0.2);
  }
}

TEST(CutIntoSections, the_square_lies_the_same_way_in_all_of_them) {
  const Sections sections = cut_into_sections(bent_muscle(), 16);
  for (std::size_t k = 1; k < sections.maps.size(); ++k)
    for (const Real a : {0.1, 0.9})
      for (const Real b : {0.1, 0.9})
        EXPECT_LT((sections.maps[k].at(a, b) - sections.maps[k - 1].at(a, b)).norm(), 0.016) << k << "; 10 mm apart";
}

TEST(FiberTemplate, points_are_spread_evenly_and_paths_do_as_their_names_say) {
  int quarter = 0;
  for (const Eigen::Vector2d& p : spread_over_square(1000)) quarter += p.x() < 0.5 && p.y() < 0.5;
  EXPECT_NEAR(quarter, 250, 10);
  FiberSettings settings;
  const Eigen::Vector2d start(0.4, 0.3);
  EXPECT_EQ(template_point(settings, start, 0.8, 10), start);
  settings.shape = FiberTemplate::pennate;
  settings.pennation = radians(5);
  const Eigen::Vector2d along = template_point(settings, start, 0.7, 2) - template_point(settings, start, 0.3, 2);
  EXPECT_NEAR(along.x(), 0.4 * 2 * std::tan(radians(5)), 1e-12) << "slope times slenderness";
  EXPECT_EQ(along.y(), 0);
  settings.shape = FiberTemplate::curved;
  EXPECT_EQ(template_point(settings, start, 0, 2), start);
  EXPECT_NEAR(template_point(settings, start, 0.5, 2).x(), 0.4 + settings.curvature, 1e-12);
  settings.shape = FiberTemplate::fan;
  settings.convergence = 1;
  EXPECT_NEAR((template_point(settings, start, 1, 2) - Eigen::Vector2d(0.5, 0.5)).norm(), 0, 1e-12);
}

TEST(AttachmentSamples, lie_on_the_attachment_and_spread_over_it) {
  const Muscle muscle = tube_muscle();
  const Points samples = attachment_samples(muscle, AttachmentEnd::insertion, 100);
  ASSERT_EQ(samples.cols(), 100);
  int within = 0;
  for (Index i = 0; i < 100; ++i) {
    EXPECT_NEAR(samples(2, i), 0.2, 1e-12);
    within += samples.col(i).head<2>().norm() < 0.015 / std::sqrt(2.0);
  }
  EXPECT_NEAR(within, 50, 8);
  EXPECT_NEAR((attachment_center(muscle, AttachmentEnd::origin)).norm(), 0, 5e-4);
}

TEST(AttachmentSamples, of_two_vertices_are_repeated) {
  Muscle muscle = tube_muscle();
  muscle.attachments[0].vertices = {3, 20};
  const Points samples = attachment_samples(muscle, AttachmentEnd::origin, 5);
  ASSERT_EQ(samples.cols(), 5);
  for (Index i = 0; i < 5; ++i)
    EXPECT_TRUE(samples.col(i) == muscle.surface.vertices.col(3) || samples.col(i) == muscle.surface.vertices.col(20));
}

TEST(MoveInside, brings_points_below_the_surface_and_leaves_those_that_are_there) {
  const TriangleMesh ball = shapes::sphere(Vec3::Zero(), 0.05, 4);
  const SignedDistance distance(ball);
  Points points(3, 3);
  points.col(0) = Vec3(0.06, 0.01, 0), points.col(1) = ball.vertices.col(7), points.col(2) = Vec3(0.01, 0, 0);
  const Vec3 deep = points.col(2);
  move_inside(ball, distance, 1e-4, points);
  EXPECT_NEAR(distance.query(points.col(0)).distance, -1e-4, 1e-5);
  EXPECT_LT(distance.query(points.col(1)).distance, -1e-5);
  EXPECT_EQ(points.col(2), deep);
}

TEST(MoveInside, in_a_plate_thinner_than_the_depth_goes_as_deep_as_it_can) {
  const TriangleMesh plate = shapes::box({0, 0, 0}, {0.1, 0.1, 0.0004});
  const SignedDistance distance(plate);
  Points points = (Points(3, 2) << 0.05, 0.05, 0.05, 0.05, 0.001, 0.00039).finished();
  move_inside(plate, distance, 0.001, points);
  for (Index i = 0; i < 2; ++i) {
    EXPECT_LT(distance.query(points.col(i)).distance, 0);
    EXPECT_NEAR(points(2, i), 0.0004 - 0.00025, 1e-9) << "a quarter of the depth is the first that is inside";
  }
}

TEST(SmoothInside, each_round_takes_points_half_way_to_the_middle_of_their_neighbors_and_leaves_the_ends) {
  const TriangleMesh ball = shapes::sphere(Vec3::Zero(), 1, 3);
  const SignedDistance distance(ball);
  const Points line = (Points(3, 5) << 0, 0.1, 0.2, 0.3, 0.4, 0, 0.1, 0, 0.1, 0, 0, 0, 0.1, 0, 0).finished();
  Points smooth = line, expected = line;
  smooth_inside(ball, distance, 1e-4, 2, smooth);
  for (int round = 0; round < 2; ++round) {
    const Points before = expected;
    for (Index i = 1; i < 4; ++i) expected.col(i) = (before.col(i - 1) + before.col(i + 1)) / 4 + before.col(i) / 2;
  }
  EXPECT_LT((smooth - expected).cwiseAbs().maxCoeff(), 1e-15);
  Points untouched = line;
  smooth_inside(ball, distance, 1e-4, 0, untouched);
  EXPECT_EQ(untouched, line);
  Points two = line.leftCols(2);
  smooth_inside(ball, distance, 1e-4, 3, two);
  EXPECT_EQ(two, line.leftCols(2)) << "nothing between the ends";
}

TEST(SmoothInside, around_a_bend_points_stay_as_deep_as_asked_for) {
  const Muscle muscle = bent_muscle();
  const SignedDistance distance(muscle.surface);
  Points line(3, 31);  // along the inner side of the bend, where smoothing leads out
  for (Index i = 0; i <= 30; ++i) {
    const Real angle = pi / 2 * (0.02 + 0.96 * i / 30), away = bend_radius - 0.0135;
    line.col(i) = Vec3(away * std::cos(angle), 0, away * std::sin(angle));
  }
  smooth_inside(muscle.surface, distance, 5e-4, 200, line);
  for (Index i = 1; i < 30; ++i) EXPECT_LE(distance.query(line.col(i)).distance, -4.5e-4) << i;
}

TEST(Containment, counts_points_outside_and_tells_the_farthest) {
  const SignedDistance distance(shapes::box({0, 0, 0}, {1, 1, 1}));
  const Points line = (Points(3, 4) << 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 1 + 1e-10, 1.25, 1.5).finished();
  const Containment found = containment(distance, join({line}));
  EXPECT_EQ(found.points, 4);
  EXPECT_EQ(found.outside, 2) << "rounding does not count";
  EXPECT_NEAR(found.farthest, 0.5, 1e-12);
  EXPECT_EQ(containment(distance, join({Points(line.leftCols(1))})).farthest, 0);
}

}  // namespace gracilis
