#include "app/program.hpp"
#include "opensim/model_texts.hpp"

#include <gracilis/io/input_file.hpp>
#include <gracilis/opensim/export/replace_paths.hpp>
#include <gracilis/opensim/paths/muscle_path.hpp>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <utility>

namespace gracilis {

using opensim::muscle;
using opensim::pendulum;
using opensim::point;

TEST(ImportCommand, an_imported_model_runs_its_motion) {
  const TestFolder folder;
  const auto model = folder.write(
      "tiny.osim", pendulum(muscle("m", point("/ground", "0.1 0.1 0") + point("/bodyset/rod", "0.05 -0.3 0"))));
  const auto motion = folder.write(
      "swing.mot", "m\nversion=1\nnRows=2\nnColumns=2\ninDegrees=yes\nendheader\ntime\tswing\n0\t0\n1\t3\n");
  const std::string out = (folder.path() / "scene").string();
  const ProgramResult imported =
      run_program("import " + model.string() + " --motion " + motion.string() + " --out " + out);
  ASSERT_EQ(imported.exit_code, 0) << imported.err;
  EXPECT_EQ(imported.out, out + "/swing.toml\n");
  const ProgramResult ran = run_program("run " + out + "/swing.toml --out " + (folder.path() / "run").string());
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "run/frames/m_0001.vtp"));
}

/// Import and run of the pendulum with these muscles and this text in the place of another.
static std::pair<ProgramResult, ProgramResult> imported_and_run(const TestFolder& folder, const std::string& muscles,
                                                                const std::string& text = "",
                                                                const std::string& instead = "") {
  std::string model = pendulum(muscles);
  if (!text.empty()) model.replace(model.find(text), text.size(), instead);
  const std::string scene = (folder.path() / "scene").string();
  const ProgramResult imported = run_program("import " + folder.write("tiny.osim", model).string() + " --out " + scene);
  return {imported, run_program("run " + scene + "/rest.toml --out " + (folder.path() / "run").string())};
}

static const std::string from_ground_to_rod = point("/ground", "0.1 0.1 0") + point("/bodyset/rod", "0.05 -0.3 0");

TEST(ImportCommand, a_range_that_ends_before_it_begins_is_turned_round_and_the_scene_runs) {
  const TestFolder folder;
  const auto [imported, ran] = imported_and_run(folder, muscle("m", from_ground_to_rod), "<default_value>",
                                                "<range>1 -1</range><default_value>");
  EXPECT_EQ(imported.exit_code, 0) << imported.err;
  EXPECT_THAT(imported.err, testing::HasSubstr("swing"));
  EXPECT_THAT(imported.err, testing::HasSubstr("ends before it begins"));
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
}

TEST(ImportCommand, a_muscle_with_fibers_of_twelve_metres_is_left_out_and_the_others_run) {
  const TestFolder folder;
  const std::string too_long = "<optimal_fiber_length>12</optimal_fiber_length>";
  const auto [imported, ran] =
      imported_and_run(folder, muscle("m", from_ground_to_rod) + muscle("long", from_ground_to_rod, too_long));
  EXPECT_EQ(imported.exit_code, 0) << imported.err;
  EXPECT_THAT(imported.err, testing::HasSubstr("long"));
  EXPECT_THAT(imported.err, testing::HasSubstr("optimal fiber length of 12 m"));
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
}

TEST(ImportCommand, a_model_of_which_no_muscle_is_left_gives_no_scene_and_names_no_run) {
  const TestFolder folder;
  const auto [imported, ran] =
      imported_and_run(folder, muscle("long", from_ground_to_rod, "<optimal_fiber_length>12</optimal_fiber_length>"));
  EXPECT_EQ(imported.exit_code, 3);
  EXPECT_THAT(imported.err, testing::HasSubstr("tiny.osim"));
  EXPECT_THAT(imported.err, testing::Not(testing::HasSubstr("next:")));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "scene/rest.toml"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "scene/model.toml"));
}

TEST(ImportCommand, an_endless_range_runs) {
  const TestFolder folder;
  const auto [imported, ran] = imported_and_run(folder, muscle("m", from_ground_to_rod), "<default_value>",
                                                "<range>-inf inf</range><default_value>");
  EXPECT_EQ(imported.exit_code, 0) << imported.err;
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
}

