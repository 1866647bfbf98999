#include <build_paths.hpp>

#include "app/program.hpp"
#include "view/recorded_runs.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <io/test_files.hpp>

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

#include <unistd.h>

#include <algorithm>
#include <regex>

using namespace gracilis;

namespace {

/// A picture that the window took, as bytes; empty where it took none.
struct Shot {
  int width = 0, height = 0;
  std::vector<Vec3> pixels;  ///< 0 ... 255, the lower row first

  Vec3 at(int x, int y) const { return pixels.at(static_cast<std::size_t>(y * width + x)); }
  /// How many pixels within the columns and rows fulfill a condition.
  template <class Condition>
  int count(int x0, int x1, int y0, int y1, Condition condition) const {
    int result = 0;
    for (int y = y0; y < y1; ++y)
      for (int x = x0; x < x1; ++x) result += condition(at(x, y)) ? 1 : 0;
    return result;
  }
};

Shot read_shot(const std::filesystem::path& path) {
  Shot shot;
  if (!std::filesystem::exists(path)) return shot;
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  vtkImageData& image = *reader->GetOutput();
  shot.width = image.GetDimensions()[0], shot.height = image.GetDimensions()[1];
  for (int y = 0; y < shot.height; ++y)
    for (int x = 0; x < shot.width; ++x)
      shot.pixels.emplace_back(image.GetScalarComponentAsDouble(x, y, 0, 0),
                               image.GetScalarComponentAsDouble(x, y, 0, 1),
                               image.GetScalarComponentAsDouble(x, y, 0, 2));
  return shot;
}

bool is_dark_red(const Vec3& c) { return c.x() > 70 && c.x() > 1.8 * c.y() && c.x() > 1.8 * c.z(); }
bool is_ivory(const Vec3& c) { return c.x() > 120 && c.x() > c.z() + 12 && c.x() < 1.35 * c.z(); }

/// How many pixels differ, but for the lower right corner, where the window tells how long it takes to draw: that
/// changes from picture to picture, in its width, too.
int difference(const Shot& a, const Shot& b) {
  if (a.pixels.empty() || a.width != b.width || a.height != b.height) {
    ADD_FAILURE() << "a picture is missing";
    return 0;
  }
  int result = 0;
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x) {
      const bool tells_time = x >= a.width - 160 && y >= 42 && y < 66;
      result += !tells_time && (a.at(x, y) - b.at(x, y)).norm() > 30 ? 1 : 0;
    }
  return result;
}

}  // namespace

/// The window on a display of its own, driven by keys and mouse as X delivers them.
class ViewCommand : public testing::Test {
 protected:
  void SetUp() override {
    for (const char* program : {"/usr/bin/Xvfb", "/usr/bin/xvfb-run", "/usr/bin/xdotool"})
      if (access(program, X_OK) != 0) GTEST_SKIP() << "there is no " << program;
  }

  /// Opens a window of 800 × 600, lets the script act on it, closes it. In the script `key NAME...` presses keys one
  /// after the other, `at X Y` moves the mouse, from the upper left corner. Returns what the program said.
  std::string drive(const std::string& what, const std::string& script) {
    const auto file = folder.write(
        "drive.sh", "cd '" + folder.path().string() + "'\ntimeout 150 " + build_paths::program + " view " + what +
                        " --size 800x600 --pictures . 2>log &\nprogram=$!\n"
                        "window=$(timeout 60 xdotool search --sync --onlyvisible --name '^Gracilis: ' | head -1)\n"
                        "xdotool windowmove $window 0 0 windowfocus $window\nsleep 1\n"
                        "key() { for k; do xdotool key $k; sleep 0.3; done; }\n"
                        "at() { xdotool mousemove $1 $2; sleep 0.1; }\n" +
                        script + "\nkey q\nwait $program\necho exit $? >>log\n");
    const std::string command =
        "timeout 200 xvfb-run -a -s '-screen 0 1280x800x24' bash '" + file.string() + "' >/dev/null 2>&1";
    EXPECT_EQ(std::system(command.c_str()), 0);
    std::stringstream log;
    log << std::ifstream(folder.path() / "log").rdbuf();
    EXPECT_NE(log.str().find("exit 0"), std::string::npos) << log.str();
    return log.str();
  }
  Shot shot(int number) { return read_shot(folder.path() / ("gracilis_000" + std::to_string(number) + ".png")); }
  std::string run() { return "'" + (folder.path() / "run").string() + "'"; }

  TestFolder folder;
};

