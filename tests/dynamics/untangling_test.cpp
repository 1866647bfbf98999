#include <gracilis/dynamics/contact/self/self_intersections.hpp>
#include <gracilis/dynamics/contact/surface/surface_contact.hpp>

#include <shapes.hpp>

#include "meeting_surfaces.hpp"
#include "systems_for_tests.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace gracilis {
namespace {

using Eigen::Vector3f;

/// A ball of which a particle lies over its neighbors, so that faces have folded; and another, so far from its center,
/// in radii, on the side of that particle. With `lay_in_another` all of it lay in the other at rest; that
/// pair may be listed first.
Meeting folded_ball(float away, bool lay_in_another, bool other_pair_first = false) {
  Meeting meeting;
  const TriangleMesh ball = shapes::sphere(Vec3::Zero(), 0.01, 4);
  meeting.add(ball);
  meeting.add(shapes::sphere(static_cast<Real>(away) * Vec3(ball.vertices.col(7)), 0.01, 4));
  if (!other_pair_first) meeting.pair(0, 0, 0.0003f).reach = 0.001f;
  if (lay_in_another) meeting.pair(0, 1, 0.0003f).first_overlaps.assign(meeting.world.rest[0].cols(), 1);
  if (other_pair_first) meeting.pair(0, 0, 0.0003f).reach = 0.001f;
  meeting.prepare();
  const Vector3f place = meeting.particles[0].position(7);
  meeting.particles[0].position(7) = 1.03f * place + Vector3f(-place.y(), place.x(), 0).normalized() * 0.0022f;
  return meeting;
}

/// Whether there was anything to untangle. Without a prediction that is where everything was before the step.
bool untangle_movers(Meeting& meeting, const Movers& movers, int attempt,
                     const std::vector<Particles>& predicted = {}) {
  const std::vector<Tangle> tangles =
      find_tangles(meeting.world, meeting.state, meeting.pointers<const Particles*>(meeting.particles), movers);
  untangle(meeting.world, tangles, attempt, predicted.empty() ? meeting.state.before : predicted,
           meeting.pointers<Particles*>(meeting.particles));
  return std::any_of(tangles.begin(), tangles.end(), [](const Tangle& tangle) { return !tangle.pairs.empty(); });
}

bool untangle_once(Meeting& meeting, int attempt = 0) {
  meeting.find();
  meeting.follow();
  return untangle_movers(meeting, {}, attempt);
}

}  // namespace

TEST(SurfaceContact, a_surface_that_cuts_itself_is_untangled_and_says_so) {
  Meeting meeting;
  meeting.add(shapes::sphere(Vec3::Zero(), 0.01, 4));
  meeting.pair(0, 0, 0.0003f).reach = 0.001f;
  meeting.prepare();
  const Particles whole = meeting.particles[0];
  EXPECT_FALSE(untangle_once(meeting));
  EXPECT_EQ(largest_motion(whole, meeting.particles[0]), 0);
  // Over and under its neighbors.
  const Vector3f place = whole.position(7);
  meeting.particles[0].position(7) = 0.95f * place + Vector3f(-place.y(), place.x(), 0).normalized() * 0.004f;
  EXPECT_TRUE(untangle_once(meeting));
  EXPECT_FALSE(untangle_once(meeting)) << "all is untangled";
  EXPECT_LT(largest_motion(whole, meeting.particles[0]), 0.003f);
}

TEST(SurfaceContact, what_resists_twice_goes_back_to_the_shape_that_was_predicted_where_its_surroundings_went) {
  Meeting meeting;
  meeting.add(shapes::sphere(Vec3::Zero(), 0.01, 4));
  meeting.pair(0, 0, 0.0003f).reach = 0.001f;
  meeting.prepare();
  // Flatter than at rest, and moved since.
  std::vector<Particles> predicted = meeting.particles;
  const Vector3f moved(0.0002f, 0, 0.0003f);
  for (Index p = 0; p < predicted[0].count(); ++p) {
    predicted[0].position(p).z() *= 0.6f;
    meeting.particles[0].position(p) = predicted[0].position(p) + moved;
  }
  const Particles expected = meeting.particles[0];
  const Vector3f place = meeting.particles[0].position(7);
  meeting.particles[0].position(7) = 0.95f * place + Vector3f(-place.y(), place.x(), 0).normalized() * 0.004f;
  meeting.find();
  meeting.follow();
  EXPECT_TRUE(untangle_movers(meeting, {}, 2, predicted));
  EXPECT_LT(largest_motion(expected, meeting.particles[0]), 0.0002f);
}

