#include <gracilis/dynamics/contact/field/field_contact.hpp>
#include <gracilis/dynamics/contact/field/field_contact_guard.hpp>
#include <gracilis/dynamics/contact/field/field_contact_near.hpp>
#include <gracilis/dynamics/contact/field/two_obstacle_contact.hpp>

#include "systems_for_tests.hpp"

#include <gtest/gtest.h>

namespace gracilis {
namespace {

constexpr Real half_width = 0.15, half_thickness = 0.0015;
constexpr float gap = 0.0005f;

/// The exact distance to a plate of 300 × 300 × 3 mm across z, on cells of 1 mm.
const DistanceField& plate() {
  static const DistanceField field = [] {
    DistanceField f;
    f.nodes = {325, 325, 28};
    f.cell_size = Vec3::Constant(0.001);
    f.origin = Vec3(-0.162, -0.162, -0.0135);
    for (int k = 0; k < f.nodes[2]; ++k)
      for (int j = 0; j < f.nodes[1]; ++j)
        for (int i = 0; i < f.nodes[0]; ++i) {
          const Vec3 p = f.origin + 0.001 * Vec3(i, j, k);
          const Vec3 q = p.cwiseAbs() - Vec3(half_width, half_width, half_thickness);
          f.values.push_back(static_cast<float>(q.cwiseMax(0).norm() + std::min(q.maxCoeff(), 0.0)));
        }
    return f;
  }();
  return field;
}

FieldContactSet contact_with_plate(std::size_t count, MotionGuard guard) {
  FieldContactSet contact;
  contact.field = bounded(plate());
  contact.captured.particle.assign(count, gap);
  contact.released.particle.assign(count, gap);
  contact.guard = guard;
  return contact;
}

Particles particles_at(const Points& points) { return make_particles(points, Eigen::VectorXd::Ones(points.cols())); }

struct Shot {
  Vec3 from, to;
};

/// Shots of 1 m from above the plate that would cross it.
std::vector<Shot> shots(int count) {
  std::mt19937 generator(11);
  std::uniform_real_distribution<Real> uniform(-1, 1);
  std::vector<Shot> all;
  while (static_cast<int>(all.size()) < count) {
    const Vec3 from(0.1 * uniform(generator), 0.1 * uniform(generator), 0.1025 + 0.1 * uniform(generator));
    const Vec3 along = Vec3(uniform(generator), uniform(generator), uniform(generator)).normalized();
    const Real t = from.z() / -along.z();
    const Vec3 through = from + t * along;
    if (from.z() < 0.0021 || !(t > 0 && t < 1) || through.cwiseAbs().maxCoeff() > 0.14) continue;
    // Those nearly along the plate may rightly slide off its rim.
    if (along.head<2>().norm() < 0.1) all.push_back({from, from + along});
  }
  return all;
}

/// Where particles end that are moved from `before` to `after` while the plate moves, too: in the plate's frame.
Points ends_of(const Points& before, const FieldPlacement& placed_before, const Points& after,
               const FieldPlacement& placed_after, MotionGuard guard) {
  const FieldContactSet contact = contact_with_plate(static_cast<std::size_t>(before.cols()), guard);
  NearField near;
  Particles particles = particles_at(before);
  remember_sides(contact, placed_before, particles, near);
  particles = particles_at(after);
  find_near(contact, {}, {}, placed_after, 0.006f, particles, near);
  project_particle_contacts(contact, placed_after, near, particles);
  Points ends(3, before.cols());
  for (Index i = 0; i < ends.cols(); ++i) ends.col(i) = placed_after.to_obstacle(particles.position(i)).cast<Real>();
  return ends;
}

Index behind_the_plate(const Points& ends) {
  Index count = 0;
  for (Index i = 0; i < ends.cols(); ++i) count += ends(2, i) < half_thickness;
  return count;
}

}  // namespace

TEST(MotionGuard, no_bullet_passes_a_thin_plate) {
  const std::vector<Shot> all = shots(2000);
  Points before(3, 2000), after(3, 2000);
  for (Index i = 0; i < 2000; ++i)
    before.col(i) = all[static_cast<std::size_t>(i)].from, after.col(i) = all[static_cast<std::size_t>(i)].to;
  EXPECT_EQ(behind_the_plate(ends_of(before, {}, after, {}, MotionGuard::kept_path)), 0);
  EXPECT_EQ(behind_the_plate(ends_of(before, {}, after, {}, MotionGuard::none)), 2000) << "no guard, no bullets";
}

TEST(MotionGuard, no_particle_passes_a_plate_that_moves_like_a_bullet) {
  Points still(3, 200);
  std::mt19937 generator(12);
  std::uniform_real_distribution<Real> uniform(-1, 1);
  for (Index i = 0; i < still.cols(); ++i)
    still.col(i) = Vec3(0.1 * uniform(generator), 0.1 * uniform(generator), 0.05);
  // The plate rises by 1 m and turns by a degree or so; the particles do not move.
  FieldPlacement later;
  later.rotation = Eigen::Matrix3f(Eigen::AngleAxisf(0.02f, Eigen::Vector3f(1, 2, 3).normalized()));
  later.translation = Eigen::Vector3f(0, 0, -1);
  EXPECT_EQ(behind_the_plate(ends_of(still, {}, still, later, MotionGuard::kept_path)), 0);
  EXPECT_EQ(behind_the_plate(ends_of(still, {}, still, later, MotionGuard::none)), 200);
}

TEST(MotionGuard, lets_go_what_the_obstacle_does_not_stop) {
  Points before(3, 3), after(3, 3);
  before << 0, 0.2, 0.14, 0, 0, 0, 0.05, 0.05, 0.01;
  after << 0.02, 0.2, 0.5, 0.01, 0, 0, 0.3, -0.9, 0.01;  // away from it, past it, along it and off
  const Points ends = ends_of(before, {}, after, {}, MotionGuard::kept_path);
  EXPECT_LT((ends - after).colwise().norm().maxCoeff(), 1e-6);
}

TEST(MotionGuard, slides_along_what_stands_in_the_way) {
  Points before(3, 1), after(3, 1);
  before << 0, 0, 0.0025;
  after << 0.004, 0, -0.001;
  const Points ends = ends_of(before, {}, after, {}, MotionGuard::kept_path);
  EXPECT_NEAR(ends(0, 0), 0.004, 5e-4);
  EXPECT_NEAR(ends(2, 0), half_thickness + 0.0005, 1e-5);
}

TEST(MotionGuard, the_published_test_takes_back_a_particle_whose_direction_turned) {
  Points before(3, 2), after(3, 2);
  before << 0, 0.05, 0, 0, 0.004, 0.004;
  after << 0.001, 0.05, 0, 0, -0.004, 0.0012;  // through the plate; a little into it
  const Points ends = ends_of(before, {}, after, {}, MotionGuard::turned_direction);
  EXPECT_LT((ends.col(0) - before.col(0)).norm(), 1e-6);
  EXPECT_NEAR(ends(2, 1), half_thickness + 0.0005, 1e-5);
  EXPECT_EQ(behind_the_plate(ends_of(before, {}, after, {}, MotionGuard::none)), 1);
}

TEST(NearField, what_was_seen_before_changes_nothing_in_what_is_listed) {
  std::mt19937 generator(13);
  std::uniform_real_distribution<Real> uniform(-1, 1);
  Points points(3, 3000);
  for (Index i = 0; i < points.cols(); ++i)
    points.col(i) = Vec3(0.15 * uniform(generator), 0.15 * uniform(generator), 0.03 * uniform(generator));
  Particles particles = particles_at(points);
  const FieldContactSet contact = contact_with_plate(3000, MotionGuard::none);
  NearField remembering;
  for (int round = 0; round < 20; ++round) {
    shake(particles, 0.001f, static_cast<unsigned>(round));
    NearField fresh;
    Particles same = particles;
    find_near(contact, {}, {}, {}, 0.006f, particles, remembering);
    find_near(contact, {}, {}, {}, 0.006f, same, fresh);
    EXPECT_EQ(remembering.particles, fresh.particles);
    EXPECT_GT(fresh.particles.size(), 300u);
  }
}

TEST(Squeeze, a_particle_between_approaching_obstacles_moves_out_of_the_wedge) {
  // Two plates whose faces make a wedge of 20 degrees that opens towards -x; the particle sits where both press.
  const float angle = static_cast<float>(radians(10));
  std::vector<FieldContactSet> sets(2, contact_with_plate(1, MotionGuard::kept_path));
  std::vector<FieldPlacement> placements(2);
  for (int side : {0, 1}) {
    const float sign = side == 0 ? 1.0f : -1.0f;
    FieldPlacement& placement = placements[static_cast<std::size_t>(side)];
    placement.rotation = Eigen::Matrix3f(Eigen::AngleAxisf(sign * angle, Eigen::Vector3f::UnitY()));
    // The plate's inner face passes through the origin.
    placement.translation = Eigen::Vector3f(0, 0, sign * static_cast<float>(half_thickness));
  }
  Points points(3, 1);
  points << 0.001, 0.003, 0.0001;
  Particles particles = particles_at(points);
  std::vector<NearField> near(2);
  for (std::size_t i = 0; i < 2; ++i) find_near(sets[i], {}, {}, placements[i], 0.006f, particles, near[i]);
  for (int iteration = 0; iteration < 12; ++iteration) {
    for (std::size_t i = 0; i < 2; ++i) project_particle_contacts(sets[i], placements[i], near[i], particles);
    project_two_obstacle_contact(sets, placements, near, particles);
  }
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_GE(sample(plate(), placements[i].to_obstacle(particles.position(0))).distance, gap - 2e-5f);
  // Both gaps are kept where the wedge is 1 mm wide: at 0.5 mm / sin 10°.
  EXPECT_NEAR(particles.position(0).x(), -0.0005 / std::sin(radians(10)), 2e-4);
  EXPECT_NEAR(particles.position(0).y(), 0.003, 1e-5) << "not along the edge of the wedge";
}

TEST(Squeeze, between_parallel_obstacles_a_particle_goes_to_the_middle) {
  std::vector<FieldContactSet> sets(2, contact_with_plate(1, MotionGuard::kept_path));
  std::vector<FieldPlacement> placements(2);
  placements[0].translation = Eigen::Vector3f(0, 0, static_cast<float>(half_thickness));
  placements[1].translation = Eigen::Vector3f(0, 0, -static_cast<float>(half_thickness) - 0.0006f);
  Points points(3, 1);
  points << 0.01, 0, 0.0001;  // the plates leave 0.6 mm where 1 mm is needed
  Particles particles = particles_at(points);
  std::vector<NearField> near(2);
  for (std::size_t i = 0; i < 2; ++i) find_near(sets[i], {}, {}, placements[i], 0.006f, particles, near[i]);
  for (int iteration = 0; iteration < 10; ++iteration) {
    for (std::size_t i = 0; i < 2; ++i) project_particle_contacts(sets[i], placements[i], near[i], particles);
    project_two_obstacle_contact(sets, placements, near, particles);
  }
  EXPECT_NEAR(particles.position(0).z(), 0.0003, 5e-5);
  EXPECT_NEAR(particles.position(0).x(), 0.01, 1e-4);
}

TEST(Ceiling, a_particle_told_to_slide_comes_back_to_its_distance_and_may_move_along) {
  FieldContactSet contact = contact_with_plate(2, MotionGuard::kept_path);
  contact.ceiling = {0.002f, std::numeric_limits<float>::infinity()};
  Points points(3, 2);
  points << 0.01, 0.02, 0, 0, 0.012, 0.012;
  Particles particles = particles_at(points);
  NearField near;
  find_near(contact, {}, {}, {}, 0.006f, particles, near);
  EXPECT_EQ(project_particle_contacts(contact, {}, near, particles), 1);
  EXPECT_NEAR(particles.position(0).z(), half_thickness + 0.002, 1e-5);
  EXPECT_NEAR(particles.position(0).x(), 0.01, 1e-6);
  EXPECT_EQ(particles.position(1).z(), 0.012f);
  particles.position(0).x() += 0.02f;
  EXPECT_EQ(project_particle_contacts(contact, {}, near, particles), 0) << "free along the surface";
}

}  // namespace gracilis
