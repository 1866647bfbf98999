#include <gracilis/anatomy/joints/joint_pose.hpp>
#include <gracilis/anatomy/overlap/bone_field.hpp>
#include <gracilis/io/input_file.hpp>
#include <gracilis/io/scene/demo_scene.hpp>
#include <gracilis/methods/registry.hpp>
#include <gracilis/simulate/simulation.hpp>
#include <gracilis/view/report/live_page.hpp>
#include <gracilis/view/report/page_method.hpp>

#include "io/test_files.hpp"
#include "view/browser.hpp"
#include "view/live_page_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <thread>

using namespace gracilis;
using testing::Each;
using testing::IsEmpty;
using testing::StartsWith;
using PageJson = nlohmann::json;

namespace {

/// The same steps as the page makes (web/page/worker.js), by this machine.
std::vector<Points> shapes_of_this_machine(Scene scene, const MethodChoice& method, std::size_t coordinate,
                                           Real flexion) {
  scene.method = method;
  drive_all(scene);
  Simulation simulation(scene,
                        make_method(scene,
                                    [&](const DistanceFieldSettings& settings) {
                                      std::vector<DistanceField> fields;
                                      for (const Bone& bone : scene.bones)
                                        fields.push_back(build_bone_field(bone, settings));
                                      return fields;
                                    }),
                        Simulation::Keeps::last_frame);
  std::vector<Real> coordinates = capture_coordinates(scene);
  for (int step = 1; coordinates[coordinate] != flexion; ++step) {
    coordinates[coordinate] += std::clamp(flexion - coordinates[coordinate], -radians(1.25), radians(1.25));
    Pose pose = pose_at(scene, coordinates);
    pose.time = step * usual_time_step;
    pose.activations.assign(scene.muscles.size(), 0);
    simulation.advance(pose, usual_time_step);
  }
  std::vector<Points> shapes;
  for (const MuscleShape& shape : simulation.frame()->muscles) shapes.push_back(shape.points);
  return shapes;
}

/// As the page takes muscles by any method but the scene's own.
Scene without_own_settings(Scene scene) {
  for (Muscle& muscle : scene.muscles) muscle.settings.clear();
  return scene;
}

class LivePage : public testing::Test {
 protected:
  void SetUp() override {
    if (!Browser::is_there()) GTEST_SKIP() << "there is no /usr/bin/chromium";
    if (!std::filesystem::exists(live_page())) GTEST_SKIP() << "the page was not built (ninja gracilis_web)";
    browser_ = &Browser::fresh();
  }

