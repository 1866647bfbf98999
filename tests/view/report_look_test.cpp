#include <gracilis/view/pictures/evened_surface.hpp>
#include <gracilis/view/pictures/muscle_colors.hpp>
#include <gracilis/view/pictures/recorded_look.hpp>

#include "view/recorded_runs.hpp"
#include "view/report_in_browser.hpp"

#include <gtest/gtest.h>

namespace gracilis {

TEST_F(ReportInBrowser, fibers_have_their_muscles_colors_and_muscles_are_pale_where_fibers_carry_the_colors) {
  open({FlexingLeg(3).written(folder.path() / "run")});
  const auto expect_color = [&](const std::string& shape, const Color& color) {
    const auto seen = js("[..." + shape + ".geometry.attributes.color.array.slice(0, 3)]").get<std::vector<Real>>();
    EXPECT_LT((Vec3(seen.data()) - color).cwiseAbs().maxCoeff(), 0.005) << shape;
  };
  click("#fibers");
  expect_color("stage.shapes[0].fibers[0].lines", 0.7 * fiber_paint("gluteus_maximus_r"));
  js("chooseColor('muscle')");
  expect_color("stage.shapes[0].fibers[0].lines", 0.7 * muscle_color("gluteus_maximus_r"));
  expect_color("stage.shapes[0].fibers[1].lines", 0.7 * muscle_color("gluteus_medius_r"));
  js("chooseColor('strain')");
  expect_color("stage.shapes[0].surfaces.find(each => each.kind === 'muscle').mesh", flesh_color());
  expect_peace();
}

TEST_F(ReportInBrowser, muscles_look_like_muscle_at_first_and_have_their_own_colors_on_demand) {
  const RecordedRun run = FlexingLeg(2).written(folder.path() / "run");
  open({run});
  EXPECT_EQ(js("document.getElementById('color-by').value"), "natural");
  const Points painted = natural_colors(recorded_look(run, "gluteus_maximus_r"), "gluteus_maximus_r");
  const std::string mesh = "stage.shapes[0].surfaces.find(each => each.name === 'gluteus_maximus_r').mesh";
  const auto colors = js("[..." + mesh + ".geometry.attributes.color.array]").get<std::vector<Real>>();
  ASSERT_EQ(static_cast<Index>(colors.size()), painted.size());
  EXPECT_LT((Eigen::Map<const Points>(colors.data(), 3, painted.cols()) - painted).cwiseAbs().maxCoeff(), 0.003);
  EXPECT_EQ(js(mesh + ".material.map !== null"), true) << "stripes along the fibers";
  js("chooseColor('muscle')");
  EXPECT_EQ(js(mesh + ".material.map === null"), true);
  const auto own = js("[..." + mesh + ".geometry.attributes.color.array.slice(0, 3)]").get<std::vector<Real>>();
  EXPECT_LT((Vec3(own.data()) - muscle_color("gluteus_maximus_r")).cwiseAbs().maxCoeff(), 0.005);
  expect_peace();
}

TEST_F(ReportInBrowser, muscles_are_drawn_evened_where_colors_tell_no_values) {
  FlexingLeg leg(3);
  TriangleMesh& bumpy = leg.scene.muscles[0].surface;
  bumpy.vertices.col(9) += 0.004 * (bumpy.vertices.col(9) - Vec3(-0.1, -0.1, 0)).normalized();
  open({leg.written(folder.path() / "run")});
  js("page.goTo(2)");
  const auto drawn = [&]() -> Points {
    const auto found = js("[...stage.shapes[0].surfaces.find(each => each.name === 'gluteus_maximus_r').mesh.geometry"
                          ".attributes.position.array]")
                           .get<std::vector<Real>>();
    return Eigen::Map<const Points>(found.data(), 3, static_cast<Index>(found.size() / 3));
  };
  const Points recorded = leg.record(2).frame.muscles[0].points, evened = EvenedSurface(bumpy).of(recorded);
  ASSERT_GT((evened - recorded).cwiseAbs().maxCoeff(), 0.001);
  EXPECT_LT((drawn() - evened).cwiseAbs().maxCoeff(), 2e-5);
  js("chooseColor('muscle')");
  EXPECT_LT((drawn() - evened).cwiseAbs().maxCoeff(), 2e-5);
  js("chooseColor('shape')");
  EXPECT_LT((drawn() - recorded).cwiseAbs().maxCoeff(), 2e-5);
  expect_peace();
}

TEST_F(ReportInBrowser, a_scale_that_values_go_beyond_says_so) {
  open({FlexingLeg(21).written(folder.path() / "run")});
  const auto ticks = [&](const std::string& color) {
    js("chooseColor('" + color + "')");
    return js("[...document.querySelectorAll('#color-bar span span')].map(tick => tick.textContent).join()");
  };
  EXPECT_EQ(ticks("volume"), "−1,0,≥ +1");
  EXPECT_EQ(ticks("stretch"), "0.5,1,2");
  EXPECT_EQ(ticks("activation"), "0,0.5,1");
  expect_peace();
}

TEST_F(ReportInBrowser, the_slider_says_whose_opacity_it_is) {
  open({FlexingLeg(2).written(folder.path() / "run")});
  EXPECT_EQ(js("document.getElementById('opacity').labels[0].textContent.trim()"), "Opacity of muscles");
}

TEST_F(ReportInBrowser, gates_have_room_on_phones_and_tablets) {
  open({FlexingLeg(3).written(folder.path() / "run")});
  for (const int width : {390, 768, 1000}) {
    browser->set_size(width, 1000);
    EXPECT_EQ(js("new Promise(done => setTimeout(() => done(innerWidth), 300))"), width);
    EXPECT_EQ(js("[document.getElementById('gates'), ...document.querySelectorAll('#gates td')]"
                 ".filter(part => part.scrollWidth > part.clientWidth).length"),
              0)
        << width;
  }
  EXPECT_EQ(js("[...document.querySelectorAll('#gates td')].filter(part => !/ limit "
               "±?[0-9]/.test(part.dataset.gate)).length"),
            0)
      << "without columns' heads each gate tells its limit itself";
  browser->set_size(1400, 900);
}

TEST_F(ReportInBrowser, text_of_plots_is_as_large_on_a_phone_and_after_a_window_has_changed) {
  // Pixels on the screen for one of the text's.
  const std::string scales = "[...document.querySelectorAll('.plot svg')].map(plot => plot.getScreenCTM().a)";
  const auto expect_one = [&] {
    const auto found = js(scales).get<std::vector<Real>>();
    EXPECT_FALSE(found.empty());
    for (const Real scale : found) EXPECT_NEAR(scale, 1, 0.01);
  };
  browser->set_size(390, 844);
  open({FlexingLeg(3).written(folder.path() / "run")});
  expect_one();
  EXPECT_EQ(js("[...document.querySelectorAll('.plot text')].filter(text => { const {left, right} = "
               "text.getBoundingClientRect(); return left < 0 || right > 390; }).map(text => text.textContent).join()"),
            "");
  browser->set_size(1400, 900);
  EXPECT_EQ(js("new Promise(done => setTimeout(() => done(innerWidth), 300))"), 1400);
  expect_one();
  expect_peace();
}

}  // namespace gracilis