/// A muscle from the ground to the rod, and a swing of three degrees.
static ProgramResult import_swing(const TestFolder& folder, const std::string& options) {
  const auto model = folder.write(
      "tiny.osim", pendulum(muscle("m", point("/ground", "0.1 0.1 0") + point("/bodyset/rod", "0.05 -0.3 0"),
                                   "<KshapeActive>0.7</KshapeActive>")));
  const auto motion = folder.write(
      "swing.mot",
      "m\nversion=1\nnRows=4\nnColumns=2\ninDegrees=yes\nendheader\ntime\tswing\n0\t0\n1\t1\n2\t2\n3\t3\n");
  return run_program("import " + model.string() + " --motion " + motion.string() + " --out " +
                     (folder.path() / "scene").string() + " " + options);
}

TEST(ImportCommand, an_imported_model_runs_by_sections_and_goes_back_to_opensim) {
  const TestFolder folder;
  ASSERT_EQ(import_swing(folder, "--tendon both-ends --rays 8 --tendon-sections").exit_code, 0);
  const std::string run = (folder.path() / "run").string();
  const ProgramResult ran =
      run_program("run " + (folder.path() / "scene/swing.toml").string() + " --set method=cylinder --out " + run);
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  const ProgramResult cells = run_program("export " + run + " --to tetrahedra --frames 0,1");
  ASSERT_EQ(cells.exit_code, 0) << cells.err;
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "run/tetrahedra/m_0001.vtu"));
  EXPECT_THAT(read_text(folder.path() / "run/tetrahedra/sections.csv"), testing::HasSubstr("1,m,0,0.000,tendon,"));
  const TestFolder even;
  ASSERT_EQ(import_swing(even, "--tendon both-ends --rays 8").exit_code, 0);
  const std::string even_run = (even.path() / "run").string();
  ASSERT_EQ(
      run_program("run " + (even.path() / "scene/swing.toml").string() + " --set method=cylinder --out " + even_run)
          .exit_code,
      0);
  EXPECT_EQ(run_program("export " + even_run + " --to tetrahedra --frames 0,1").exit_code, 0);
  const ProgramResult points =
      run_program("export " + run + " --to osim-points --model " + (folder.path() / "tiny.osim").string());
  ASSERT_EQ(points.exit_code, 0) << points.err;
  EXPECT_THAT(points.err, testing::HasSubstr("m: it follows the model's line; it keeps its original path"));
  EXPECT_THAT(read_text(folder.path() / "run/point_paths.osim"),
              testing::HasSubstr("<KshapeActive>0.7</KshapeActive>"));
  // A muscle whose path is a function stays in a set that may take the place of the model's forces.
  const auto by_function = folder.write(
      "function.osim",
      pendulum(
          "<Millard2012EquilibriumMuscle name=\"m\"><path><FunctionBasedPath><coordinate_paths>/jointset/hinge/swing"
          "</coordinate_paths><length_function><MultivariatePolynomialFunction><dimension>1</dimension><order>1"
          "</order><coefficients>0.5 -0.1</coefficients></MultivariatePolynomialFunction></length_function>"
          "</FunctionBasedPath></path></Millard2012EquilibriumMuscle>"));
  const ProgramResult kept = run_program("export " + run + " --to osim-points --model " + by_function.string());
  ASSERT_EQ(kept.exit_code, 0) << kept.err;
  EXPECT_THAT(kept.err, testing::HasSubstr("m: its path is a function; it keeps its original path"));
  EXPECT_THAT(read_text(folder.path() / "run/point_paths.osim"), testing::HasSubstr("<FunctionBasedPath>"));
  EXPECT_EQ(run_program("export " + run + " --to osim-points").exit_code, 2);
}