TEST(SurfaceContact, a_surface_that_has_folded_is_untangled_though_it_cuts_nothing) {
  Meeting meeting = folded_ball(10, false);
  const auto is_folded = [&] {
    return !find_folds(meeting.world.surfaces[0], meeting.world.rest[0], meeting.state.before[0], meeting.particles[0])
                .empty();
  };
  std::vector<Index> faces(static_cast<std::size_t>(meeting.world.surfaces[0].faces.cols()));
  std::iota(faces.begin(), faces.end(), 0);
  EXPECT_TRUE(find_self_intersections(meeting.world.surfaces[0], meeting.world.rest[0], meeting.state.before[0],
                                      meeting.particles[0], faces)
                  .empty());
  EXPECT_TRUE(is_folded());
  EXPECT_TRUE(untangle_once(meeting));
  EXPECT_FALSE(is_folded());
  EXPECT_FALSE(meeting.state.torn[0][7]) << "it lay in nothing";
}

TEST(SurfaceContact, lets_go_of_what_folded_on_its_way_out_of_a_surface_that_it_lay_in_at_rest) {
  for (const bool other_pair_first : {false, true}) {
    Meeting meeting = folded_ball(1.9f, true, other_pair_first);
    ASSERT_TRUE(untangle_once(meeting));
    EXPECT_TRUE(meeting.state.torn[0][7]);
    EXPECT_FALSE(meeting.state.torn[0][100]) << "not folded";
    remember_places(meeting.pointers<const Particles*>(meeting.particles), meeting.state);
    EXPECT_FALSE(meeting.state.torn[0][7]) << "in the next step";
  }
}

TEST(SurfaceContact, does_not_let_go_of_what_folded_when_it_had_come_out) {
  Meeting meeting = folded_ball(2.2f, true);
  ASSERT_TRUE(untangle_once(meeting));
  EXPECT_FALSE(meeting.state.torn[0][7]);
}

TEST(SurfaceContact, untangling_moves_none_but_the_movers) {
  Meeting meeting;
  for (int i = 0; i < 3; ++i) {
    meeting.add(shapes::sphere({0.1 * i, 0, 0}, 0.01, 4));
    meeting.pair(i, i, 0.0003f).reach = 0.001f;
  }
  meeting.prepare();
  const auto cut = [&](std::size_t surface) {
    const Vector3f place = meeting.particles[surface].position(7);
    meeting.particles[surface].position(7) =
        place + Vector3f(-place.y(), place.x(), 0).normalized() * 0.004f - 0.0005f * Vector3f::UnitZ();
  };
  cut(0), cut(1);
  meeting.find();
  meeting.follow();
  const Particles left_alone = meeting.particles[1];
  const Particles tangled = meeting.particles[0];
  EXPECT_TRUE(untangle_movers(meeting, {{1, 0, 1}}, 0));
  EXPECT_GT(largest_motion(tangled, meeting.particles[0]), 0);
  EXPECT_EQ(largest_motion(left_alone, meeting.particles[1]), 0);
}

TEST(SurfaceContact, fewer_cuts_are_less_and_so_are_fewer_folds_of_as_many) {
  const auto tangle = [](std::size_t cuts, std::size_t folds) {
    return Tangle{std::vector<FacePair>(cuts + folds, FacePair{0, 1}), cuts};
  };
  EXPECT_TRUE(is_less(tangle(1, 9), tangle(2, 0)));
  EXPECT_TRUE(is_less(tangle(1, 1), tangle(1, 2)));
  EXPECT_FALSE(is_less(tangle(1, 1), tangle(1, 1)));
  EXPECT_FALSE(is_less(tangle(2, 0), tangle(1, 9)));
}

}  // namespace gracilis
