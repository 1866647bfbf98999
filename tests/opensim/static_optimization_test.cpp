#include "opensim/model_texts.hpp"

#include <gracilis/opensim/static_optimization/setup_reader.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace gracilis::opensim {

/// The pendulum held still by muscles of the given strengths, which pull straight at its middle from both sides.
static Model held_pendulum(const std::string& more = "") {
  const auto strong = [](int newtons) {
    return "<max_isometric_force>" + std::to_string(newtons) + "</max_isometric_force>";
  };
  return model_from(
      pendulum(muscle("strong", point("/ground", "3 0 0") + point("/bodyset/rod", "0 -0.5 0"), strong(400)) +
               muscle("weak", point("/ground", "3 0 0") + point("/bodyset/rod", "0 -0.5 0"), strong(300)) +
               muscle("back", point("/ground", "-3 0 0") + point("/bodyset/rod", "0 -0.5 0"), strong(300)) + more));
}

static CoordinateMotion still(const Model& model, Real swing) {
  CoordinateMotion motion;
  for (int i = 0; i < 8; ++i) motion.times.push_back(0.1 * i);
  motion.values = Eigen::MatrixXd::Constant(8, static_cast<Eigen::Index>(model.coordinates.size()), swing);
  return motion;
}

TEST(StaticOptimization, two_muscles_hold_a_pendulum_as_their_strengths) {
  const Model model = held_pendulum();
  StaticOptimizationSettings settings;
  settings.use_muscle_physiology = false;
  const StaticOptimizationResult result = static_optimization(model, still(model, 0.6), {}, {3}, settings);
  ASSERT_TRUE(result.infeasible.empty());
  // All three muscles' lines and arms by the law of cosines; the one behind stays at its least.
  const auto arm = [](Real angle) {
    const Real length = std::sqrt(9 + 0.25 - 3 * std::cos(angle));
    return 1.5 * std::sin(angle) / length;
  };
  const Real front = arm(pi / 2 - 0.6), back = arm(pi / 2 + 0.6);
  const Real needed = 2 * 9.80665 * 0.5 * std::sin(0.6) + 0.01 * 300 * back;
  const Real share = needed / (front * (400 * 400 + 300 * 300));
  EXPECT_NEAR(result.activations.values(0, 0), 400 * share, 1e-6);
  EXPECT_NEAR(result.activations.values(0, 1), 300 * share, 1e-6);
  EXPECT_NEAR(result.activations.values(0, 2), 0.01, 1e-9);
  EXPECT_NEAR(result.forces.values(0, 0), 400 * 400 * share, 1e-3);
}

TEST(StaticOptimization, what_the_muscles_cannot_hold_is_reported) {
  Model model = held_pendulum();
  for (Muscle& muscle : model.muscles) muscle.max_isometric_force = 1;
  StaticOptimizationSettings settings;
  settings.use_muscle_physiology = false;
  const StaticOptimizationResult result = static_optimization(model, still(model, 1), {}, {2}, settings);
  ASSERT_EQ(result.infeasible.size(), 1u);
  ASSERT_EQ(result.infeasible[0].missing.size(), 1u);
  EXPECT_EQ(result.infeasible[0].missing[0].first, "swing");
  EXPECT_NEAR(result.infeasible[0].missing[0].second, 9.80665 * std::sin(1), 1);
}

TEST(StaticOptimization, actuators_take_what_is_left) {
  Model model = held_pendulum(
      "<CoordinateActuator name=\"reserve\"><coordinate>swing</coordinate><optimal_force>5</optimal_force>"
      "</CoordinateActuator><TorqueActuator name=\"twist\"><bodyA>rod</bodyA><bodyB>ground</bodyB><axis>0 0 1</axis>"
      "<optimal_force>5</optimal_force></TorqueActuator><PointActuator name=\"push\"><body>rod</body>"
      "<point>0 -1 0</point><direction>1 0 0</direction><force_is_global>false</force_is_global>"
      "<optimal_force>5</optimal_force></PointActuator>");
  for (Muscle& muscle : model.muscles) muscle.applies_force = false;
  const StaticOptimizationResult result = static_optimization(model, still(model, 0.5), {}, {2}, {});
  ASSERT_EQ(result.activations.columns.size(), 3u);
  const Real each = 9.80665 * std::sin(0.5) / 15;  // all three act with the same moment
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(result.activations.values(0, i), each, 1e-6);
}

TEST(StaticOptimization, locked_coordinates_ask_for_nothing) {
  Model model = held_pendulum();
  model.coordinates[0].locked = true;
  const StaticOptimizationResult result = static_optimization(model, still(model, 1), {}, {2}, {});
  EXPECT_TRUE(result.infeasible.empty());
  EXPECT_NEAR(result.activations.values.maxCoeff(), 0.01, 1e-12);
}

TEST(StaticOptimization, the_moment_of_a_moving_pendulum_is_its_equation_of_motion) {
  const Model model = model_from(pendulum());
  CoordinateMotion motion;
  motion.values.resize(301, 1);
  for (int i = 0; i < 301; ++i) {
    motion.times.push_back(0.01 * i);
    motion.values(i, 0) = 0.8 * std::sin(3 * motion.times.back());
  }
  const Table moments = inverse_dynamics(model, motion, {}, {150});
  const Real swing = 0.8 * std::sin(4.5), acceleration = -9 * swing;
  EXPECT_NEAR(moments.values(0, 0), 0.6 * acceleration + 9.80665 * std::sin(swing), 1e-5);
  EXPECT_EQ(moments.columns[0], "swing_moment");
}

