#include "opensim/model_texts.hpp"

#include <gracilis/opensim/static_optimization/joint_reactions.hpp>
#include <gracilis/opensim/static_optimization/needed_forces.hpp>
#include <gracilis/opensim/static_optimization/setup_reader.hpp>
#include <gracilis/opensim/static_optimization/static_optimization.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace gracilis::opensim {

static constexpr Real g = 9.80665;

static CoordinateMotion swinging(int coordinates) {
  CoordinateMotion motion;
  motion.values.resize(301, coordinates);
  for (int i = 0; i < 301; ++i) {
    motion.times.push_back(0.01 * i);
    for (int c = 0; c < coordinates; ++c) motion.values(i, c) = (0.8 - 0.3 * c) * std::sin((3 + c) * 0.01 * i);
  }
  return motion;
}

/// Forces that static optimization finds for the row.
static Table forces_at(const Model& model, const CoordinateMotion& motion, std::size_t row) {
  return static_optimization(model, motion, {}, {row}, {}).forces;
}

static Vec3 part(const Table& table, const std::string& start, const std::string& kind) {
  Vec3 result;
  const std::string axes = "xyz";
  for (int i = 0; i < 3; ++i)
    result[i] = table.values(0, *column_of(table, start + "_" + kind + axes[static_cast<std::size_t>(i)]));
  return result;
}

static const std::string motor =
    "<CoordinateActuator name=\"motor\"><coordinate>swing</coordinate><optimal_force>10</optimal_force>"
    "</CoordinateActuator>";

TEST(JointReactions, of_a_moving_pendulum_are_those_of_its_equations) {
  const Model model = model_from(pendulum(motor));
  const CoordinateMotion motion = swinging(1);
  const std::size_t row = 150;
  const Real q = motion.values(row, 0), speed = 2.4 * std::cos(4.5), acceleration = -9 * q;
  const Table loads = joint_reactions(model, motion, {}, {row}, forces_at(model, motion, row), {});
  ASSERT_EQ(loads.columns.size(), 9u);
  EXPECT_EQ(loads.columns[0], "hinge_on_rod_in_ground_fx");
  const Vec3 down(std::sin(q), -std::cos(q), 0), forward(std::cos(q), std::sin(q), 0);  // along the rod, across it
  const Vec3 of_center = 0.5 * (acceleration * forward - speed * speed * down);
  EXPECT_LT((part(loads, "hinge_on_rod_in_ground", "f") - 2 * (of_center + g * Vec3::UnitY())).norm(), 1e-4);
  // The motor acts through the hinge; the moment is about the hinge.
  EXPECT_NEAR(part(loads, "hinge_on_rod_in_ground", "m").z(), 0.6 * acceleration + g * std::sin(q), 1e-4);
  EXPECT_LT(part(loads, "hinge_on_rod_in_ground", "p").norm(), 1e-12);
}

TEST(JointReactions, on_the_parent_are_opposite_and_in_the_child_turned) {
  const Model model = model_from(pendulum(motor));
  const CoordinateMotion motion = swinging(1);
  const Table forces = forces_at(model, motion, 120);
  const auto loads = [&](const std::string& on, const std::string& in) {
    return joint_reactions(model, motion, {}, {120}, forces, {{"hinge"}, {on}, {in}});
  };
  const Vec3 force = part(loads("child", "ground"), "hinge_on_rod_in_ground", "f");
  EXPECT_LT((part(loads("parent", "ground"), "hinge_on_ground_in_ground", "f") + force).norm(), 1e-12);
  const Real q = motion.values(120, 0);
  const Vec3 turned = Eigen::AngleAxisd(-q, Vec3::UnitZ()) * force;
  EXPECT_LT((part(loads("child", "child"), "hinge_on_rod_in_rod", "f") - turned).norm(), 1e-12);
  EXPECT_LT((part(loads("child", "rod"), "hinge_on_rod_in_rod", "f") - turned).norm(), 1e-12);
  EXPECT_THAT(message_of_input_error([&] { loads("child", "roda"); }), testing::HasSubstr("'rod'"));
}

/// Upper and lower rod; a muscle from the ground to the lower one's middle holds both still, with a motor at the top.
static Model held_chain() {
  const std::string muscle_text = muscle("strong", point("/ground", "1 0 0") + point("/bodyset/lower", "0 -0.5 0"),
                                         "<max_isometric_force>400</max_isometric_force>");
  return model_from(document(
      set("BodySet", body("upper") + body("lower")) +
      set("JointSet", joint("PinJoint", "top", "/ground", "upper", coordinate("a")) +
                          joint("PinJoint", "middle", "/bodyset/upper", "lower", coordinate("b"), "", "0 -1 0")) +
      set("ForceSet",
          muscle_text + "<CoordinateActuator name=\"motor\"><coordinate>a</coordinate></CoordinateActuator>")));
}

