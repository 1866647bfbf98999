#include <contact_check/judge.hpp>
#include <gracilis/core/parallel.hpp>
#include <gracilis/dynamics/contact/self/self_cuts.hpp>
#include <gracilis/dynamics/contact/surface/surface_contact.hpp>

#include <gracilis/core/state_hash.hpp>
#include <shapes.hpp>

#include "systems_for_tests.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <random>

namespace gracilis {
namespace {

using Eigen::Vector3f;

/// Surfaces that meet, with nothing else that acts on them.
struct Meeting {
  SurfaceCrowd crowd;
  std::vector<Particles> particles, start;
  CrowdState state;

  void add(const TriangleMesh& mesh, const Eigen::VectorXd& inverse_masses) {
    crowd.surfaces.push_back(build_contact_surface(mesh.faces, mesh.vertex_count()));
    particles.push_back(make_particles(mesh.vertices, inverse_masses));
    crowd.rest.push_back(mesh.vertices.cast<float>());
    crowd.rest_normals.emplace_back();
    particle_normals(crowd.surfaces.back(), particles.back(), crowd.rest_normals.back());
    crowd.neighborhood.push_back(0.004f);
  }
  void add(const TriangleMesh& mesh, Real inverse_mass = 1) {
    add(mesh, Eigen::VectorXd::Constant(mesh.vertex_count(), inverse_mass));
  }

  SurfacePair& pair(Index first, Index second, float gap) {
    const auto a = static_cast<std::size_t>(particles[static_cast<std::size_t>(first)].count()),
               b = static_cast<std::size_t>(particles[static_cast<std::size_t>(second)].count());
    SurfacePair pair;
    pair.first = first, pair.second = second;
    pair.first_gap.assign(a, gap), pair.second_gap.assign(b, gap);
    pair.first_touches.assign(a, 0), pair.second_touches.assign(b, 0);
    crowd.pairs.push_back(std::move(pair));
    return crowd.pairs.back();
  }

  template <class Pointer>
  std::vector<Pointer> pointers(auto& list) {
    std::vector<Pointer> result;
    for (auto& each : list) result.push_back(&each);
    return result;
  }

  void prepare() {
    arrange_rounds(crowd);
    state = make_crowd_state(crowd);
  }
  void find() { find_touches(crowd, pointers<const Particles*>(particles), state); }
  void follow() { follow_touches(crowd, pointers<const Particles*>(particles), state); }
  void move(std::size_t surface, const Vector3f& by) {
    for (Index p = 0; p < particles[surface].count(); ++p) particles[surface].position(p) += by;
  }

  /// Looks for contacts and projects them. Returns the pushes of the last round.
  Index solve(int rounds) {
    prepare();
    if (start.empty()) start = particles;
    find();
    Index pushes = 0;
    for (int i = 0; i < rounds; ++i) {
      follow();
      pushes = project_touches(crowd, state, pointers<const Particles*>(start), pointers<Particles*>(particles));
    }
    return pushes;
  }

  /// Longest way a particle goes in one more round, m: 0 but for rounding where every gap is kept.
  Real unrest() {
    const std::vector<Particles> before = particles;
    solve(1);
    Real longest = 0;
    for (std::size_t s = 0; s < particles.size(); ++s)
      for (Index p = 0; p < particles[s].count(); ++p)
        longest = std::max<Real>(longest, (particles[s].position(p) - before[s].position(p)).norm());
    return longest;
  }
};

Vec3 momentum(const std::vector<Particles>& now, const std::vector<Particles>& start) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t s = 0; s < now.size(); ++s)
    for (Index p = 0; p < now[s].count(); ++p)
      if (now[s].inverse_mass(p) > 0)
        sum += (now[s].position(p) - start[s].position(p)).cast<Real>() / static_cast<Real>(now[s].inverse_mass(p));
  return sum;
}