TEST_F(ViewCommand, shows_muscles_and_bones_steps_and_turns) {
  FlexingLeg(21).written(folder.path() / "run");
  drive(run(),
        "key p; key End p; key 1 p; at 400 300; xdotool mousedown 1; at 470 330; at 520 340; xdotool mouseup 1; key p");
  const Shot first = shot(1), last = shot(2), front = shot(3), turned = shot(4);
  ASSERT_EQ(turned.width, 800);
  EXPECT_GT(first.count(240, 780, 70, 560, is_dark_red), 2000);
  EXPECT_GT(first.count(240, 780, 70, 560, is_ivory), 2000);
  EXPECT_GT(difference(first, last), 2000);
  EXPECT_GT(difference(last, front), 2000);
  EXPECT_GT(difference(front, turned), 2000);
}

TEST_F(ViewCommand, words_for_directions_stand_below_what_is_shown) {
  FlexingLeg(3).written(folder.path() / "run");
  drive(run(), "key 3 p 1 p 5 p");
  const auto of_word = [](const Vec3& c) { return c.maxCoeff() - c.minCoeff() < 6 && c.x() > 80 && c.x() < 160; };
  const auto of_shape = [](const Vec3& c) { return is_dark_red(c) || is_ivory(c); };
  for (const int view : {1, 2, 3}) {
    // Beside the texts on the left; the status ends 66 pixels above the lower edge.
    const int below = shot(view).count(236, 574, 76, 98, of_word);
    EXPECT_GT(below, 100) << view;
    EXPECT_EQ(shot(view).count(236, 574, 66, 105, of_shape), 0) << view;
    EXPECT_LT(shot(view).count(236, 574, 105, 554, of_word), below / 3) << view << ": edges of shapes alone";
  }
}

TEST_F(ViewCommand, plays_and_pauses_and_tells_how_fast) {
  FlexingLeg(40).written(folder.path() / "run");
  // Several pictures while it plays: it plays in a circle, and one of them may happen to show the first frame again.
  const std::string log = drive(run(), "key p; key space; key p p p p p; key space p p");
  int most = 0;
  for (int number = 2; number <= 6; ++number) most = std::max(most, difference(shot(1), shot(number)));
  EXPECT_GT(most, 2000);
  EXPECT_LT(difference(shot(7), shot(8)), 300);  // paused: only the time to draw may differ
  std::smatch match;
  ASSERT_TRUE(std::regex_search(log, match, std::regex("([0-9.]+) frames per second while playing"))) << log;
  EXPECT_GT(std::stod(match[1]), 0) << log;
}

TEST_F(ViewCommand, a_click_on_a_name_makes_a_muscle_transparent_and_then_hides_it) {
  FlexingLeg(3).written(folder.path() / "run");
  drive(run(), "key c p; at 60 60; xdotool click 1; sleep 0.3; key p; xdotool click 1; sleep 0.3; key p");
  const int solid = shot(1).count(240, 780, 70, 560, is_dark_red),
            hidden = shot(3).count(240, 780, 70, 560, is_dark_red);
  EXPECT_GT(solid, 2000);
  EXPECT_LT(hidden, solid / 20);
  EXPECT_GT(difference(shot(1), shot(2)), 1000);
  EXPECT_GT(difference(shot(2), shot(3)), 1000);
}

TEST_F(ViewCommand, the_track_scrubs_and_help_covers_the_middle) {
  FlexingLeg(21).written(folder.path() / "run");
  drive(run(), "key End p Home; at 779 577; xdotool click 1; sleep 0.3; key p; key question p");
  EXPECT_LT(difference(shot(1), shot(2)), 300);
  EXPECT_GT(shot(3).count(170, 630, 150, 450, [](const Vec3& c) { return c.minCoeff() > 235; }), 80000);
}

TEST_F(ViewCommand, colors_by_stretch_and_shows_its_scale) {
  FlexingLeg(21).written(folder.path() / "run");
  drive(run(), "key End p c c c c p");
  const auto blue = [](const Vec3& c) { return c.z() > c.x() + 60; };
  EXPECT_LT(shot(1).count(574, 680, 94, 106, blue), 50);
  EXPECT_GT(shot(2).count(574, 680, 94, 106, blue), 200);  // the scale's lower end
  EXPECT_LT(shot(2).count(240, 780, 150, 560, is_dark_red), shot(1).count(240, 780, 150, 560, is_dark_red) / 2);
}

TEST_F(ViewCommand, zooms_by_the_wheel_and_moves_with_shift) {
  FlexingLeg(3).written(folder.path() / "run");
  drive(run(),
        "key p; at 400 300; for i in 1 2 3; do xdotool click 5; done; key p; "
        "xdotool keydown shift mousedown 1; at 440 340; at 460 360; xdotool mouseup 1 keyup shift; key p");
  EXPECT_LT(shot(2).count(0, 800, 90, 560, is_dark_red), 0.8 * shot(1).count(0, 800, 90, 560, is_dark_red));
  EXPECT_GT(difference(shot(2), shot(3)), 2000);
  EXPECT_NEAR(shot(3).count(0, 800, 90, 560, is_dark_red), shot(2).count(0, 800, 90, 560, is_dark_red), 400);
}

