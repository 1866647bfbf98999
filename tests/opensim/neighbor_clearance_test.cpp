#include <gracilis/opensim/import/neighbor_clearance.hpp>

#include <shapes.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

namespace gracilis::opensim {

/// Along z, beside the origin at x.
static RoundMuscle upright(Real x, Real radius) {
  RoundMuscle muscle{Points::Zero(3, 11), Eigen::VectorXd::Constant(11, radius)};
  for (Eigen::Index k = 0; k < 11; ++k) muscle.centers.col(k) = Vec3(x, 0, 0.02 * static_cast<Real>(k) - 0.1);
  return muscle;
}

TEST(NeighborClearance, muscles_of_one_size_meet_half_way) {
  const RoomBeside room = room_beside({upright(0.03, 0.02)});
  EXPECT_NEAR(room(Vec3::Zero(), Vec3::UnitX(), 0.02, 0.04), 0.015 - 0.00025, 1e-6);
  EXPECT_EQ(room(Vec3::Zero(), -Vec3::UnitX(), 0.02, 0.04), 0.04);
}

TEST(NeighborClearance, a_thin_muscle_leaves_more_to_a_thick_one) {
  const RoomBeside beside_thin = room_beside({upright(0.03, 0.01)}), beside_thick = room_beside({upright(0.03, 0.02)});
  EXPECT_NEAR(beside_thin(Vec3::Zero(), Vec3::UnitX(), 0.02, 0.04), 0.02 - 0.00025, 1e-6);
  EXPECT_NEAR(beside_thick(Vec3::Zero(), Vec3::UnitX(), 0.01, 0.04), 0.01 - 0.00025, 1e-6);
}

TEST(NeighborClearance, a_muscle_on_the_same_line_leaves_no_room_and_a_far_one_all) {
  EXPECT_EQ(room_beside({upright(0, 0.02)})(Vec3::Zero(), Vec3::UnitX(), 0.02, 0.04), 0);
  EXPECT_EQ(room_beside({upright(0.5, 0.02)})(Vec3::Zero(), Vec3::UnitX(), 0.02, 0.04), 0.04);
  EXPECT_EQ(room_beside({})(Vec3::Zero(), Vec3::UnitX(), 0.02, 0.04), 0.04);
}

/// Of a polygon by its corners' distances from its center.
static Real area(const Eigen::VectorXd& radii) {
  const Eigen::Index n = radii.size();
  Real sum = 0;
  for (Eigen::Index i = 0; i < n; ++i) sum += radii[i] * radii[(i + 1) % n];
  return sum * std::sin(2 * pi / static_cast<Real>(n)) / 2;
}

TEST(NeighborClearance, a_muscle_pressed_against_another_keeps_its_volume_and_gets_no_steps) {
  const RoundMuscle muscle = upright(0, 0.02);
  // It crosses the upper half, 18 mm away.
  RoundMuscle other{Points(3, 2), Eigen::VectorXd::Constant(2, 0.02)};
  other.centers << 0.018, 0.018, -0.1, 0.1, 0.06, 0.06;
  const ClearSections clear = clear_of_bones(muscle.centers, muscle.radii, 12, {}, room_beside({other}));
  EXPECT_EQ(clear.centers, muscle.centers);
  EXPECT_NEAR(clear.volume_share, 1, 0.01);
  Real volume = 0, smallest = 1;
  for (Eigen::Index k = 0; k + 1 < 11; ++k) {
    volume += 0.02 * (area(clear.radii.col(k)) + area(clear.radii.col(k + 1))) / 2;
    smallest = std::min(smallest, clear.radii.col(k).minCoeff());
    EXPECT_LE((clear.radii.col(k + 1) - clear.radii.col(k)).cwiseAbs().maxCoeff(), 0.5 * 0.02 + 1e-12) << k;
  }
  EXPECT_NEAR(volume / (0.2 * area(Eigen::VectorXd::Constant(12, 0.02))), 1, 0.01);
  EXPECT_NEAR(smallest, 0.009, 0.0003) << "they meet half way";
}

/// A belly between two tendons, 20 mm wide in the middle.
static RoundMuscle spindle(Real x) {
  RoundMuscle muscle = upright(x, 0.003);
  muscle.radii << 0.003, 0.003, 0.008, 0.014, 0.018, 0.02, 0.018, 0.014, 0.008, 0.003, 0.003;
  return muscle;
}

TEST(NeighborClearance, a_tendon_through_a_belly_goes_to_the_side_where_most_of_it_lies) {
  RoundMuscle tendon = upright(0, 0.003);
  tendon.centers(0, 5) = 0.006;  // on the other side of the belly's middle
  const RoundMuscle belly = spindle(0.004);
  const Points beside = beside_bellies(tendon, {belly});
  EXPECT_EQ(beside.col(0), tendon.centers.col(0));
  EXPECT_EQ(beside.col(10), tendon.centers.col(10));
  for (Eigen::Index k = 3; k < 8; ++k) {
    EXPECT_LT(beside(0, k), belly.centers(0, k) - 0.6 * belly.radii[k]) << k << ": the line stays soft";
    EXPECT_NEAR(beside(1, k), 0, 1e-12);
  }
}

TEST(NeighborClearance, a_tendon_leans_softly_out_of_a_belly_and_by_30_mm_at_most) {
  const RoundMuscle tendon = upright(0, 0.003);
  RoundMuscle belly = upright(0.004, 0.003);
  belly.radii.segment(5, 3).setConstant(0.06);
  const Points way = beside_bellies(tendon, {belly}) - tendon.centers;
  EXPECT_GT(way.colwise().norm().maxCoeff(), 0.02);
  EXPECT_LE(way.colwise().norm().maxCoeff(), 0.03 + 1e-9);
  for (Eigen::Index k = 0; k < 10; ++k) EXPECT_LE((way.col(k + 1) - way.col(k)).norm(), 0.5 * 0.02 + 1e-9) << k;
}

TEST(NeighborClearance, a_muscle_that_gives_way_does_not_go_through_a_bone) {
  std::vector<SolidBone> bones;
  bones.emplace_back(shapes::box({-0.012, -0.05, -0.2}, {-0.01, 0.05, 0.2}));
  const std::map<std::string, RoundMuscle> beside =
      beside_bellies({{"left", spindle(0)}, {"right", spindle(0.004)}}, bones);
  const Points& left = beside.at("left").centers;
  EXPECT_LT(left.row(0).minCoeff(), -0.003) << "it gives way";
  EXPECT_GT(left.row(0).minCoeff(), -0.01) << "up to the plate, of which the other side is near";
}

TEST(NeighborClearance, a_muscle_on_the_line_of_another_is_no_thread) {
  const RoundMuscle muscle = upright(0, 0.02);
  const ClearSections clear = clear_of_bones(muscle.centers, muscle.radii, 12, {}, room_beside({muscle}));
  EXPECT_GE(clear.radii.minCoeff(), 0.4 * 0.02 - 1e-12);
}

TEST(NeighborClearance, muscles_that_leave_each_other_room_stay_on_their_lines) {
  const RoundMuscle belly = spindle(0.021), other = spindle(0), tendon = upright(-0.03, 0.003);
  EXPECT_EQ(beside_bellies(other, {belly}), other.centers) << "half of their radii lies between them";
  EXPECT_EQ(beside_bellies(tendon, {belly}), tendon.centers);
  EXPECT_EQ(beside_bellies(tendon, {}), tendon.centers);
}

TEST(NeighborClearance, of_two_bellies_on_nearly_one_line_each_gives_way_to_its_side) {
  const RoundMuscle left = spindle(0), right = spindle(0.004);
  const Points to_left = beside_bellies(left, {right}), to_right = beside_bellies(right, {left});
  for (Eigen::Index k = 0; k < 11; ++k) {
    EXPECT_NEAR(to_left(0, k) + to_right(0, k), 0.004, 1e-9) << k << ": they are as thick";
    EXPECT_LE(to_left(0, k), 0) << k;
  }
  EXPECT_GT(to_right(0, 5) - to_left(0, 5), 0.8 * 0.02) << "half of their radii, but for what softness takes";
}

TEST(NeighborClearance, of_tendons_that_run_together_none_is_left_without_room) {
  std::map<std::string, RoundMuscle> muscles;
  for (const auto& [name, place] : std::map<std::string, Vec3>{
           {"a", {0, 0, 0}}, {"b", {0.001, 0, 0}}, {"c", {0, 0.001, 0}}, {"d", {0.001, 0.0015, 0}}}) {
    muscles[name] = upright(0, 0.006);
    muscles[name].centers.colwise() += place;
  }
  const std::map<std::string, RoundMuscle> beside = beside_bellies(muscles, {});
  for (const auto& [one, muscle] : beside)
    for (const auto& [other, neighbor] : beside)
      for (Eigen::Index k = 3; k < 8 && one < other; ++k)
        EXPECT_GT((muscle.centers.col(k) - neighbor.centers.col(k)).norm(), 0.7 * 0.006) << one << other << k;
}

}  // namespace gracilis::opensim
