#include "app/program.hpp"
#include "io/scene_folder.hpp"

#include <gracilis/io/input_file.hpp>
#include <gracilis/io/scene/demo_scene.hpp>
#include <gracilis/io/scene/scene_bytes.hpp>
#include <gracilis/view/report/html_text.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gracilis {
namespace {

using testing::HasSubstr;

const std::string place = "<script type=\"text/plain\" id=\"scene\">";

/// A run of the boxes, and a page that takes a scene.
struct LiveFolder : SceneFolder {
  LiveFolder() {
    write("boxes.toml", good_scene());
    write("page.html", "<html>" + place + "</script></html>");
  }
  ProgramResult report(const std::string& words) const { return run_program("report " + path("run").string() + words); }
  std::string with_page(const std::string& page) const { return " --live --page " + path(page).string(); }
};

}  // namespace

TEST(ReportLive, puts_the_scene_of_the_run_with_its_changes_into_the_page) {
  const LiveFolder folder;
  const std::string out = folder.path("run").string();
  ASSERT_EQ(run_program("run --out " + out + " --set motion.step_deg=5 --set volume_compliance=2e-9 " +
                        folder.path("boxes.toml").string())
                .exit_code,
            0);
  const ProgramResult result = folder.report(folder.with_page("page.html"));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out, out + "/report.html\n" + out + "/live.html\n");
  SceneOptions options;
  options.set = {"motion.step_deg=5", "volume_compliance=2e-9"};
  const Scene scene = read_scene(folder.path("boxes.toml"), options).scene;
  EXPECT_FALSE(scene.method.settings.empty());
  EXPECT_EQ(read_text(folder.path("run/live.html")),
            "<html>" + place + base64(scene_bytes(scene)) + "</script></html>");
}

TEST(ReportLive, of_the_built_in_elbow_has_the_elbow) {
  const LiveFolder folder;
  ASSERT_EQ(run_program("demo --activation biceps_brachii_long_r=0.3 elbow --flexion 4 --out " + folder.path("run").string())
                .exit_code,
            0);
  ASSERT_EQ(folder.report(folder.with_page("page.html")).exit_code, 0);
  DemoOptions demo;
  demo.scene = "elbow";
  demo.flexion_deg = 4;
  demo.activations = {{"biceps_brachii_long_r", 0.3}};
  EXPECT_THAT(read_text(folder.path("run/live.html")), HasSubstr(base64(scene_bytes(load_demo(demo, {}).scene))));
}

TEST(ReportLive, says_what_is_wrong_and_writes_nothing) {
  const LiveFolder folder;
  ASSERT_EQ(
      run_program("run " + folder.path("boxes.toml").string() + " --out " + folder.path("run").string()).exit_code, 0);
  const ProgramResult other = folder.report(folder.with_page("boxes.toml"));
  EXPECT_EQ(other.exit_code, 3);
  EXPECT_THAT(other.err, HasSubstr("boxes.toml: is no page that takes a scene"));
  EXPECT_EQ(other.out, "");
  EXPECT_EQ(folder.report(folder.with_page("nothing.html")).exit_code, 3);
  EXPECT_EQ(folder.report(" --page " + folder.path("page.html").string()).exit_code, 2) << "without --live";
  std::filesystem::remove(folder.path("boxes.toml"));
  const ProgramResult gone = folder.report(folder.with_page("page.html"));
  EXPECT_EQ(gone.exit_code, 3);
  EXPECT_THAT(gone.err, HasSubstr("boxes.toml"));
  for (const char* page : {"run/live.html", "run/report.html"})
    EXPECT_FALSE(std::filesystem::exists(folder.path(page))) << page;
}

TEST(ReportLive, of_a_damaged_command_line_is_an_error_of_the_file) {
  const LiveFolder folder;
  ASSERT_EQ(
      run_program("run " + folder.path("boxes.toml").string() + " --out " + folder.path("run").string()).exit_code, 0);
  const std::string manifest = read_text(folder.path("run/run.json"));
  const std::string last = "\"" + folder.path("run").string() + "\"";
  folder.write("run/run.json", with(manifest, last, last + ", \"--set\""));
  const ProgramResult result = folder.report(folder.with_page("page.html"));
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.err, HasSubstr("run.json:command: is damaged"));
}

}  // namespace gracilis
