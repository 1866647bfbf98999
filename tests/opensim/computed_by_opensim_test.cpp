#include <gracilis/io/table.hpp>
#include <gracilis/opensim/coordinate_motion.hpp>
#include <gracilis/opensim/model_reader.hpp>
#include <gracilis/opensim/muscle_path.hpp>

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
    const std::filesystem::path folder = std::filesystem::path(GRACILIS_SOURCE_DIR) / "tests" / "opensim" / "reference";
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

  /// Calls see(row, error, wraps touched) for every pose; the error is in m.
  void compare(const Muscle& muscle, const std::function<void(Eigen::Index, Real, std::size_t)>& see) const {
    for_each_pose(muscle, [&](Eigen::Index row, const Skeleton& skeleton, const Eigen::VectorXd& q, Real theirs) {
      std::size_t wraps = 0;
      for (const PathStop& stop : current_points(model, muscle.path, skeleton.poses(), q)) wraps += stop.wrap >= 0;
      see(row, measure_path(skeleton, muscle.path, q).length - theirs, wraps / 2);
    });
  }
};

/// Lays the wrap around alone, without those that are there; its points get this number.
void lay_one(const PlacedWrap& wrap, int number, std::vector<PathStop>& points) {
  std::erase_if(points, [&](const PathStop& point) { return point.wrap == number; });
  for (PathStop& point : points)
    if (point.wrap >= 0) ++point.wrap;  // out of the way of the 0 that it gets
  lay_around({wrap}, points);
  for (PathStop& point : points) {
    if (point.given >= 0) continue;
    point.wrap = point.wrap == 0 ? number : point.wrap - 1;
  }
}

/// What OpenSim 4 sums of a line around two wraps, README.md: the straight parts as its first round leaves them, the
/// arcs as its third does, after which its sum does not change any more.
Real summed_by_opensim(const std::vector<PlacedWrap>& wraps, std::vector<PathStop> points) {
  const auto lay_both = [&] {
    for (std::size_t i = 0; i < 2; ++i) lay_one(wraps[i], static_cast<int>(i), points);
  };
  const auto arcs = [&] {
    Real sum = 0;
    for (std::size_t i = 1; i < points.size(); ++i)
      if (points[i].wrap >= 0 && points[i].wrap == points[i - 1].wrap) sum += points[i].around.length;
    return sum;
  };
  lay_both();
  const Real straight = length_of(points) - arcs();
  lay_both();
  lay_both();
  return straight + arcs();
}

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
    // What OpenSim takes for a tangent, README.md.
    const Real tolerance = muscle.name == "psoas_r" ? 2e-6 : 1e-6;
    reference.compare(muscle, [&](Eigen::Index row, Real error, std::size_t wraps) {
      once += wraps == 1, twice += wraps > 1;
      EXPECT_LT(std::abs(error), wraps > 1 ? 5e-3 : tolerance) << muscle.name << ", row " << row;
    });
  }
  EXPECT_GT(once, 30);
  EXPECT_EQ(twice, 10) << "where OpenSim's own lengths are not those of its ways, README.md";
}

TEST(ComputedByOpenSim, lines_around_two_cylinders_differ_by_what_it_sums) {
  const Reference reference("rajagopal18_right");
  const Model& model = reference.model;
  const Index number = index_of(model.muscles, "med_gas_r");
  ASSERT_GE(number, 0);
  const Muscle& muscle = model.muscles[static_cast<std::size_t>(number)];
  int twice = 0;
  reference.for_each_pose(
      muscle, [&](Eigen::Index row, const Skeleton& skeleton, const Eigen::VectorXd& q, Real theirs) {
        std::vector<PathStop> points = current_points(model, muscle.path, skeleton.poses(), q);
        if (std::erase_if(points, [](const PathStop& point) { return point.given < 0; }) < 4) return;
        ++twice;
        EXPECT_NEAR(summed_by_opensim(placed_wraps(model, muscle.path, skeleton.poses()), points), theirs, 4e-6)
            << "row " << row;
      });
  EXPECT_EQ(twice, 10);
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