TEST(JointReactions, of_a_chain_held_by_a_muscle_balance_each_rod) {
  const Model model = held_chain();
  CoordinateMotion motion;
  for (int i = 0; i < 8; ++i) motion.times.push_back(0.1 * i);
  motion.values = Eigen::RowVector2d(0.3, 0.5).replicate(8, 1);
  StaticOptimizationSettings settings;
  settings.use_muscle_physiology = false;
  const Table forces = static_optimization(model, motion, {}, {3}, settings).forces;
  const Table loads = joint_reactions(model, motion, {}, {3}, forces, {});
  const Vec3 knee(std::sin(0.3), -std::cos(0.3), 0), down(std::sin(0.8), -std::cos(0.8), 0);
  const Vec3 attached = knee + 0.5 * down, line = (Vec3::UnitX() - attached).normalized();
  // About the middle hinge the muscle holds the lower rod's weight, at the same point.
  const Real tension = 2 * g * (0.5 * down).x() / (0.5 * down).cross(line).z();
  ASSERT_GT(tension, 4);
  EXPECT_NEAR(forces.values(0, 0), tension, 1e-4);
  const Vec3 weight(0, -2 * g, 0);
  const Vec3 on_lower = part(loads, "middle_on_lower_in_ground", "f"),
             on_upper = part(loads, "top_on_upper_in_ground", "f");
  EXPECT_LT((on_lower + weight + tension * line).norm(), 1e-4);
  EXPECT_LT((on_upper + weight - on_lower).norm(), 1e-4);
  EXPECT_LT(part(loads, "middle_on_lower_in_ground", "m").norm(), 1e-4);
  EXPECT_LT((part(loads, "middle_on_lower_in_ground", "p") - knee).norm(), 1e-12);
  const Vec3 moment = -(0.5 * knee).cross(weight) + knee.cross(on_lower);
  EXPECT_LT((part(loads, "top_on_upper_in_ground", "m") - moment).norm(), 1e-4);
}

TEST(JointReactions, forces_of_all_muscles_are_asked_for) {
  const Model model = held_chain();
  Table forces;
  forces.name = "few.sto";
  forces.columns = {"motor"};
  forces.times = {0};
  forces.values = Eigen::MatrixXd::Zero(1, 1);
  EXPECT_THAT(message_of_input_error([&] { joint_reactions(model, swinging(2), {}, {5}, forces, {}); }),
              testing::HasSubstr("no force of 'strong'"));
}

TEST(SetupReader, takes_joint_reactions_with_or_without_static_optimization) {
  const TestFolder folder;
  const std::string reaction =
      "<JointReaction name=\"loads\"><joint_names>hinge middle</joint_names><apply_on_bodies>parent</apply_on_bodies>"
      "<express_in_frame>child</express_in_frame><step_interval>4</step_interval>FORCES</JointReaction>";
  const auto read = [&](const std::string& analyses) {
    return read_setup(folder.write("s.xml",
                                   "<OpenSimDocument Version=\"40000\"><AnalyzeTool name=\"t\"><AnalysisSet>"
                                   "<objects>" +
                                       analyses + "</objects></AnalysisSet></AnalyzeTool></OpenSimDocument>"));
  };
  std::string alone = reaction;
  alone.replace(alone.find("FORCES"), 6, "<forces_file>f.sto</forces_file>");
  const StaticOptimizationSetup setup = read(alone);
  EXPECT_FALSE(setup.optimizes);
  EXPECT_EQ(setup.step_interval, 4);
  EXPECT_EQ(setup.reactions->forces.filename(), "f.sto");
  EXPECT_THAT(setup.reactions->settings.joints, testing::ElementsAre("hinge", "middle"));
  EXPECT_THAT(setup.reactions->settings.on, testing::ElementsAre("parent"));
  std::string without = reaction;
  without.replace(without.find("FORCES"), 6, "");
  EXPECT_THAT(message_of_input_error([&] { read(without); }),
              testing::HasSubstr("JointReaction with a file of forces"));
  EXPECT_TRUE(read("<StaticOptimization name=\"so\"/>" + without).optimizes);
}

}  // namespace gracilis::opensim
