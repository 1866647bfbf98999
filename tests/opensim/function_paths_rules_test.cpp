#include "opensim/function_set_rules.hpp"
#include "opensim/model_texts.hpp"

#include <gracilis/io/input_file.hpp>
#include <gracilis/opensim/export/model_samples.hpp>
#include <gracilis/opensim/export/replace_paths.hpp>
#include <gracilis/opensim/export/run_paths.hpp>
#include <gracilis/opensim/paths/muscle_path.hpp>

#include <build_paths.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gracilis::opensim {

static std::string reference_set() {
  return read_text(std::filesystem::path(build_paths::source_folder) / "tests/opensim/reference/function_paths.xml");
}

/// Two links with two hinges and a muscle over both.
static std::string two_links() {
  return document(
      set("BodySet", body("upper") + body("lower")) +
      set("JointSet", joint("PinJoint", "hip", "/ground", "upper", coordinate("swing")) +
                          joint("PinJoint", "knee", "/bodyset/upper", "lower", coordinate("bend"), "", "0 -0.4 0")) +
      set("ForceSet", muscle("long", point("/ground", "0.05 0.1 0") + point("/bodyset/lower", "0.04 -0.1 0")) +
                          muscle("short", point("/ground", "0.05 0 0.02") + point("/bodyset/upper", "0.03 -0.2 0"))));
}

/// A run of the two links, whose muscles are `more` longer at the end than their paths.
static LengthSamples run_of(const Model& model, Real more = 0) {
  Skeleton skeleton(model);
  LengthSamples run;
  run.coordinates.resize(40, 2);
  for (const Muscle& muscle : model.muscles) run.muscles.push_back({muscle.name, Eigen::VectorXd(40), {}});
  for (Eigen::Index row = 0; row < 40; ++row) {
    run.coordinates.row(row) << 0.015 * static_cast<Real>(row), -0.02 * static_cast<Real>(row);
    skeleton.place(run.coordinates.row(row).transpose());
    for (std::size_t m = 0; m < model.muscles.size(); ++m) {
      run.muscles[m].lengths[row] = measure_path(skeleton, model.muscles[m].path, run.coordinates.row(row)).length +
                                    more * static_cast<Real>(row) / 39;
      run.muscles[m].arms.resize(40, 0);
    }
  }
  return run;
}

/// The elements of a file, each with those around it.
static std::set<std::string> elements_of(const std::string& text) {
  struct Walker : pugi::xml_tree_walker {
    std::set<std::string> paths;
    bool for_each(pugi::xml_node& node) override {
      if (node.type() == pugi::node_element) paths.insert(node.path());
      return true;
    }
  } walker;
  pugi::xml_document document;
  document.load_string(text.c_str());
  document.traverse(walker);
  return walker.paths;
}

TEST(FunctionPathRules, the_set_that_opensim_wrote_breaks_none) {
  const std::set<std::string> components = {"/forceset/addbrev_r",
                                            "/forceset/bfsh_r",
                                            "/jointset/hip_r/hip_flexion_r",
                                            "/jointset/hip_r/hip_adduction_r",
                                            "/jointset/hip_r/hip_rotation_r",
                                            "/jointset/walker_knee_r/knee_angle_r"};
  EXPECT_THAT(broken_rules(reference_set(), components), testing::IsEmpty());
}

TEST(FunctionPathRules, names_without_their_joints_and_unknown_roots_break_them) {
  const std::set<std::string> components = components_of(two_links());
  const auto text = [](const std::string& root, const std::string& coordinate, int order) {
    return "<OpenSimDocument Version=\"40600\"><" + root + "><objects><FunctionBasedPath name=\"/forceset/long\">" +
           "<coordinate_paths>" + coordinate + "</coordinate_paths><length_function><MultivariatePolynomialFunction>" +
           "<coefficients>" + (order > 0 ? "1 2" : "1") + "</coefficients><dimension>1</dimension><order>" +
           std::to_string(order) + "</order></MultivariatePolynomialFunction></length_function></FunctionBasedPath>" +
           "</objects></" + root + "></OpenSimDocument>";
  };
  EXPECT_THAT(broken_rules(text("Set_FunctionBasedPath_", "/jointset/hip/swing", 1), components), testing::IsEmpty());
  EXPECT_EQ(broken_rules(text("Set_FunctionBasedPath_", "swing", 1), components).size(), 1u);
  EXPECT_EQ(broken_rules(text("FunctionBasedPathSet", "/jointset/hip/swing", 1), components).size(), 1u);
  EXPECT_EQ(broken_rules(text("Set_FunctionBasedPath_", "/jointset/hip/swing", 0), components).size(), 2u);
}

