#include "view/guide_blocks.hpp"

#include <gtest/gtest.h>

/// Commands of the manual that take minutes, those that need the cadaver's hip, and those with which helps end.
namespace gracilis {

TEST(GuideWalk, commands_that_take_long_work) {
  const TestFolder folder;
  EXPECT_GT(walk_manual(folder, [](const CommandBlock& block) { return block.says("long") && !block.says("data"); }),
            0);
}

TEST(GuideWalk, commands_on_the_cadaver_hip_work) {
  GRACILIS_NEEDS_DATA("lhdl-hip");
  setenv("GRACILIS_DATA", data_root().c_str(), 1);
  const TestFolder folder;
  EXPECT_GT(walk_manual(folder, [](const CommandBlock& block) { return block.says("data"); }), 0);
}

/// What stands in the place of a reader's files in the example of a command's help; window: README's walk opens it.
static const std::map<std::string, std::vector<std::string>> example_marks = {
    {"demo", {"--flexion 90 -> --flexion 2 --only adductor_longus_r --set method=skinning"}},
    {"run", {"leg.toml -> out/my_hip.toml --set method=skinning"}},
    {"compare", {"leg.toml -> out/my_hip.toml", "xpbd,tissue -> skinning,strings"}},
    {"rom", {"hip.toml -> out/my_hip.toml --set method=skinning", "-10:60:2 -> 0:8:4"}},
    {"study plan", {}},
    {"study run", {}},
    {"study status", {}},
    {"study collect", {}},
    {"study report", {"gracilis study report -> gracilis study run study.toml && gracilis study report"}},
    {"calibrate", {"hip.toml -> out/my_hip.toml --set method=skinning"}},
    {"fibers", {"leg.toml -> out/my_hip.toml"}},
    {"activations join", {"walks -> motions"}},
    {"print-config", {}},
    {"bench", {"leg.toml --frame 10 -> out/my_hip.toml --frame 1 --repeats 1"}},
    {"inspect", {"leg.toml -> out/my_hip.toml"}},
    {"render", {"render leg -> render out/demo"}},
    {"export", {"export leg -> export out/demo", "0,45,90 -> 0,2,4"}},
    {"report", {"report leg -> report out/demo"}},
    {"verify", {"verify leg -> verify out/demo"}},
    {"view", {"gracilis view leg.toml -> true"}},
    {"prepare",
     {"biceps.stl triceps.stl -> scans/adductor_longus_r.vtp", "humerus.stl --unit mm -> scans/hip_bone_r.vtp"}},
    {"new",
     {"hip_bone_r.ply -> scans/hip_bone_r.vtp", "femur_r.ply -> scans/femur_r.vtp",
      "gluteus_maximus_r.ply -> scans/adductor_longus_r.vtp"}},
    {"scene", {}},
    {"transfer", {"hip.toml -> demo --only adductor_longus_r --keep-overlaps"}},
    {"wrap",
     {"gracilis wrap model.osim hip.toml --geometry Geometry -> gracilis import tiny.osim --motion walk.mot --out "
      "my_model && gracilis wrap tiny.osim my_model/walk.toml --sample 40"}},
    {"import", {"model.osim -> tiny.osim"}},
    {"motions", {"model.osim --joint hip_r -> tiny.osim --joint hinge"}},
    {"paths", {"model.osim -> tiny.osim", "hip_flexion_r=-10:60:2 -> swing=-10:60:10"}},
    {"static-optimization", {}}};

TEST(GuideWalk, examples_of_helps_work) {
  const TestFolder folder;
  const std::filesystem::path files = folder.path() / "files";
  make_walk_files(files);
  std::set<std::string> commands, expected;
  std::istringstream lines(run_program("complete 'gracilis '").out);
  for (std::string line; std::getline(lines, line);)
    if (!line.starts_with("-")) commands.insert(line.substr(0, line.find('\t')));
  for (const auto& [command, marks] : example_marks) {
    expected.insert(command.substr(0, command.find(' ')));
    const std::string help = run_program(command + " --help").out;
    const std::size_t example = help.rfind("Example: ");
    ASSERT_NE(example, std::string::npos) << command;
    const std::filesystem::path here = folder.path() / command;
    std::filesystem::copy(files, here, std::filesystem::copy_options::recursive);
    walk({"the help of " + command, marks, help.substr(example + 9)}, here);
  }
  EXPECT_EQ(commands, expected) << "a command's example needs a row here";
}

}  // namespace gracilis