/// Two balls of 10 mm, the second this much (m) too near.
Meeting pressed_balls(Real too_near, Real second_inverse_mass = 1) {
  Meeting meeting;
  meeting.add(shapes::sphere(Vec3::Zero(), 0.01, 4));
  meeting.add(shapes::sphere({0.02 - too_near, 0.0003, 0.0002}, 0.01, 4), second_inverse_mass);
  meeting.pair(0, 1, 0.0003f);
  return meeting;
}

/// How deep the particles of one ball are in the other, m.
Real deepest(const Particles& probe, const Vec3& center) {
  Real depth = 0;
  for (Index p = 0; p < probe.count(); ++p)
    depth = std::max(depth, 0.01 - (probe.position(p).cast<Real>() - center).norm());
  return depth;
}

}  // namespace

TEST(SurfaceContact, leaves_alone_what_is_farther_than_the_gap) {
  Meeting meeting = pressed_balls(-0.001);
  EXPECT_EQ(meeting.solve(3), 0);
  EXPECT_EQ(meeting.particles[0].xyzw, meeting.start[0].xyzw);
}

TEST(SurfaceContact, pushes_two_balls_apart_equally_and_keeps_their_momentum) {
  Meeting meeting = pressed_balls(0.001);
  EXPECT_GT(deepest(meeting.particles[0], {0.019, 0.0003, 0.0002}), 0.0009);
  meeting.solve(40);
  EXPECT_LT(meeting.unrest(), 1e-6);
  Vec3 first = Vec3::Zero();
  for (Index p = 0; p < meeting.particles[0].count(); ++p)
    first += (meeting.particles[0].position(p) - meeting.start[0].position(p)).cast<Real>();
  EXPECT_LT(first.x(), -1e-3) << "the first ball gave way";
  EXPECT_LT(momentum(meeting.particles, meeting.start).norm(), 1e-4 * first.norm());
}

TEST(SurfaceContact, moves_the_lighter_side_more) {
  Meeting meeting = pressed_balls(0.0005, 1e-3);
  meeting.solve(40);
  Real light = 0, heavy = 0;
  for (Index p = 0; p < meeting.particles[0].count(); ++p) {
    light = std::max<Real>(light, (meeting.particles[0].position(p) - meeting.start[0].position(p)).norm());
    heavy = std::max<Real>(heavy, (meeting.particles[1].position(p) - meeting.start[1].position(p)).norm());
  }
  EXPECT_GT(light, 0.0005);
  EXPECT_LT(heavy, 0.01 * light);
}

TEST(SurfaceContact, never_moves_what_is_fixed) {
  Meeting meeting = pressed_balls(0.0005, 0);
  meeting.solve(40);
  EXPECT_EQ(meeting.particles[1].xyzw, meeting.start[1].xyzw);
  EXPECT_LT(meeting.unrest(), 1e-6);
}

TEST(SurfaceContact, a_pair_s_shift_carries_one_into_the_other_s_coordinates) {
  Meeting meeting;
  meeting.add(shapes::sphere(Vec3::Zero(), 0.01, 4));
  meeting.add(shapes::sphere(Vec3::Zero(), 0.01, 4));
  meeting.pair(0, 1, 0.0003f).shift = {-0.0195f, 0, 0};
  EXPECT_GT(meeting.solve(1), 0);
  meeting.solve(40);
  EXPECT_LT(meeting.unrest(), 1e-6);
}

