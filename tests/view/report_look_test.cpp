#include <gracilis/view/pictures/muscle_colors.hpp>

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
  expect_color("stage.shapes[0].fibers[0].lines", 0.7 * muscle_color("gluteus_maximus_r"));
  expect_color("stage.shapes[0].fibers[1].lines", 0.7 * muscle_color("gluteus_medius_r"));
  js("chooseColor('strain')");
  expect_color("stage.shapes[0].surfaces.find(each => each.kind === 'muscle').mesh", flesh_color());
  expect_peace();
}

TEST_F(ReportInBrowser, the_slider_says_whose_opacity_it_is) {
  open({FlexingLeg(2).written(folder.path() / "run")});
  EXPECT_EQ(js("document.getElementById('opacity').labels[0].textContent.trim()"), "Opacity of muscles");
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