TEST(ImportCommand, points_are_fitted_to_strings_in_poses_that_fill_the_range) {
  const TestFolder folder;
  ASSERT_EQ(import_swing(folder, "").exit_code, 0);
  const std::string run = (folder.path() / "run").string(), scene = (folder.path() / "scene/swing.toml").string();
  ASSERT_EQ(run_program("run " + scene + " --set method=strings --out " + run).exit_code, 0);
  const std::string points =
      "export " + run + " --to osim-points --sample 64 --model " + (folder.path() / "tiny.osim").string();
  const ProgramResult result = run_program(points);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  // Told beside the strings' own arms, which poses of a run do not have, instead of the model's.
  EXPECT_THAT(result.err, testing::HasSubstr("points; lengths 0."));
  EXPECT_THAT(result.err, testing::Not(testing::HasSubstr("from the model's own")));
  EXPECT_THAT(read_text(folder.path() / "run/point_paths.osim"), testing::HasSubstr("PathPoint"));
  EXPECT_THAT(read_text(folder.path() / "run/point_paths.osim"),
              testing::HasSubstr("<KshapeActive>0.7</KshapeActive>"));
  const nlohmann::json told = nlohmann::json::parse(run_program(points + " --json").out);
  EXPECT_EQ(told.at("written"), run + "/point_paths.osim");
  ASSERT_EQ(told.at("paths").size(), 1u);
  EXPECT_EQ(told.at("paths")[0].at("muscle"), "m");
  EXPECT_GE(told.at("paths")[0].at("points"), 2);
  EXPECT_GT(told.at("paths")[0].at("beside_run").at("arm_rms_mm"), 0);
  const nlohmann::json fitted = nlohmann::json::parse(
      run_program("export " + run + " --to osim-function --json --model " + (folder.path() / "tiny.osim").string())
          .out);
  ASSERT_EQ(fitted.at("fits").size(), 1u);
  EXPECT_EQ(fitted.at("fits")[0].at("coordinates"), nlohmann::json({"swing"}));
  EXPECT_GT(fitted.at("fits")[0].at("beside_model").at("length_rms_mm"), 0);
  EXPECT_TRUE(fitted.at("left_out").empty());
}

/// Fibers of sections lie beside the line that carries them: what they change by as it moves is no deforming of the
/// muscle's own. A run of the same surfaces by an unknown method comes back as the model's own path, therefore.
TEST(ImportCommand, fibers_that_follow_the_model_s_line_change_nothing_of_it) {
  const std::string text = pendulum(muscle(
      "m", point("/ground", "0.1 0.1 0") + point("/ground", "0.1 -0.02 0") + point("/bodyset/rod", "0.05 -0.3 0")));
  opensim::Model own = opensim::model_from(text), after = own;  // first: it uses the folder, too
  const TestFolder folder;
  const auto model = folder.write("tiny.osim", text);
  std::string rows;
  for (int i = 0; i <= 12; ++i) rows += fmt::format("{}\t{}\n", 0.1 * i, 3 * i);
  const auto motion =
      folder.write("swing.mot", "m\nversion=1\nnRows=13\nnColumns=2\ninDegrees=yes\nendheader\ntime\tswing\n" + rows);
  const std::string scene = (folder.path() / "scene").string(), run = (folder.path() / "run").string();
  ASSERT_EQ(run_program("import " + model.string() + " --motion " + motion.string() + " --out " + scene).exit_code, 0);
  ASSERT_EQ(run_program("run " + scene + "/swing.toml --set method=cylinder --out " + run).exit_code, 0);
  std::string manifest = read_text(folder.path() / "run/run.json");
  manifest.replace(manifest.find("cylinder\\\"", manifest.find("method = ")), 8, "stranger");
  folder.write("run/run.json", manifest);
  const auto page = folder.path() / "arms.html";
  const ProgramResult exported =
      run_program("export " + run + " --to osim-function --model " + model.string() + " --page " + page.string());
  ASSERT_EQ(exported.exit_code, 0) << exported.err;
  opensim::replace_paths(folder.path() / "run/function_paths.osim", after);
  opensim::Skeleton skeleton(own);
  for (const Real swing : {0.1, 0.3, 0.5}) {
    const Eigen::VectorXd q = Eigen::VectorXd::Constant(1, swing);
    skeleton.place(q);
    const Real arm = opensim::measure_path(skeleton, own.muscles[0].path, q).moment_arms[0];
    EXPECT_NEAR(opensim::measure_path(skeleton, after.muscles[0].path, q).moment_arms[0], arm, 1e-5);
  }
  const std::string shown = read_text(page);
  EXPECT_THAT(shown, testing::HasSubstr("<h2 id=\"swing\">"));
  EXPECT_THAT(shown, testing::HasSubstr("m: differs by"));
  EXPECT_THAT(shown, testing::Not(testing::HasSubstr("<script")));
}