TEST_F(ViewCommand, keys_show_edges_fibers_and_ghosts) {
  FlexingLeg(21).written(folder.path() / "run");
  drive(run(), "key End p s p s s f p g p");
  EXPECT_GT(difference(shot(1), shot(2)), 1000);  // edges
  EXPECT_GT(difference(shot(1), shot(3)), 2000);  // fibers, and muscles that one sees through
  EXPECT_GT(difference(shot(3), shot(4)), 1000);  // the smaller muscle of the first frame
}

TEST_F(ViewCommand, jumps_to_the_frame_whose_number_is_typed) {
  FlexingLeg(21).written(folder.path() / "run");
  drive(run(), "key End p Home p j 2 0 Return p j 9 9 9 Return p");
  EXPECT_GT(difference(shot(1), shot(2)), 2000);
  EXPECT_LT(difference(shot(1), shot(3)), 300);
  EXPECT_LT(difference(shot(1), shot(4)), 300);
}

TEST_F(ViewCommand, slices_the_distance_fields_of_bones) {
  FlexingLeg(3).written(folder.path() / "run");
  drive(run(), "key p x; sleep 4; key p; at 600 48; xdotool click 1; key p");
  const auto blue = [](const Vec3& c) { return c.z() > c.x() + 60; };
  EXPECT_GT(shot(2).count(240, 560, 90, 560, blue), shot(1).count(240, 560, 90, 560, blue) + 500);
  EXPECT_GT(difference(shot(2), shot(3)), 1000);  // the slider moves the plane
}

TEST_F(ViewCommand, presses_the_keys_of_a_script) {
  FlexingLeg(21).written(folder.path() / "run");
  drive(run() + " --keys 'p End c p'", "sleep 3");
  ASSERT_GT(shot(2).width, 0);
  EXPECT_GT(difference(shot(1), shot(2)), 2000);
}

/// The demo: a slider is pulled, arrows are asked for, another slider is pulled, all is paused.
TEST_F(ViewCommand, a_scene_follows_its_sliders_and_tells_what_constraints_moved) {
  // The first slider is hip_flexion_r: x from 574 to 784, 68 pixels below the upper edge.
  const std::string log = drive("demo",
                                "for i in $(seq 90); do grep -q 'pull the sliders' log && break; sleep 1; done; "
                                "key b w p; "  // the muscles alone, as large as can be
                                "at 720 68; xdotool click 1; sleep 10; key p; key space p; sleep 2; key p; "
                                "key v p space; at 620 68; xdotool click 1; sleep 8; key space p v p");
  EXPECT_NE(log.find("pull the sliders"), std::string::npos);
  EXPECT_GT(difference(shot(1), shot(2)), 5000);
  EXPECT_LT(difference(shot(3), shot(4)), 300);  // paused
  // Arrows of volume, bending and contact; which of them are long depends on whether the muscles have come to rest.
  const auto cold = [](const Vec3& c) { return c.y() > c.x() + 40; };
  EXPECT_LT(shot(5).count(200, 570, 90, 560, cold), 20);  // no arrows yet: nobody had asked for them
  EXPECT_GT(shot(6).count(200, 570, 90, 560, cold), 200);
  EXPECT_GT(difference(shot(6), shot(7)), 500);  // the whole frame, and its first iteration
}

TEST_F(ViewCommand, a_bone_is_dragged_and_a_click_on_a_muscle_tells_its_numbers) {
  // The femur's shaft is at 415, 440, gluteus maximus before and after at 360, 230.
  drive("demo",
        "for i in $(seq 90); do grep -q 'pull the sliders' log && break; sleep 1; done; sleep 1; key p; "
        "at 360 230; xdotool click 1; sleep 1; key p; at 100 480; xdotool click 1; sleep 1; key p; "
        "at 415 440; xdotool mousedown 1; at 430 440; at 470 430; sleep 0.5; xdotool mouseup 1; sleep 6; key p");
  EXPECT_GT(difference(shot(1), shot(2)), 100) << "the dot and the numbers";
  EXPECT_LT(difference(shot(1), shot(2)), 5000);
  EXPECT_LT(difference(shot(1), shot(3)), 300) << "a click beside it lets go";
  EXPECT_GT(difference(shot(3), shot(4)), 3000) << "the femur has followed";
}

TEST(ViewCommandWithoutDisplay, says_what_to_do_instead) {
  const TestFolder folder;
  FlexingLeg(2).written(folder.path());
  const std::string display = std::getenv("DISPLAY") ? std::getenv("DISPLAY") : "";
  unsetenv("DISPLAY");
  const ProgramResult result = run_program("view '" + folder.path().string() + "'");
  if (!display.empty()) setenv("DISPLAY", display.c_str(), 1);
  EXPECT_EQ(result.exit_code, 4);
  EXPECT_THAT(result.err, testing::HasSubstr("gracilis render"));
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
}