TEST(SurfaceContact, edges_that_cross_while_every_particle_is_outside_are_pushed_apart) {
  // Two roofs, ridge over ridge: the lower's ridge lies along x, the upper's along y.
  const auto roof = [](Real ridge, Real eaves, bool along_x) {
    std::vector<Vec3> v = {{-0.02, 0, ridge},    {0.02, 0, ridge},     {-0.02, -0.01, eaves},
                           {0.02, -0.01, eaves}, {-0.02, 0.01, eaves}, {0.02, 0.01, eaves}};
    std::vector<Eigen::Vector3i> f = {{0, 2, 3}, {0, 3, 1}, {0, 1, 5}, {0, 5, 4},
                                      {0, 4, 2}, {1, 3, 5}, {2, 4, 5}, {2, 5, 3}};
    if (!along_x)
      for (Vec3& p : v) p = Vec3(p.y(), p.x(), p.z());
    // Mirrored once per swap and once per turning upside down.
    if (along_x == (eaves > ridge))
      for (Eigen::Vector3i& t : f) std::swap(t[0], t[1]);
    return shapes::mesh_of(v, f);
  };
  Meeting meeting;
  meeting.add(roof(0, -0.01, true));
  meeting.add(roof(-0.0004, 0.01, false));
  meeting.pair(0, 1, 0.0002f).reach = 0.03f;
  const auto gap = [&] { return meeting.particles[1].position(0).z() - meeting.particles[0].position(0).z(); };
  EXPECT_LT(gap(), 0);
  EXPECT_GT(meeting.solve(1), 0);
  meeting.solve(30);
  EXPECT_GT(gap(), 0.00019f);
}

TEST(SurfaceContact, lets_go_of_what_is_torn_from_its_neighbors_until_the_step_ends) {
  Meeting meeting = pressed_balls(0.0005);
  Index tip = 0;
  for (Index p = 0; p < meeting.particles[0].count(); ++p)
    if (meeting.particles[0].position(p).x() > meeting.particles[0].position(tip).x()) tip = p;
  const Vector3f home = meeting.particles[0].position(tip), away = home + Vector3f(0.004f, 0, 0);
  meeting.particles[0].position(tip) = away;
  EXPECT_GT(meeting.solve(1), 0) << "the rest is pushed";
  EXPECT_EQ(meeting.particles[0].position(tip), away);

  meeting.particles[0].position(tip) = home;
  const auto places = meeting.pointers<const Particles*>(meeting.particles);
  meeting.follow();
  EXPECT_TRUE(meeting.state.torn[0][static_cast<std::size_t>(tip)]) << "in this step";
  remember_places(places, meeting.state);
  meeting.follow();
  EXPECT_FALSE(meeting.state.torn[0][static_cast<std::size_t>(tip)]) << "in the next";
}

TEST(SurfaceContact, an_overlap_that_is_allowed_stays) {
  Meeting meeting = pressed_balls(0.001);
  meeting.crowd.pairs[0].first_gap.assign(meeting.crowd.pairs[0].first_gap.size(), -0.0011f);
  meeting.crowd.pairs[0].second_gap.assign(meeting.crowd.pairs[0].second_gap.size(), -0.0011f);
  EXPECT_EQ(meeting.solve(3), 0);
}

TEST(SurfaceContact, friction_holds_back_what_slides_and_nothing_else_does) {
  const auto slid = [](float friction) {
    Meeting meeting;
    meeting.add(shapes::box({-0.02, -0.02, -0.02}, {0.02, 0.02, 0}), 0);
    meeting.add(shapes::sphere({0, 0, 0.0099}, 0.01, 4));
    meeting.pair(0, 1, 0.0002f);
    meeting.crowd.settings.friction = friction;
    meeting.start = meeting.particles;
    for (Index p = 0; p < meeting.start[1].count(); ++p) meeting.start[1].position(p).x() -= 0.0001f;
    Index lowest = 0;
    for (Index p = 0; p < meeting.particles[1].count(); ++p)
      if (meeting.particles[1].position(p).z() < meeting.particles[1].position(lowest).z()) lowest = p;
    meeting.solve(1);
    return meeting.particles[1].position(lowest).x() - meeting.start[1].position(lowest).x();
  };
  EXPECT_NEAR(slid(0), 0.0001f, 2e-6f);
  EXPECT_NEAR(slid(10), 0, 2e-6f);
  const float some = slid(0.1f);
  EXPECT_GT(some, 0.00002f);
  EXPECT_LT(some, 0.00009f);
}

