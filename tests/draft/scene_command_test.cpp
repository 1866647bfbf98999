#include "body_folder.hpp"

#include "app/program.hpp"
#include "io/test_files.hpp"

#include <gracilis/geometry/measures.hpp>
#include <gracilis/io/input_file.hpp>
#include <gracilis/io/mesh/mesh_writer.hpp>
#include <gracilis/io/scene/demo_scene.hpp>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <sstream>

/// The program itself, from a folder to a run.
namespace gracilis {

using testing::HasSubstr;

TEST(SceneCommand, a_folder_becomes_a_scene_with_a_picture_that_runs_and_tells_its_guesses) {
  const TestFolder folder;
  write_body(folder.path() / "hip", demo_scene("hip"),
             {{"hip_bone_r", "hip_bone_r.vtp"},
              {"sacrum", "sacrum.vtp"},
              {"femur_r", "femur_r.vtp"},
              {"adductor_longus_r", "adductor_longus_r.vtp"}});
  const std::string in = (folder.path() / "hip").string(), scene = (folder.path() / "hip" / "made.toml").string();
  const ProgramResult made = run_program("scene " + in + " --out " + scene);
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_THAT(made.out, HasSubstr("3 bones, 1 joint, 1 muscle"));
  EXPECT_THAT(made.out, HasSubstr("guessed joint hip_r: a sphere"));
  EXPECT_THAT(made.out, HasSubstr("guessed adductor_longus_r insertion"));
  EXPECT_THAT(made.err, HasSubstr("next: gracilis run " + scene));
  const bool no_picture = made.err.find("no picture") != std::string::npos;
  EXPECT_TRUE(no_picture || std::filesystem::file_size(folder.path() / "hip" / "made.png") > 10000);

  std::string text = read_text(scene);
  EXPECT_THAT(text, HasSubstr("# guessed: within "));
  const std::string motion = "key_poses_deg = [[0], [60]]";
  ASSERT_NE(text.find(motion), std::string::npos);
  folder.write("hip/made.toml", text.replace(text.find(motion), motion.size(), "key_poses_deg = [[0], [4]]"));
  const std::string out = (folder.path() / "run").string();
  const ProgramResult run = run_program("run " + scene + " --set method=skinning --out " + out);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  const nlohmann::json guessed = nlohmann::json::parse(read_text(out + "/run.json"))["guessed"];
  const auto told_of = [&](const std::string& subject) {
    return std::count_if(guessed.begin(), guessed.end(),
                         [&](const nlohmann::json& line) { return line.get<std::string>().starts_with(subject); });
  };
  EXPECT_EQ(told_of("joint hip_r: a sphere"), 1) << guessed;
  EXPECT_EQ(told_of("adductor_longus_r "), 2) << "each end once: " << guessed;

  EXPECT_EQ(run_program("scene " + in + " --out " + scene).exit_code, 2) << "it is there already";
  const ProgramResult for_programs = run_program("scene " + in + " --force --json --out " + scene);
  ASSERT_EQ(for_programs.exit_code, 0) << for_programs.err;
  const nlohmann::json told = nlohmann::json::parse(for_programs.out);
  EXPECT_EQ(told["scene"], scene);
  EXPECT_EQ(told["bones"].size(), 3u);
  EXPECT_EQ(told["joints"], nlohmann::json({"hip_r"}));
  EXPECT_EQ(told["muscles"], nlohmann::json({"adductor_longus_r"}));
  const auto is_of_joint = [](const nlohmann::json& guess) { return guess["subject"] == "joint hip_r"; };
  const auto of_joint = std::find_if(told["guesses"].begin(), told["guesses"].end(), is_of_joint);
  ASSERT_NE(of_joint, told["guesses"].end());
  EXPECT_THAT((*of_joint)["how"].get<std::string>(), HasSubstr("a sphere"));
  EXPECT_GT((*of_joint)["certainty"], 0.5);
  EXPECT_EQ(run_program("scene " + in + " --force --out " + scene).exit_code, 0)
      << "the scene's own table is none of the folder's landmarks";
  std::filesystem::create_directories(folder.path() / "empty");
  EXPECT_EQ(run_program("scene " + (folder.path() / "empty").string() + " --out " + scene + " --force").exit_code, 3);
}

TEST(SceneCommand, mends_what_a_run_would_refuse_into_a_folder_beside_the_scene) {
  const TestFolder folder;
  Scene body = demo_scene("hip");
  for (Muscle& muscle : body.muscles) {
    Eigen::Matrix3Xi& faces = muscle.surface.faces;
    faces.conservativeResize(3, faces.cols() - 4);
  }
  write_body(folder.path() / "hip", body,
             {{"hip_bone_r", "hip_bone_r.vtp"}, {"femur_r", "femur_r.vtp"}, {"adductor_longus_r", "add_long_r.vtp"}});
  const std::string in = (folder.path() / "hip").string(), scene = (folder.path() / "hip" / "made.toml").string();
  const ProgramResult without = run_program("scene " + in + " --out " + scene);
  EXPECT_EQ(without.exit_code, 3);
  EXPECT_THAT(without.err, HasSubstr("gracilis prepare"));
  const std::filesystem::path mended = folder.path() / "hip" / "made_mended" / "adductor_longus_r.vtp";
  EXPECT_FALSE(std::filesystem::exists(mended));
  const ProgramResult made = run_program("scene " + in + " --prepare --out " + scene);
  if (made.err.find("built without 'prepare'") != std::string::npos) {
    EXPECT_EQ(made.exit_code, 2);
    return;
  }
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_THAT(made.out, HasSubstr("mended adductor_longus_r: " + mended.string()));
  EXPECT_TRUE(std::filesystem::exists(mended));
  EXPECT_EQ(run_program("inspect " + scene).exit_code, 0);
  const ProgramResult again = run_program("scene " + in + " --prepare --force --out " + scene);
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_THAT(again.out, HasSubstr("2 bones, 1 joint, 1 muscle\n")) << "what is mended is not found again";
  EXPECT_THAT(again.out, testing::Not(HasSubstr("left out")));
}

TEST(NewCommand, surfaces_become_a_commented_scene_that_runs) {
  const TestFolder folder;
  write_body(folder.path() / "hip", demo_scene("hip"),
             {{"hip_bone_r", "hip_bone_r.vtp"}, {"femur_r", "femur_r.vtp"}, {"adductor_longus_r", "add_long_r.vtp"}});
  const std::string scene = (folder.path() / "hip.toml").string();
  const ProgramResult made = run_program("new " + (folder.path() / "hip").string() + "/*.vtp --out " + scene);
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_THAT(made.out, HasSubstr("2 bones, 1 joint, 1 muscle"));
  EXPECT_THAT(made.out, HasSubstr("next: gracilis run " + scene));
  const std::string text = read_text(scene);
  for (const char* table : {"[[bones]] # ", "[[joints]] # ", "[[joints.axes]] # ", "[[muscles]] # ",
                            "[[muscles.attachments]] # ", "[motion] # "})
    EXPECT_THAT(text, HasSubstr(table));
  EXPECT_EQ(run_program("inspect " + scene).exit_code, 0);
}

TEST(NewCommand, surfaces_of_unknown_names_become_a_scene_to_fill_in) {
  const TestFolder folder;
  write_body(folder.path() / "x", demo_scene("hip"),
             {{"hip_bone_r", "one.vtp"}, {"femur_r", "two.vtp"}, {"adductor_longus_r", "three.vtp"}});
  const std::string in = (folder.path() / "x").string(), scene = (folder.path() / "x.toml").string();
  const ProgramResult made =
      run_program("new " + in + "/three.vtp --bone " + in + "/one.vtp " + in + "/two.vtp --out " + scene);
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_THAT(made.out, HasSubstr("2 bones, 0 joints, 1 muscle"));
  EXPECT_THAT(made.out, HasSubstr("missing: joints"));
  EXPECT_NE(run_program("inspect " + scene).exit_code, 0) << "a second bone that nothing moves";

  // What stands behind "# missing:", without its '# ', is a scene.
  std::istringstream lines(read_text(scene));
  std::string filled;
  bool missing = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.empty()) missing = false;
    filled += (missing && line.starts_with("# ") && !line.starts_with("# missing:") ? line.substr(2) : line) + "\n";
    if (line.starts_with("# missing:")) missing = true;
  }
  const std::string center = "center = [0, 0, 0]";
  ASSERT_NE(filled.find(center), std::string::npos);
  folder.write("x.toml", filled);
  const ProgramResult inspected = run_program("inspect " + scene);
  EXPECT_EQ(inspected.exit_code, 0) << inspected.out << inspected.err << filled;

  EXPECT_EQ(run_program("new " + in + " --out " + scene + " --force").exit_code, 3) << "a folder";
  EXPECT_EQ(run_program("new " + in + "/none.vtp --out " + scene + " --force").exit_code, 3);
}