TEST(ImportCommand, a_motion_of_many_rows_a_second_is_thinned_and_the_next_command_named) {
  const TestFolder folder;
  const auto model = folder.write(
      "tiny.osim", pendulum(muscle("m", point("/ground", "0.1 0.1 0") + point("/bodyset/rod", "0.05 -0.3 0"))));
  std::string rows;
  for (int row = 0; row <= 30; ++row) rows += std::to_string(0.001 * row) + "\t" + std::to_string(0.1 * row) + "\n";
  const auto motion =
      folder.write("swing.mot", "m\nversion=1\nnRows=31\nnColumns=2\ninDegrees=yes\nendheader\ntime\tswing\n" + rows);
  const std::string out = (folder.path() / "my scene").string();
  const ProgramResult imported =
      run_program("import " + model.string() + " --motion " + motion.string() + " --out '" + out + "'");
  ASSERT_EQ(imported.exit_code, 0) << imported.err;
  EXPECT_THAT(imported.err, testing::HasSubstr("1 muscle, 0 bones, 1 coordinate"));
  EXPECT_THAT(imported.err, testing::HasSubstr("of 31 rows 4 are taken, 0.01 s apart"));
  EXPECT_THAT(imported.err, testing::HasSubstr("next: gracilis run '" + out + "/swing.toml' --out runs/swing"));
  const ProgramResult ran = run_program("run '" + out + "/swing.toml' --out " + (folder.path() / "run").string());
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_THAT(ran.err, testing::HasSubstr("info: 4 frames; about"));
}

TEST(ImportCommand, frames_by_sections_are_timed_without_a_solver) {
  const TestFolder folder;
  ASSERT_EQ(import_swing(folder, "").exit_code, 0);
  const std::string timed =
      "bench --threads 1 " + (folder.path() / "scene/swing.toml").string() + " --set method=cylinder";
  const ProgramResult frames = run_program(timed);
  ASSERT_EQ(frames.exit_code, 0) << frames.err;
  EXPECT_THAT(frames.out, testing::HasSubstr("first_frame"));
  EXPECT_THAT(frames.out, testing::Not(testing::HasSubstr("iteration")));
  EXPECT_EQ(run_program(timed + " --subdivide 1").exit_code, 2);
}

TEST(ImportCommand, the_pose_of_bones_and_surfaces_may_be_given) {
  const TestFolder folder;
  ASSERT_EQ(import_swing(folder, "--pose swing=20").exit_code, 0);
  EXPECT_THAT(read_text(folder.path() / "scene/model.toml"), testing::HasSubstr("capture_deg = 20"));
  const TestFolder other;
  const ProgramResult wrong = import_swing(other, "--pose swim=20");
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_THAT(wrong.err, testing::HasSubstr("did you mean 'swing'?"));
  EXPECT_EQ(import_swing(other, "--rays 7").exit_code, 2);
}

/// Vertices of the muscle of import_swing by these options.
static int vertices_of_swing(const std::string& options) {
  const TestFolder folder;
  const ProgramResult imported = import_swing(folder, options);
  EXPECT_EQ(imported.exit_code, 0) << imported.err;
  const ProgramResult told = run_program("inspect --json " + (folder.path() / "scene/muscles/m.vtp").string());
  return nlohmann::json::parse(told.out).at(0).at("vertices").get<int>();
}

TEST(ImportCommand, the_number_of_sections_may_be_chosen_down_to_the_lines_own_points) {
  // Laclé 2014, eq. 3.19: 2^LSS (|V| + 1) + 1 sections of six corners, and two ends.
  EXPECT_EQ(vertices_of_swing("--rays 6 --scaling 0"), 2 * 6 + 2);
  EXPECT_EQ(vertices_of_swing("--rays 6 --scaling 2"), 5 * 6 + 2);
  EXPECT_EQ(vertices_of_swing("--rays 6 --scaling 9"), 513 * 6 + 2);
  EXPECT_EQ(vertices_of_swing("--rays 6 --scaling 2 --tendon-sections"), 6 * 6 + 2);
  EXPECT_EQ(vertices_of_swing("--rays 6 --scaling 0 --tendon-sections --tendon both-ends"), 4 * 6 + 2);
  // Else the line, which is 403 mm long, is divided evenly.
  EXPECT_EQ(vertices_of_swing("--rays 6 --section-distance-mm 20"), 22 * 6 + 2);
}