static const char* load_table =
    "loads\nversion=1\nnRows=4\nnColumns=10\ninDegrees=no\nendheader\n"
    "time fvx fvy fvz fpx fpy fpz tx ty tz\n0 0 10 0 1 0 0 0 0 1\n1 0 20 0 1 0 0 0 0 2\n2 0 30 0 1 0 0 0 0 3\n"
    "3 0 40 0 1 0 0 0 0 4\n";
static const char* load_file =
    "<OpenSimDocument Version=\"40000\"><ExternalLoads><objects><ExternalForce name=\"foot\"><applied_to_body>rod"
    "</applied_to_body><force_expressed_in_body>ground</force_expressed_in_body><point_expressed_in_body>ground"
    "</point_expressed_in_body><force_identifier>fv</force_identifier><point_identifier>fp</point_identifier>"
    "<torque_identifier>t</torque_identifier></ExternalForce></objects><datafile>loads.mot</datafile></ExternalLoads>"
    "</OpenSimDocument>";

TEST(ExternalLoads, a_force_at_a_point_and_a_torque_act_on_the_body) {
  const Model model = model_from(pendulum());
  const TestFolder folder;
  folder.write("loads.mot", load_table);
  const ExternalLoads loads = read_external_loads(model, folder.write("loads.xml", load_file));
  ASSERT_EQ(loads.forces.size(), 1u);
  EXPECT_EQ(loads.end, 3);
  Skeleton skeleton(model);
  BodyForces forces = BodyForces::Zero(6, 2);
  add_loads(loads, 1.5, skeleton.poses(), forces);
  EXPECT_NEAR(skeleton.generalized_forces(forces)[0], 25 + 2.5, 1e-12);
}

TEST(ExternalLoads, identifiers_that_fit_no_three_columns_and_files_elsewhere_are_refused) {
  const Model model = model_from(pendulum());
  const TestFolder folder;
  folder.write("loads.mot", load_table);
  std::string text = load_file;
  text.replace(text.find(">fp<"), 4, ">q<");
  EXPECT_THAT(message_of_input_error([&] { read_external_loads(model, folder.write("a.xml", text)); }),
              testing::HasSubstr("0 columns of its table begin with 'q'"));
  text = load_file;
  text.replace(text.find("loads.mot"), 9, "..\\..\\loads.mot");
  EXPECT_THAT(message_of_input_error([&] { read_external_loads(model, folder.write("b.xml", text)); }),
              testing::HasSubstr("lies outside its folder"));
}

TEST(SetupReader, takes_rows_from_begin_to_end_and_the_last) {
  StaticOptimizationSetup setup;
  setup.begin = 0.2;
  setup.end = 0.75;
  setup.step_interval = 3;
  std::vector<Real> times;
  for (int i = 0; i < 11; ++i) times.push_back(0.1 * i);
  EXPECT_THAT(rows_of(setup, times), testing::ElementsAre(2u, 5u, 7u));
}

TEST(SetupReader, refuses_a_set_up_without_static_optimization) {
  const TestFolder folder;
  const auto path =
      folder.write("s.xml", "<OpenSimDocument Version=\"40000\"><AnalyzeTool name=\"t\"/></OpenSimDocument>");
  EXPECT_THAT(message_of_input_error([&] { read_setup(path); }), testing::HasSubstr("has no StaticOptimization"));
}

/// Root mean square of the difference of two columns over the rows of `ours`.
static Real difference(const Table& ours, const Table& theirs, const std::string& column, int every) {
  const auto place = [&](const Table& table) {
    return std::find(table.columns.begin(), table.columns.end(), column) - table.columns.begin();
  };
  Real sum = 0;
  for (Eigen::Index row = 0; row < ours.values.rows(); ++row)
    sum += std::pow(ours.values(row, place(ours)) - theirs.values(row * every, place(theirs)), 2);
  return std::sqrt(sum / static_cast<Real>(ours.values.rows()));
}

TEST(StaticOptimization, a_walking_trial_has_the_activations_and_forces_that_opensim_found) {
  GRACILIS_NEEDS_DATA("opensim");
  const auto folder = data_root() / "opensim";
  StaticOptimizationSetup setup = read_setup(folder / "setup_static_optimization.xml");
  EXPECT_EQ(setup.step_interval, 10);
  setup.step_interval = 50;  // every fifth of the rows given
  setup.end = 1.99;
  Model model = read_model(folder / "subject01_simbody_adjusted_StaticOp.osim");
  for (const auto& path : setup.force_sets) read_force_set(path, setup.replace_force_set, model);
  const CoordinateMotion motion = coordinate_motion(model, read_table(setup.coordinates));
  const ExternalLoads loads = read_external_loads(model, setup.external_loads);
  std::vector<std::size_t> rows = rows_of(setup, motion.times);
  rows.pop_back();
  ASSERT_EQ(rows.size(), 30u);
  const StaticOptimizationResult result = static_optimization(model, motion, loads, rows, setup.settings);
  EXPECT_TRUE(result.infeasible.empty());
  const Table activations = read_table(folder / "subject01_StaticOptimization_activation.sto");
  const Table forces = read_table(folder / "subject01_StaticOptimization_force.sto");
  ASSERT_NEAR(result.activations.times[1], activations.times[5], 1e-9);
  int judged = 0;
  for (const Muscle& muscle : model.muscles) {
    EXPECT_LT(difference(result.activations, activations, muscle.name, 5), 0.004) << muscle.name;
    EXPECT_LT(difference(result.forces, forces, muscle.name, 5), 2) << muscle.name;  // N, of up to 1900
    ++judged;
  }
  EXPECT_EQ(judged, 92);
  for (const char* residual : {"FX", "FY", "FZ", "MX", "MY", "MZ"})
    EXPECT_LT(difference(result.forces, forces, residual, 5), 1) << residual;
}

}  // namespace gracilis::opensim