TEST(SurfaceContact, cohesion_holds_together_what_touched_and_lets_it_slide) {
  const auto parted = [](float cohesion, char touched) {
    Meeting meeting;
    meeting.add(shapes::box({-0.02, -0.02, -0.02}, {0.02, 0.02, 0}), 0);
    meeting.add(shapes::sphere({0.003, 0, 0.013}, 0.01, 4));
    SurfacePair& pair = meeting.pair(0, 1, 0.0002f);
    pair.first_touches.assign(pair.first_touches.size(), touched);
    Index lowest = 0;
    for (Index p = 0; p < meeting.particles[1].count(); ++p)
      if (meeting.particles[1].position(p).z() < meeting.particles[1].position(lowest).z()) lowest = p;
    pair.second_touches[static_cast<std::size_t>(lowest)] = touched;
    meeting.crowd.settings.cohesion = cohesion;
    meeting.solve(30);
    EXPECT_NEAR(meeting.particles[1].position(lowest).x(), 0.003f, 1e-6f);
    return meeting.particles[1].position(lowest).z();
  };
  EXPECT_NEAR(parted(0, 1), 0.003f, 1e-6f);
  EXPECT_NEAR(parted(0.001f, 0), 0.003f, 1e-6f);
  EXPECT_NEAR(parted(0.001f, 1), 0.001f, 1e-6f);
}

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

TEST(SurfaceContact, what_was_found_is_trusted_until_something_has_drifted_by_two_fifths_of_the_reach) {
  Meeting meeting = pressed_balls(-0.001);
  meeting.prepare();
  meeting.find();
  const PairTouches& touches = meeting.state.touches[0];
  const std::size_t found = touches.near_second.size();
  EXPECT_GT(found, 10u);
  meeting.move(1, {-0.0023f, 0, 0});
  meeting.find();
  EXPECT_EQ(touches.near_second.size(), found);
  meeting.move(1, {-0.0002f, 0, 0});
  meeting.find();
  EXPECT_GT(touches.near_second.size(), found) << "what came near is found";
  EXPECT_EQ(touches.drift, 0);
}

TEST(SurfaceContact, drifts_there_and_back_add_up) {
  Meeting meeting = pressed_balls(-0.001);
  meeting.prepare();
  meeting.find();
  for (const float way : {0.0013f, -0.0013f}) {
    meeting.move(1, {0, way, 0});
    meeting.follow();
  }
  EXPECT_NEAR(meeting.state.touches[0].drift, 0.0026, 1e-6);
  meeting.find();
  EXPECT_EQ(meeting.state.touches[0].drift, 0) << "it was searched again";
}

TEST(SurfaceContact, every_update_period_th_frame_searches_everything) {
  Meeting meeting = pressed_balls(-0.001);
  meeting.crowd.settings.update_period = 2;
  meeting.prepare();
  const auto found = [&] {
    begin_touch_frame(meeting.crowd, meeting.state);
    meeting.find();
    return meeting.state.touches[0].near_second.size();
  };
  const std::size_t first = found();
  meeting.move(1, {-0.001f, 0, 0});
  EXPECT_EQ(found(), first) << "nothing drifted far";
  EXPECT_GT(found(), first);
}

TEST(SurfaceContact, within_a_step_lists_stay_where_hardly_anything_moves) {
  Meeting meeting = pressed_balls(-0.001);
  meeting.prepare();
  meeting.find();
  meeting.follow();
  const std::vector<PointTouch>& listed = meeting.state.touches[0].on_second;
  const auto nearest = [&] {
    float least = 1;
    for (const PointTouch& touch : listed) least = std::min(least, touch.distance);
    return least;
  };
  EXPECT_NEAR(nearest(), 0.001, 1e-4);
  meeting.move(1, {-0.0004f, 0, 0});
  meeting.follow();
  EXPECT_NEAR(nearest(), 0.001, 1e-4);
  meeting.move(1, {-0.0004f, 0, 0});
  meeting.follow();
  EXPECT_NEAR(nearest(), 0.0002, 1e-4) << "0.8 mm in all";
  meeting.move(1, {0.0004f, 0, 0});
  meeting.find();
  meeting.follow();
  EXPECT_NEAR(nearest(), 0.0006, 1e-4) << "a new step looks again";
}