TEST(NewCommand, takes_files_without_a_known_bone_to_be_in_the_unit_that_their_size_tells_and_says_so) {
  const TestFolder folder;
  const TriangleMesh muscle = demo_scene("hip").muscles[0].surface;
  const Real longest = bounding_box(muscle.vertices).sizes().maxCoeff();
  for (const auto& [unit, length] : {std::pair("m", 1.0), {"cm", 0.01}, {"mm", 0.001}}) {
    const std::filesystem::path file = folder.path() / (std::string("belly_") + unit + ".vtp");
    write_surface(file, muscle.vertices / length, muscle.faces);
    const std::string scene = file.string() + ".toml";
    const ProgramResult made = run_program("new " + file.string() + " --out " + scene);
    EXPECT_EQ(made.exit_code, 0) << made.err;
    EXPECT_THAT(made.err, HasSubstr(fmt::format("taken to be in {}: the longest surface is then {:.3g} cm long", unit,
                                                100 * longest)));
    const std::string said = unit == std::string("m") ? "name = " : fmt::format("unit = \"{}\"", unit);
    EXPECT_THAT(read_text(scene), HasSubstr(said));
    EXPECT_THAT(run_program("inspect " + file.string()).out, HasSubstr(std::string("unit seems to be: ") + unit));
  }
}

}  // namespace gracilis