  /// Until the expression is true.
  void wait_for(const std::string& expression) {
    for (int i = 0; i < 1200 && browser_->evaluate("!!(" + expression + ")") != true; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    ASSERT_EQ(browser_->evaluate("!!(" + expression + ")"), true)
        << expression << ": " << browser_->evaluate("element('status').textContent")
        << browser_->evaluate("[page.failures, page.frame.coordinates, page.frame.method]");
  }

  void open(const std::filesystem::path& page = live_page()) {
    browser_->open(page);
    wait_for(is_ready);
  }

  void slide(const std::string& name, Real value) {
    browser_->evaluate("{ const slider = element('" + name + "'); slider.value = " + std::to_string(value) +
                       "; slider.dispatchEvent(new Event('input')); }");
  }

  Real largest_difference(const std::vector<Points>& expected) {
    Real largest = 0;
    for (std::size_t m = 0; m < expected.size(); ++m) {
      const PageJson points = browser_->evaluate("[...page.frame.muscles[" + std::to_string(m) + "].points]");
      EXPECT_EQ(points.size(), static_cast<std::size_t>(expected[m].size()));
      for (Index i = 0; i < expected[m].size(); ++i)
        largest = std::max(largest, std::abs(points[static_cast<std::size_t>(i)].get<Real>() - expected[m].data()[i]));
    }
    return largest;
  }

  static constexpr const char* is_ready =
      "page.frame && !element('method').disabled && element('status').textContent === ''";
  Browser* browser_ = nullptr;
};

TEST_F(LivePage, shows_the_shapes_of_this_machine_without_a_word_on_the_console) {
  open();
  slide("hip_flexion_r", 30);
  wait_for("page.frame.coordinates[0] === 30 / unitOf({}).factor");
  const Scene hip = without_own_settings(demo_scene("hip"));
  EXPECT_LT(largest_difference(shapes_of_this_machine(hip, page_method(hip), 0, radians(30))), 1e-4);
  EXPECT_NE(browser_->evaluate("element('time').textContent"), "–");
  EXPECT_GT(browser_->evaluate("page.history.frames.length").get<int>(), 20);
  EXPECT_THAT(browser_->complaints, IsEmpty());
  EXPECT_THAT(browser_->requests, Each(StartsWith("blob:null/"))) << "beside the worker, which stands in the page";
}

TEST_F(LivePage, is_moved_by_keys_alone_and_reads_no_numbers_aloud_that_change_with_every_frame) {
  open();
  browser_->evaluate("element('hip_flexion_r').focus()");
  for (int i = 0; i < 4; ++i) browser_->press("ArrowRight");
  wait_for(
      "page.frame.coordinates[0] > 0 && page.frame.coordinates[0] === element('hip_flexion_r').value / "
      "unitOf({}).factor");
  EXPECT_EQ(browser_->evaluate("document.activeElement.getAttribute('aria-valuetext')"),
            browser_->evaluate("element('hip_flexion_r').value + ' degrees'"));
  browser_->evaluate("element('canvas').focus()");
  const PageJson before = browser_->evaluate("[page.stage.orbit.turn, page.stage.orbit.halfHeight]");
  browser_->press("ArrowLeft");
  browser_->press("+");
  const PageJson after = browser_->evaluate("[page.stage.orbit.turn, page.stage.orbit.halfHeight]");
  EXPECT_NE(after[0], before[0]) << "the view has turned";
  EXPECT_LT(after[1], before[1]) << "and come nearer";
  // An <output> is read whenever it changes, unless it says otherwise.
  EXPECT_EQ(browser_->evaluate("[...document.querySelectorAll('output:not([aria-live=off])')].map(each => each.id)"),
            PageJson::array());
  EXPECT_GT(browser_->evaluate("document.querySelectorAll('output').length").get<int>(), 9);
}

TEST_F(LivePage, moves_a_scene_that_was_put_into_it) {
  const TestFolder folder;
  Scene scene = demo_scene("elbow");
  scene.name = "my \"elbow\" </script>";
  scene.muscles.pop_back();
  scene.method = {"strings", {{"support_reach", 0.05}}};
  write_live_page(folder.path() / "live.html", live_page(), scene);
  open(folder.path() / "live.html");
  EXPECT_EQ(browser_->evaluate("document.querySelector('h1').textContent"), scene.name);
  EXPECT_EQ(browser_->evaluate("page.scene.methods[1].name"), "strings, as the scene says");
  EXPECT_EQ(browser_->evaluate("page.scene.muscles.length").get<std::size_t>(), scene.muscles.size());
  slide("elbow_flexion", 40);
  wait_for("page.frame.coordinates[1] === 40 / unitOf({}).factor");
  EXPECT_EQ(browser_->evaluate("element('x-axis').value"), "1") << "plots are against what is moved";
  browser_->evaluate("{ const box = element('x-axis'); box.value = -1; box.dispatchEvent(new Event('change')); }");
  const Scene elbow = without_own_settings(scene);
  EXPECT_LT(largest_difference(shapes_of_this_machine(elbow, page_method(elbow), 1, radians(40))), 1e-4);
  browser_->evaluate("{ const box = element('method'); box.value = 1; box.dispatchEvent(new Event('change')); }");
  wait_for(std::string("page.frame.method === 1 && ") + is_ready);
  slide("elbow_flexion", 40);
  wait_for("page.frame.coordinates[1] === 40 / unitOf({}).factor");
  EXPECT_EQ(browser_->evaluate("element('x-axis').value"), "-1") << "somebody has chosen";
  EXPECT_LT(largest_difference(shapes_of_this_machine(scene, scene.method, 1, radians(40))), 1e-4);
  EXPECT_THAT(browser_->complaints, IsEmpty());
}

TEST_F(LivePage, says_that_its_program_does_not_start) {
  const TestFolder folder;
  std::string text = read_text(live_page());
  const std::string place = "id=\"program\">";
  const std::size_t begin = text.find(place) + place.size(), end = text.find("</script>", begin);
  folder.write("page.html", text.replace(begin, end - begin, "AAAA"));
  browser_->open(folder.path() / "page.html");
  wait_for("page.failures === 1");
  EXPECT_THAT(browser_->evaluate("element('status').textContent").get<std::string>(), StartsWith("stopped: "));
  EXPECT_EQ(browser_->evaluate("element('status').classList.contains('failed')"), true);
}

}  // namespace
