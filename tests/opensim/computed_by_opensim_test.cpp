#include <gracilis/io/tables/table.hpp>
#include <gracilis/opensim/kinematics/coordinate_motion.hpp>
#include <gracilis/opensim/paths/length_by_opensim.hpp>
#include <gracilis/opensim/reader/model_reader.hpp>

#include <build_paths.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <string>

/// Lengths of muscles against those that OpenSim computed; reference/README.md says where they are from.
namespace gracilis::opensim {

namespace {

struct Reference {
  Model model;
  Table table;

  explicit Reference(const std::string& name) {
    const std::filesystem::path folder =
        std::filesystem::path(build_paths::source_folder) / "tests" / "opensim" / "reference";
    model = read_model(folder / (name + ".osim"));
    table = read_table(folder / (name + ".sto"));
  }

  /// Calls see(row, skeleton, coordinates, its length by OpenSim in m) for every pose.
  void for_each_pose(
      const Muscle& muscle,
      const std::function<void(Eigen::Index, const Skeleton&, const Eigen::VectorXd&, Real)>& see) const {
    const auto column = column_of(table, muscle.name);
    ASSERT_TRUE(column) << muscle.name;
    const CoordinateMotion motion = coordinate_motion(model, table);
    Skeleton skeleton(model);
    for (Eigen::Index row = 0; row < table.values.rows(); ++row) {
      const Eigen::VectorXd q = motion.values.row(row);
      skeleton.place(q);
      see(row, skeleton, q, table.values(row, *column));
    }
  }

  /// Calls see(row, error, wraps touched) for every pose; the error of length_by_opensim is in m.
  void compare(const Muscle& muscle, const std::function<void(Eigen::Index, Real, std::size_t)>& see) const {
    for_each_pose(muscle, [&](Eigen::Index row, const Skeleton& skeleton, const Eigen::VectorXd& q, Real theirs) {
      std::size_t wraps = 0;
      for (const PathStop& stop : current_points(model, muscle.path, skeleton.poses(), q)) wraps += stop.wrap >= 0;
      see(row, length_by_opensim(skeleton, muscle.path, q) - theirs, wraps / 2);
    });
  }
};

}  // namespace

TEST(ComputedByOpenSim, lines_with_fixed_conditional_and_moving_points_are_as_long) {
  const Reference reference("gait1018_right");
  ASSERT_EQ(reference.model.muscles.size(), 9u);
  ASSERT_EQ(reference.table.values.rows(), 16);
  for (const Muscle& muscle : reference.model.muscles)
    reference.compare(muscle, [&](Eigen::Index row, Real error, std::size_t) {
      EXPECT_LT(std::abs(error), 2e-7) << muscle.name << ", row " << row;
    });
}

TEST(ComputedByOpenSim, lines_around_cylinders_are_as_long) {
  const Reference reference("rajagopal18_right");
  ASSERT_EQ(reference.model.muscles.size(), 9u);
  ASSERT_EQ(reference.table.values.rows(), 17);
  int once = 0, twice = 0;
  for (const Muscle& muscle : reference.model.muscles) {
    reference.compare(muscle, [&](Eigen::Index row, Real error, std::size_t wraps) {
      once += wraps == 1, twice += wraps > 1;
      // Where there are several it is content with less than a tangent, README.md.
      const Real tolerance = muscle.path.wraps.size() < 2 ? 2e-10 : wraps < 2 ? 1e-7 : 4e-6;
      EXPECT_LT(std::abs(error), tolerance) << muscle.name << ", row " << row;
    });
  }
  EXPECT_GT(once, 30);
  EXPECT_EQ(twice, 10);
}

TEST(ComputedByOpenSim, lengths_around_two_cylinders_are_not_those_of_a_way) {
  const Reference reference("rajagopal18_right");
  const Index number = index_of(reference.model.muscles, "med_gas_r");
  ASSERT_GE(number, 0);
  const Path& path = reference.model.muscles[static_cast<std::size_t>(number)].path;
  Real most = 0;
  reference.for_each_pose(reference.model.muscles[static_cast<std::size_t>(number)],
                          [&](Eigen::Index, const Skeleton& skeleton, const Eigen::VectorXd& q, Real theirs) {
                            most = std::max(most, measure_path(skeleton, path, q).length - theirs);
                          });
  EXPECT_NEAR(most, 4.4e-3, 1e-5);
}

TEST(ComputedByOpenSim, lines_around_ellipsoids_are_as_long_but_for_the_chords_that_it_sums) {
  const Reference reference("arm26_right");
  ASSERT_EQ(reference.table.values.rows(), 12);
  for (const Muscle& muscle : reference.model.muscles) {
    const bool around = muscle.name == "BIClong";
    reference.compare(muscle, [&](Eigen::Index row, Real error, std::size_t wraps) {
      if (around) {
        EXPECT_EQ(wraps, 1u) << "row " << row;
      }
      // Chords are shorter than arcs. In row 2 the fiber's speed, from which BICshort's length is known, jumps.
      const Real least = around ? 0 : muscle.name == "BICshort" && row == 2 ? -3e-6 : -3e-7;
      EXPECT_GT(error, least) << muscle.name << ", row " << row;
      EXPECT_LT(error, around ? 3e-6 : -least) << muscle.name << ", row " << row;
    });
  }
}

}  // namespace gracilis::opensim
