#include <gracilis/dynamics/contact/surface/exit_side.hpp>

#include <shapes.hpp>

#include "meeting_surfaces.hpp"

#include <gtest/gtest.h>

namespace gracilis {
namespace {

using Eigen::Vector3f;

constexpr float half_of_sheet = 0.001f;  ///< of the sheet, m

/// A ball above a thin sheet that cannot move, with its lowest particles nearer to the sheet's far side.
Meeting ball_in_a_sheet() {
  Meeting meeting;
  meeting.add(shapes::sphere({0, 0, 0.0096}, 0.01, 4));
  meeting.add(shapes::box({-0.02, -0.02, -half_of_sheet}, {0.02, 0.02, half_of_sheet}), 0);
  SurfacePair& pair = meeting.pair(0, 1, 0.0002f);
  pair.release = 0.001f;
  const Particles& ball = meeting.particles[0];
  pair.first_overlaps.assign(static_cast<std::size_t>(ball.count()), 0);
  for (Index p = 0; p < ball.count(); ++p)
    pair.first_overlaps[static_cast<std::size_t>(p)] = ball.position(p).z() < half_of_sheet;
  return meeting;
}

void tell_side(SurfacePair& pair, const Vector3f& way) {
  pair.first_ways.setZero(3, static_cast<Eigen::Index>(pair.first_overlaps.size()));
  for (std::size_t p = 0; p < pair.first_overlaps.size(); ++p)
    if (pair.first_overlaps[p]) pair.first_ways.col(static_cast<Eigen::Index>(p)) = way;
}

float lowest(const Particles& particles) {
  float z = 1;
  for (Index p = 0; p < particles.count(); ++p) z = std::min(z, particles.position(p).z());
  return z;
}

void release_in_steps(Meeting& meeting, int steps) {
  meeting.prepare();
  for (int step = 0; step < steps; ++step) {
    meeting.start = meeting.particles;
    remember_places(meeting.pointers<const Particles*>(meeting.particles), meeting.state);
    meeting.find();
    meeting.follow();
    project_candidates(meeting.world, meeting.state, meeting.pointers<const Particles*>(meeting.start),
                       meeting.pointers<Particles*>(meeting.particles));
  }
}

}  // namespace

TEST(ExitSide, what_lies_beyond_the_middle_of_a_sheet_comes_out_on_the_side_that_it_is_told) {
  Meeting meeting = ball_in_a_sheet();
  ASSERT_LT(lowest(meeting.particles[0]), 0) << "beyond the middle";
  tell_side(meeting.world.pairs[0], Vector3f::UnitZ());
  release_in_steps(meeting, 4);
  EXPECT_GT(lowest(meeting.particles[0]), half_of_sheet);
}

TEST(ExitSide, and_on_the_nearer_one_where_none_is_told) {
  Meeting meeting = ball_in_a_sheet();
  release_in_steps(meeting, 4);
  EXPECT_LT(lowest(meeting.particles[0]), -half_of_sheet);
}

TEST(ExitSide, is_that_of_the_shape_at_rest_however_the_sheet_has_turned_since) {
  Meeting meeting = ball_in_a_sheet();
  tell_side(meeting.world.pairs[0], Vector3f::UnitZ());
  for (Particles& each : meeting.particles)
    for (Index p = 0; p < each.count(); ++p) {
      const Vector3f x = each.position(p);
      each.position(p) = Vector3f(x.x(), -x.y(), -x.z());  // half a turn about x
    }
  release_in_steps(meeting, 4);
  const Particles& ball = meeting.particles[0];
  for (Index p = 0; p < ball.count(); ++p) EXPECT_LT(ball.position(p).z(), -half_of_sheet);
}

TEST(ExitSide, a_walk_does_not_go_around_the_rim) {
  TriangleMesh sheet = shapes::sphere(Vec3::Zero(), 0.02, 5);
  sheet.vertices.row(2) *= 0.1;
  const ContactSurface surface = build_contact_surface(sheet.faces, sheet.vertex_count());
  const Particles particles = make_particles(sheet.vertices, Eigen::VectorXd::Zero(sheet.vertex_count()));
  const Eigen::Matrix3Xf rest = sheet.vertices.cast<float>(), ways = Vector3f::UnitZ(), none(3, 0);
  const auto normal_of = [&](Index face) { return face_area(surface, face, particles).normalized().eval(); };
  Index above = 0;
  while (normal_of(above).z() < 0.99f) ++above;
  const Vector3f p(0.022f, 0, -0.004f);  // beyond the rim, below it
  EXPECT_GT(normal_of(ExitSide{surface, rest, ways}.walk(0, p, above, particles).face).z(), -0.5f);
  EXPECT_LT(normal_of(ExitSide{surface, rest, none}.walk(0, p, above, particles).face).z(), -0.5f);
}

}  // namespace gracilis
