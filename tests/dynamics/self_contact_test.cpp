#include <contact_check/judge.hpp>
#include <gracilis/dynamics/contact/surface/surface_contact.hpp>

#include <shapes.hpp>

#include "meeting_surfaces.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace gracilis {

TEST(SurfaceContact, of_a_muscle_with_itself_parts_the_legs_of_a_hairpin) {
  // A straight tube, bent; half way up, its second leg is 1 mm in the first.
  const Real radius = 0.003, length = 0.08, turn = 0.004, leg = (length - pi * turn) / 2;
  TriangleMesh tube = shapes::cylinder(radius, length, 16, 60);
  Meeting meeting;
  meeting.add(tube);
  meeting.pair(0, 0, 0.0002f);
  for (Index i = 0; i < tube.vertex_count(); ++i) {
    const Vec3 p = tube.vertices.col(i);
    const Real along = std::clamp(p.z() - leg, Real{0}, pi * turn) / turn, beyond = p.z() - leg - along * turn;
    // The tube's x and z axes turn in their plane, y stays.
    const Vec3 forward(std::sin(along), 0, std::cos(along)), side(std::cos(along), 0, -std::sin(along));
    Vec3 middle = Vec3(turn - turn * std::cos(along), 0, turn * std::sin(along)) + beyond * forward;
    if (beyond > 0) middle.x() -= 0.003 * std::pow(std::sin(pi * beyond / leg), 2);
    tube.vertices.col(i) = middle + p.x() * side + p.y() * Vec3::UnitY();
  }
  meeting.particles[0] = make_particles(tube.vertices, Eigen::VectorXd::Ones(tube.vertex_count()));
  meeting.start = meeting.particles;
  const contact_check::Judge judge({{"tube", shapes::cylinder(radius, length, 16, 60), {}}}, {});
  const auto self_pairs = [&] {
    Points now(3, tube.vertex_count());
    for (Index p = 0; p < now.cols(); ++p) now.col(p) = meeting.particles[0].position(p).cast<Real>();
    return judge.judge(0, {now}, {}).muscles[0].self_pairs;
  };
  EXPECT_GT(self_pairs(), 20);
  EXPECT_GT(meeting.solve(1), 0);
  for (int i = 0; i < 20; ++i) meeting.solve(5);
  EXPECT_LT(meeting.unrest(), 1e-6);
  EXPECT_EQ(self_pairs(), 0);
}

TEST(SurfaceContact, a_sheet_at_rest_does_not_meet_its_own_back) {
  Meeting meeting;
  meeting.add(shapes::cylinder(0.02, 0.0004, 40, 1));
  meeting.pair(0, 0, 0.0001f);
  EXPECT_EQ(meeting.solve(3), 0);
}

TEST(SurfaceContact, a_sheet_pressed_through_itself_comes_back) {
  Meeting meeting;
  TriangleMesh ball = shapes::sphere(Vec3::Zero(), 0.01, 4);
  ball.vertices.row(2) *= 0.1;
  meeting.add(ball);
  meeting.pair(0, 0, 0.0002f);
  Index top = 0;
  ball.vertices.row(2).maxCoeff(&top);
  meeting.particles[0].position(top).z() = -0.0014f;
  meeting.start = meeting.particles;
  meeting.solve(30);
  float back = 1;
  for (Index p = 0; p < ball.vertex_count(); ++p)
    if (ball.vertices(2, p) < 0 && ball.vertices.col(p).head<2>().norm() < 0.001)
      back = std::min(back, meeting.particles[0].position(p).z());
  EXPECT_GT(meeting.particles[0].position(top).z(), back) << "front over back again";
}

}  // namespace gracilis
