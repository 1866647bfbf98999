#include <gracilis/core/parallel.hpp>
#include <gracilis/dynamics/solver/solver.hpp>

#include "systems_for_tests.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace gracilis {
namespace {

using enum ConstraintKind;

/// Surfaces that nothing presses, and what was projected on them, in its order.
struct Traced {
  struct Step {
    std::size_t surface;
    ConstraintKind kind;
  };
  std::vector<SurfaceSystem> systems;
  std::vector<SurfaceState> states;
  std::vector<SurfaceSolve> solves;
  std::vector<FieldPlacement> nowhere;
  std::vector<Step> steps;
  int refreshed = 0, coupled = 0, repaired = 0;
  int deep_for = -1;  ///< repairs that find the second surface deep in another; -1: none is asked for

  void add(const SolveSettings& settings) {
    systems.push_back(system_of(shapes::sphere(Vec3::Zero(), 0.03, 1)));
    states.push_back(make_state(systems.back()));
    solves.push_back({nullptr, nullptr, settings, nullptr, {}});
  }
  void solve() {
    for (std::size_t i = 0; i < solves.size(); ++i)
      solves[i].system = &systems[i], solves[i].placements = &nowhere, solves[i].state = &states[i];
    Coupling coupling;
    coupling.refresh = [this](const Movers&) { ++refreshed; };
    coupling.project = [this](const Movers&) { return static_cast<Index>(++coupled); };
    if (deep_for >= 0)
      coupling.repair_penetrations = [this] {
        std::vector<char> moved;
        if (++repaired <= deep_for) moved = {0, 1};
        return moved;
      };
    const ThreadLimit one(1);  // that steps are told one after the other
    solve_together(solves, coupling, [this](std::size_t i, ConstraintKind kind) { steps.push_back({i, kind}); });
  }
  int count(ConstraintKind kind, std::size_t surface = 0) const {
    return static_cast<int>(std::count_if(
        steps.begin(), steps.end(), [&](const Step& step) { return step.kind == kind && step.surface == surface; }));
  }
};

SolveSettings iterating(int iterations, int settling_rounds = 0) {
  SolveSettings settings;
  settings.iterations = iterations;
  settings.settling_rounds = settling_rounds;
  settings.projection.dihedral_limit = 0.05f;
  return settings;
}

}  // namespace

TEST(SolveSchedule, each_iteration_projects_every_kind_once_in_the_order_of_the_table) {
  Traced traced;
  traced.add(iterating(7));
  traced.solve();
  EXPECT_EQ(traced.solves[0].report.iterations, 7);
  const std::vector<ConstraintKind> order = {distance,     tension, dihedral,         volume,
                                             strain_limit, slivers, rest_proximities, bone_contact};
  std::vector<ConstraintKind> without_coupling;
  for (const Traced::Step& step : traced.steps)
    if (step.kind != muscle_contact) without_coupling.push_back(step.kind);
  ASSERT_EQ(without_coupling.size(), 7 * order.size());
  for (std::size_t i = 0; i < without_coupling.size(); ++i)
    EXPECT_EQ(without_coupling[i], order[i % order.size()]) << i;
  EXPECT_EQ(traced.coupled, 7);
  EXPECT_EQ(traced.refreshed, 1);
}

TEST(SolveSchedule, surfaces_with_fewer_iterations_wait_for_the_others_and_those_with_none_are_left_alone) {
  Traced traced;
  for (const int iterations : {3, 5, 0}) traced.add(iterating(iterations));
  traced.solve();
  const int iterations[] = {3, 5, 0};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(traced.solves[i].report.iterations, iterations[i]);
    for (const ConstraintKind kind : {distance, volume, bone_contact}) EXPECT_EQ(traced.count(kind, i), iterations[i]);
  }
  EXPECT_EQ(traced.coupled, 5);
}

TEST(SolveSchedule, what_is_near_is_looked_for_again_every_fifteen_iterations) {
  for (const int iterations : {15, 16, 31}) {
    Traced traced;
    traced.add(iterating(iterations));
    traced.solve();
    EXPECT_EQ(traced.refreshed, (iterations + 14) / 15) << iterations;
  }
}