TEST(ImportCommand, surfaces_of_muscles_and_another_skeleton_come_from_files) {
  const TestFolder folder;
  folder.write("box.obj",
               "v -30 -250 -20\nv 60 -250 -20\nv -30 50 -20\nv 60 50 -20\nv -30 -250 20\nv 60 -250 20\nv -30 50 20\n"
               "v 60 50 20\nf 1 3 2\nf 2 3 4\nf 5 6 7\nf 6 8 7\nf 1 2 5\nf 2 6 5\nf 3 7 4\nf 4 7 8\nf 1 5 3\n"
               "f 3 5 7\nf 2 4 6\nf 4 8 6\n");
  const auto surfaces = folder.write("surfaces.toml", "m = { files = \"box.obj\", unit = \"mm\" }\n");
  const auto fit = folder.write("fit.toml", "[bodies.rod]\nshift_mm = [0, 0, 5]\n");
  const ProgramResult result = import_swing(folder, "--surfaces " + surfaces.string() + " --fit " + fit.string());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const std::string text = read_text(folder.path() / "scene/model.toml");
  EXPECT_THAT(text, testing::HasSubstr("centers_mm"));
  EXPECT_THAT(text, testing::HasSubstr("center = [0, 0, 0.005]"));
}

TEST(ImportCommand, a_folder_that_holds_a_model_is_left_alone) {
  const TestFolder folder;
  const auto model = folder.write("tiny.osim", pendulum());
  folder.write("model.toml", "mine");
  const ProgramResult result = run_program("import " + model.string() + " --out " + folder.path().string());
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, testing::HasSubstr("holds a model already"));
  std::filesystem::create_directory(folder.path() / "mine");
  const auto scene = folder.write("mine/rest.toml", "mine");
  const ProgramResult beside = run_program("import " + model.string() + " --out " + (folder.path() / "mine").string());
  EXPECT_EQ(beside.exit_code, 2);
  EXPECT_THAT(beside.err, testing::HasSubstr("rest.toml: is there already, and the import would replace it"));
  EXPECT_EQ(read_text(scene), "mine");
}

TEST(ImportCommand, a_missing_surface_is_named_and_fails_when_strict) {
  const TestFolder folder;
  const auto model =
      folder.write("tiny.osim", pendulum(muscle("m", from_ground_to_rod),
                                         "<attached_geometry><Mesh name=\"g\"><mesh_file>rod.vtp</mesh_file></Mesh>"
                                         "</attached_geometry>"));
  const ProgramResult result =
      run_program("import " + model.string() + " --strict --out " + (folder.path() / "out").string());
  EXPECT_EQ(result.exit_code, 4);
  EXPECT_THAT(result.err, testing::HasSubstr("body 'rod': its surface 'rod.vtp' is not found"));
}

TEST(ImportCommand, a_joint_of_an_unknown_kind_is_named_and_fails_where_strict) {
  const TestFolder folder;
  const std::string text = opensim::document(
      opensim::set("BodySet", opensim::body("rod") + opensim::body("box")) +
      opensim::set("JointSet",
                   opensim::joint("PinJoint", "hinge", "/ground", "rod", opensim::coordinate("swing")) +
                       opensim::joint("ConveyorJoint", "belt", "/bodyset/rod", "box", opensim::coordinate("q"))) +
      opensim::set("ForceSet", muscle("m", point("/ground", "0.1 0.1 0") + point("/bodyset/rod", "0.05 -0.3 0"))));
  const std::string import =
      "import " + folder.write("m.osim", text).string() + " --out " + (folder.path() / "scene").string();
  const ProgramResult strict = run_program(import + " --strict");
  EXPECT_EQ(strict.exit_code, 4);
  EXPECT_THAT(strict.err, testing::HasSubstr("ConveyorJoint 'belt'"));
  const ProgramResult free = run_program(import);
  EXPECT_EQ(free.exit_code, 0);
  EXPECT_THAT(free.err, testing::HasSubstr("ConveyorJoint 'belt'"));
}

TEST(ImportCommand, a_muscle_that_has_no_room_apart_from_another_is_named) {
  const TestFolder folder;
  const std::string points = point("/ground", "0.1 0.1 0") + point("/bodyset/rod", "0.05 -0.3 0");
  const std::string import =
      "import " + folder.write("m.osim", pendulum(muscle("m", points) + muscle("n", points))).string();
  const std::string told = "muscle 'm': between the others there is room for";
  const ProgramResult within = run_program(import + " --out " + (folder.path() / "within").string());
  EXPECT_EQ(within.exit_code, 0) << within.err;
  EXPECT_THAT(within.err, testing::Not(testing::HasSubstr(told)));
  const ProgramResult apart = run_program(import + " --apart --out " + (folder.path() / "apart").string());
  EXPECT_EQ(apart.exit_code, 0) << apart.err;
  EXPECT_THAT(apart.err, testing::HasSubstr(told));
}

}  // namespace gracilis