TEST(SurfaceContact, gives_the_same_bits_for_any_number_of_threads) {
  std::vector<std::uint64_t> hashes;
  for (int threads : {1, 2, 64}) {
    const ThreadLimit limit(threads);
    Meeting meeting;
    meeting.add(shapes::sphere(Vec3::Zero(), 0.01, 5));
    meeting.add(shapes::sphere({0.0192, 0, 0}, 0.01, 5));
    meeting.add(shapes::sphere({0.0095, 0.0165, 0}, 0.01, 5));
    for (Index a = 0; a < 3; ++a)
      for (Index b = a; b < 3; ++b) meeting.pair(a, b, 0.0003f);
    EXPECT_GT(meeting.solve(10), 0);
    std::uint64_t hash = hash_seed;
    for (const Particles& each : meeting.particles) hash = hash_of(each.xyzw, hash);
    hashes.push_back(hash);
  }
  EXPECT_EQ(hashes[0], hashes[1]);
  EXPECT_EQ(hashes[0], hashes[2]);
}

TEST(SurfaceContact, rounds_hold_no_surface_twice) {
  Meeting meeting;
  for (int i = 0; i < 4; ++i) meeting.add(shapes::sphere({0.1 * i, 0, 0}, 0.01, 2));
  for (Index a = 0; a < 4; ++a)
    for (Index b = a; b < 4; ++b) meeting.pair(a, b, 0);
  arrange_rounds(meeting.crowd);
  std::size_t listed = 0;
  for (const std::vector<Index>& round : meeting.crowd.rounds) {
    std::vector<int> used(4, 0);
    for (Index i : round) {
      const SurfacePair& pair = meeting.crowd.pairs[static_cast<std::size_t>(i)];
      ++used[static_cast<std::size_t>(pair.first)];
      if (!pair.is_self()) ++used[static_cast<std::size_t>(pair.second)];
      ++listed;
    }
    for (int count : used) EXPECT_LE(count, 1);
  }
  EXPECT_EQ(listed, 10u);
}

TEST(SurfaceContact, a_surface_that_cuts_itself_is_mended_and_says_so) {
  Meeting meeting;
  meeting.add(shapes::sphere(Vec3::Zero(), 0.01, 4));
  meeting.pair(0, 0, 0.0003f).reach = 0.001f;
  meeting.prepare();
  const auto mend = [&](int attempt) {
    meeting.find();
    meeting.follow();
    Movers movers;
    return mend_surfaces(meeting.crowd, meeting.state, attempt, meeting.pointers<Particles*>(meeting.particles),
                         movers);
  };
  const Particles whole = meeting.particles[0];
  EXPECT_FALSE(mend(0));
  EXPECT_EQ(largest_motion(whole, meeting.particles[0]), 0);
  // Over and under its neighbors.
  const Vector3f place = whole.position(7);
  meeting.particles[0].position(7) = 0.95f * place + Vector3f(-place.y(), place.x(), 0).normalized() * 0.004f;
  EXPECT_TRUE(mend(0));
  for (int attempt = 1; attempt < 4 && mend(attempt);) ++attempt;
  EXPECT_FALSE(mend(0)) << "all is mended";
  EXPECT_LT(largest_motion(whole, meeting.particles[0]), 0.003f);
}

