#include <gracilis/anatomy/fibers/fascicles.hpp>
#include <gracilis/anatomy/fibers/muscle_fibers.hpp>
#include <gracilis/io/mesh/polyline_file.hpp>

#include "scenarios/scenario_runs.hpp"

#include <fascicle_measures.hpp>
#include <pennate_muscles.hpp>

#include <gtest/gtest.h>

#include <functional>

/// A medial gastrocnemius whose fascicles were measured. What must hold: 12 degrees in the median, 35 at 95 %, the mean
/// length within a tenth.
namespace gracilis {
namespace {

struct Gastrocnemius {
  Muscle muscle;
  Polylines tracts;

  static bool is_here() { return std::filesystem::exists(data_folder() / "fascicles/mg.toml"); }
  Gastrocnemius()
      : muscle(read_scene(data_folder() / "fascicles/mg.toml", {}).scene.muscles.at(0)),
        tracts(read_polylines(data_folder() / "fascicles/mg_tracts.csv", 1)) {}

  Polylines chosen(const std::function<bool(Index)>& is_chosen) const {
    std::vector<Points> lines;
    for (Index i = 0; i < tracts.count(); ++i)
      if (is_chosen(i)) lines.push_back(tracts.line(i));
    return join(lines);
  }
  FascicleMeasures with_tracts(const Polylines& fitted, const Polylines& judged) {
    muscle.tracts = fitted;
    return compared(muscle.surface, fibers_of(muscle), judged);
  }
};

void expect_as_measured(const FascicleMeasures& found, Real measured_length) {
  SCOPED_TRACE(testing::Message() << found);
  std::cout << "  " << found << '\n';
  EXPECT_LE(degrees(found.median_angle), 12);
  EXPECT_LE(degrees(found.large_angle), 35);
  EXPECT_NEAR(found.mean_length / measured_length, 1, 0.1);
  EXPECT_LE(found.farthest_outside, 1e-9);
}

}  // namespace

#define SKIP_WITHOUT_FASCICLES()                          \
  if (data_folder().empty() || !Gastrocnemius::is_here()) \
  GTEST_SKIP() << "the measured fascicles are not here: set GRACILIS_DATA, or put them into ../shared/data"

TEST(MeasuredFascicles, are_met_without_tracts_by_where_they_end) {
  SKIP_WITHOUT_FASCICLES();
  Gastrocnemius mg;
  const FascicleMeasures found = mg.with_tracts({}, mg.tracts);
  expect_as_measured(found, found.measured_length);
}

TEST(MeasuredFascicles, are_met_by_fibers_along_all_or_half_or_a_tenth_of_the_tracts) {
  SKIP_WITHOUT_FASCICLES();
  Gastrocnemius mg;
  const Real measured = mg.with_tracts(mg.tracts, mg.tracts).measured_length;
  const auto middle = [&](Index i) { return mg.tracts.line(i).row(2).mean(); };
  Real half = 0;
  for (Index i = 0; i < mg.tracts.count(); ++i) half += middle(i) / mg.tracts.count();
  const std::vector<std::function<bool(Index)>> choices = {
      [](Index) { return true; }, [](Index i) { return i % 2 == 0; }, [](Index i) { return i % 10 == 0; },
      [&](Index i) { return middle(i) < half; }};
  for (const auto& choice : choices) {
    const bool all = choice(0) && choice(1) && choice(2) && choice(mg.tracts.count() - 1);
    const Polylines judged = mg.chosen([&](Index i) { return all || !choice(i); });
    expect_as_measured(mg.with_tracts(mg.chosen(choice), judged), measured);
  }
}

TEST(MeasuredFascicles, are_met_by_fibers_along_noisy_tracts_a_fifth_of_which_is_wrong) {
  SKIP_WITHOUT_FASCICLES();
  Gastrocnemius mg;
  std::mt19937 chance(3);
  std::vector<Points> spoiled;
  for (Index i = 0; i < mg.tracts.count(); ++i) spoiled.push_back(as_measured(mg.tracts.line(i), 1e-3, 0.2, chance));
  const FascicleMeasures found = mg.with_tracts(join(spoiled), mg.tracts);
  expect_as_measured(found, found.measured_length);
}

}  // namespace gracilis