TEST(FunctionPathRules, a_set_that_we_write_breaks_none_and_has_the_lengths_by_opensim_s_order_of_terms) {
  const Model model = model_from(two_links());
  const FittedMuscles fitted = fit_muscles(run_of(model), model);
  ASSERT_EQ(fitted.muscles.size(), 2u);
  std::vector<RuledPath> paths;
  EXPECT_THAT(broken_rules(function_path_set(model, fitted.muscles), components_of(two_links()), &paths),
              testing::IsEmpty());
  ASSERT_EQ(paths.size(), 2u);
  EXPECT_EQ(paths[0].coordinates, (std::vector<std::string>{"/jointset/hip/swing", "/jointset/knee/bend"}));
  EXPECT_EQ(paths[1].coordinates, (std::vector<std::string>{"/jointset/hip/swing"}));
  Skeleton skeleton(model);
  const Eigen::Vector2d q(0.25, -0.6);
  skeleton.place(q);
  EXPECT_NEAR(ruled_value(paths[0], {q[0], q[1]}), measure_path(skeleton, model.muscles[0].path, q).length, 1e-5);
  EXPECT_NEAR(ruled_value(paths[1], {q[0]}), measure_path(skeleton, model.muscles[1].path, q).length, 1e-5);
}

TEST(FunctionPathRules, our_set_holds_no_element_that_opensim_s_own_does_not) {
  const Model model = model_from(two_links());
  EXPECT_EQ(elements_of(function_path_set(model, fit_muscles(run_of(model), model).muscles)),
            elements_of(reference_set()));
}

TEST(ReplacePaths, what_is_written_is_put_in_the_place_of_the_model_s_paths) {
  Model model = model_from(two_links());
  const Model before = model;
  const TestFolder folder;
  replace_paths(folder.write("set.xml", function_path_set(model, fit_muscles(run_of(model), model).muscles)), model);
  Skeleton skeleton(model);
  const Eigen::Vector2d q(0.3, -0.5);
  skeleton.place(q);
  for (std::size_t m = 0; m < 2; ++m) {
    const PathMeasure own = measure_path(skeleton, before.muscles[m].path, q);
    const PathMeasure written = measure_path(skeleton, model.muscles[m].path, q);
    EXPECT_TRUE(model.muscles[m].path.points.empty());
    EXPECT_NEAR(written.length, own.length, 1e-5);
    EXPECT_LT((written.moment_arms - own.moment_arms).lpNorm<Eigen::Infinity>(), 1e-4);
  }
}

TEST(ReplacePaths, a_coordinate_without_its_joint_is_refused_as_opensim_does) {
  Model model = model_from(two_links());
  const TestFolder folder;
  std::string text = function_path_set(model, fit_muscles(run_of(model), model).muscles);
  text.replace(text.find("/jointset/hip/swing"), 19, "swing");
  EXPECT_THAT(message_of_input_error([&] { replace_paths(folder.write("set.xml", text), model); }),
              testing::HasSubstr("'swing', which does not exist"));
}

TEST(FitMuscles, a_muscle_that_the_model_lacks_is_named_and_the_others_are_written) {
  const Model model = model_from(two_links());
  LengthSamples run = run_of(model);
  run.muscles[0].name = "stranger";
  const FittedMuscles fitted = fit_muscles(run, model);
  ASSERT_EQ(fitted.muscles.size(), 1u);
  EXPECT_EQ(fitted.muscles[0].name, "short");
  ASSERT_EQ(fitted.left_out.size(), 1u);
  EXPECT_THAT(fitted.left_out[0], testing::HasSubstr("stranger"));
}

TEST(FitMuscles, a_correction_adds_what_the_run_knows_and_nothing_where_it_does_not) {
  const Model model = model_from(two_links());
  const FittedMuscles plain = fit_muscles(run_of(model), model), longer = fit_muscles(run_of(model, 0.004), model);
  const auto length = [](const FittedMuscle& muscle, Real swing, Real bend) {
    return value(muscle.length, {swing, bend});
  };
  // In the capture pose lengths stay the path's; at the run's end they are 4 mm longer.
  EXPECT_NEAR(length(longer.muscles[0], 0, 0), length(plain.muscles[0], 0, 0), 4e-4);
  EXPECT_NEAR(length(longer.muscles[0], 0.585, -0.78) - length(plain.muscles[0], 0.585, -0.78), 0.004, 6e-4);
  // Far from the run's poses (both coordinates turned the other way) it stays small.
  EXPECT_LT(std::abs(length(longer.muscles[0], 0.55, 0.1) - length(plain.muscles[0], 0.55, 0.1)), 0.006);
  EXPECT_TRUE(longer.muscles[0].corrects);
  EXPECT_LT(longer.muscles[0].beside_run.length_root_mean_square, 1e-3);
}

}  // namespace gracilis::opensim