TEST(SolveSchedule, where_contact_settles_it_is_projected_in_every_other_iteration_and_in_the_last_eight) {
  Traced traced;
  traced.add(iterating(20, 1));
  traced.solve();
  EXPECT_EQ(traced.count(distance), 20);
  EXPECT_EQ(traced.count(dihedral), 20);
  // In 1, 3, 5, 7, 9, 11 and from 12 to 19, and once while it settles.
  EXPECT_EQ(traced.count(bone_contact), 6 + 8 + 1);
  EXPECT_EQ(traced.coupled, 6 + 8 + 1);
  EXPECT_EQ(traced.count(volume), 20 + 1);
  EXPECT_EQ(traced.count(strain_limit), 20 + 10 + 1) << "ten passes before";
  EXPECT_EQ(traced.count(shape_limit), 10 + 1);
  EXPECT_EQ(traced.refreshed, 2 + 1);
}

TEST(SolveSchedule, a_muscle_that_contracts_meets_contact_in_every_iteration) {
  Traced traced;
  SolveSettings settings = iterating(20, 1);
  settings.tension.strength = 1;
  traced.add(settings);
  traced.systems[0].tensions = traced.systems[0].distances;
  traced.states[0] = make_state(traced.systems[0]);
  traced.solve();
  EXPECT_EQ(traced.coupled, 20 + 1);
}

TEST(SolveSchedule, each_surface_settles_as_many_rounds_as_it_asks_for) {
  Traced traced;
  for (const int rounds : {1, 4, 0}) traced.add(iterating(2, rounds));
  traced.solve();
  const int rounds[] = {1, 4, 0};
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(traced.count(volume, i), 2 + rounds[i]) << i;
}

TEST(SolveSchedule, one_that_is_still_squeezed_settles_sixteen_rounds_more_and_then_recovers_by_itself) {
  Traced traced;
  // A volume that fixed particles keep from their target.
  SolveSettings settings = iterating(2, 1);
  settings.pressure = 1.1;
  traced.add(settings);
  traced.add(iterating(2, 1));
  SurfaceSystem& fixed = traced.systems[0];
  for (Index p = 0; p < fixed.rest.count(); ++p) fixed.rest.at(p)[3] = 0;
  traced.states[0] = make_state(fixed);
  traced.solve();
  EXPECT_EQ(traced.count(volume, 0), 2 + 1 + 16 + 40);
  EXPECT_EQ(traced.count(volume, 1), 2 + 1) << "the other one is not";
  EXPECT_EQ(traced.coupled, 2 + 1 + 16) << "without contact between surfaces in the end";
}

TEST(SolveSchedule, a_volume_that_may_give_way_is_not_squeezed) {
  Traced traced;
  SolveSettings settings = iterating(2, 1);
  settings.pressure = 1.1;
  traced.add(settings);
  SurfaceSystem& fixed = traced.systems[0];
  for (Index p = 0; p < fixed.rest.count(); ++p) fixed.rest.at(p)[3] = 0;
  fixed.volume.compliance = 1;
  traced.states[0] = make_state(fixed);
  traced.solve();
  EXPECT_EQ(traced.count(volume), 2 + 1);
}

TEST(SolveSchedule, what_lies_deep_in_another_surface_is_repaired_until_nothing_does_three_times_at_most) {
  for (const int deep_for : {0, 1, 2, 5}) {
    Traced traced;
    traced.deep_for = deep_for;
    for (int i = 0; i < 2; ++i) traced.add(iterating(2, 1));
    traced.solve();
    const int moved = std::min(deep_for, 3);
    EXPECT_EQ(traced.repaired, std::min(deep_for + 1, 3)) << deep_for;
    EXPECT_EQ(traced.refreshed, 1 + 1 + traced.repaired) << "each looks at what is near first";
    EXPECT_EQ(traced.coupled, 2 + 1) << "contact between surfaces would take it back";
    for (const ConstraintKind kind : {volume, bone_contact}) {
      EXPECT_EQ(traced.count(kind, 0), 2 + 1) << "the other one stays";
      EXPECT_EQ(traced.count(kind, 1), 2 + 1 + 2 * moved);
    }
  }
}

TEST(SolveSchedule, where_nothing_settles_nothing_is_repaired) {
  Traced traced;
  traced.deep_for = 5;
  for (int i = 0; i < 2; ++i) traced.add(iterating(2));
  traced.solve();
  EXPECT_EQ(traced.repaired, 0);
}

}  // namespace gracilis