/// A ball of which a particle lies over its neighbors, so that faces have folded.
static Meeting folded_ball(bool lies_in_another) {
  Meeting meeting;
  for (const Real x : {0.0, 0.1}) meeting.add(shapes::sphere({x, 0, 0}, 0.01, 4));
  meeting.pair(0, 0, 0.0003f).reach = 0.001f;
  if (lies_in_another) meeting.pair(0, 1, 0.0003f).first_overlaps.assign(meeting.crowd.rest[0].cols(), 1);
  meeting.prepare();
  const Vector3f place = meeting.particles[0].position(7);
  meeting.particles[0].position(7) = 1.03f * place + Vector3f(-place.y(), place.x(), 0).normalized() * 0.0022f;
  return meeting;
}

static bool mend_once(Meeting& meeting, int attempt = 0) {
  meeting.find();
  meeting.follow();
  Movers movers;
  return mend_surfaces(meeting.crowd, meeting.state, attempt, meeting.pointers<Particles*>(meeting.particles), movers);
}

TEST(SurfaceContact, a_surface_that_has_folded_is_mended_though_it_cuts_nothing) {
  Meeting meeting = folded_ball(false);
  const auto is_folded = [&] {
    return !find_folds(meeting.crowd.surfaces[0], meeting.crowd.rest[0], meeting.state.before[0], meeting.particles[0])
                .empty();
  };
  std::vector<Index> faces(static_cast<std::size_t>(meeting.crowd.surfaces[0].faces.cols()));
  std::iota(faces.begin(), faces.end(), 0);
  EXPECT_TRUE(find_self_cuts(meeting.crowd.surfaces[0], meeting.crowd.rest[0], meeting.state.before[0],
                             meeting.particles[0], faces)
                  .empty());
  EXPECT_TRUE(is_folded());
  EXPECT_TRUE(mend_once(meeting));
  EXPECT_FALSE(is_folded());
}

TEST(SurfaceContact, lets_go_of_what_folded_on_its_way_out_of_a_surface_that_it_lies_in_at_rest) {
  Meeting meeting = folded_ball(true);
  ASSERT_TRUE(mend_once(meeting));
  EXPECT_TRUE(meeting.state.torn[0][7]);
  EXPECT_FALSE(meeting.state.torn[0][100]) << "not folded";
  remember_places(meeting.pointers<const Particles*>(meeting.particles), meeting.state);
  EXPECT_FALSE(meeting.state.torn[0][7]) << "in the next step";
}

TEST(SurfaceContact, what_folded_elsewhere_is_mended_in_the_first_attempts_only) {
  Meeting meeting = folded_ball(false);
  EXPECT_FALSE(mend_once(meeting, 2));
  EXPECT_TRUE(mend_once(meeting, 0));
  EXPECT_FALSE(meeting.state.torn[0][7]);
}

TEST(SurfaceContact, mending_leaves_only_what_was_mended_among_the_movers) {
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
  Movers movers{{1, 0, 1}};
  const Particles left_alone = meeting.particles[1];
  EXPECT_TRUE(mend_surfaces(meeting.crowd, meeting.state, 0, meeting.pointers<Particles*>(meeting.particles), movers));
  EXPECT_EQ(movers.listed, std::vector<char>({1, 0, 0}));
  EXPECT_EQ(largest_motion(left_alone, meeting.particles[1]), 0);
}

TEST(SurfaceContact, a_mover_gives_way_alone_to_what_stays) {
  Meeting meeting;
  meeting.add(shapes::sphere(Vec3::Zero(), 0.01, 4));
  meeting.add(shapes::sphere({0.0199, 0, 0}, 0.01, 4));
  meeting.pair(0, 1, 0.0003f);
  meeting.prepare();
  meeting.start = meeting.particles;
  meeting.find();
  meeting.follow();
  EXPECT_GT(project_touches(meeting.crowd, meeting.state, meeting.pointers<const Particles*>(meeting.start),
                            meeting.pointers<Particles*>(meeting.particles), {{1, 0}}),
            0);
  EXPECT_GT(largest_motion(meeting.start[0], meeting.particles[0]), 0);
  EXPECT_EQ(largest_motion(meeting.start[1], meeting.particles[1]), 0);
}

}  // namespace gracilis
