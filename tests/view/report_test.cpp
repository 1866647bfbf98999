#include <gracilis/view/pictures/recorded_look.hpp>
#include <gracilis/view/report/report.hpp>
#include <gracilis/view/report/report_data.hpp>
#include <gracilis/view/report/report_shapes.hpp>

#include "view/recorded_runs.hpp"
#include "view/report_in_browser.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <io/test_files.hpp>

#include <cstring>
#include <set>
#include <thread>

using namespace gracilis;
using testing::ElementsAre;
using testing::HasSubstr;
using Json = nlohmann::ordered_json;

namespace {

const Json& named(const Json& list, const std::string& key, const std::string& value) {
  for (const Json& each : list)
    if (each[key] == value) return each;
  throw std::runtime_error("no " + value);
}

/// A recorded point as the report holds it.
Vec3 stored_point(const ReportShapes& shapes, const Json& surface, std::size_t number) {
  Vec3 point;
  for (std::size_t k = 0; k < 3; ++k) {
    std::uint16_t stored = 0;
    std::memcpy(&stored, shapes.bytes.data() + surface["points_at"].get<std::size_t>() + 2 * (3 * number + k), 2);
    point[static_cast<Index>(k)] = surface["low"][k].get<Real>() + surface["size"][k].get<Real>() * stored / 65535;
  }
  return point;
}

}  // namespace

TEST(RecordedRun, is_read_back_as_written) {
  const TestFolder folder;
  const FlexingLeg leg(5);
  const RecordedRun run = leg.written(folder.path());
  EXPECT_THAT(run.muscles, ElementsAre("gluteus_maximus_r", "gluteus_medius_r"));
  EXPECT_THAT(run.bones, ElementsAre("femur_r"));
  EXPECT_EQ(run.frame_count, 5);
  EXPECT_THAT(run.coordinates, ElementsAre("hip_flexion_r_deg"));
  EXPECT_NEAR(run.coordinate_values(4, 0), 12, 1e-3);
  EXPECT_NEAR(measure_of(run, "volume_ratio")(3, 0), std::pow(1.03, 3), 1e-6);
  EXPECT_EQ(measure_of(run, "volume_ratio")(3, 1), 1);
  EXPECT_EQ(measure_of(run, "no_such_measure").size(), 0);
  EXPECT_EQ(recorded_surface(run, "gluteus_maximus_r", 2).vertices, leg.record(2).frame.muscles[0].points);
  EXPECT_EQ(recorded_fibers(run, "gluteus_maximus_r", 2).count(), 1);
  EXPECT_EQ(recorded_fibers(run, "femur_r", 2).count(), 0);
  EXPECT_THROW(open_recorded_run(folder.path() / "frames"), InputError);
}

TEST(RecordedRun, a_frame_that_is_missing_ends_it) {
  const TestFolder folder;
  FlexingLeg(5).written(folder.path());
  std::filesystem::remove(frame_file(folder.path(), "femur_r", 3));
  EXPECT_EQ(open_recorded_run(folder.path()).frame_count, 3);
}

TEST(ReportData, gates_name_the_worst_frame_and_charts_show_every_value) {
  const TestFolder folder;
  const Json data = report_data(FlexingLeg(21).written(folder.path()));
  const Json& gate = data["gates"][0];
  EXPECT_EQ(gate["measure"], "volume_ratio");
  EXPECT_EQ(gate["met"], false);
  EXPECT_EQ(gate["frame"], 20);
  EXPECT_EQ(gate["missed"], 20);
  EXPECT_NEAR(gate["worst"].get<Real>(), 100 * (std::pow(1.2, 3) - 1), 1e-2);
  for (const Json& each : data["gates"]) EXPECT_EQ(each["met"], each != gate) << each;
  const Json& volume = named(data["charts"], "id", "volume_ratio");
  EXPECT_EQ(volume["series"][0]["values"].size(), 21u);
  EXPECT_NEAR(volume["series"][0]["values"][10].get<Real>(), 100 * (std::pow(1.1, 3) - 1), 1e-2);
  const Json& lengths = named(data["charts"], "id", "fiber_lengths");
  EXPECT_NEAR(lengths["series"][1]["values"][20].get<Real>(), lengths["series"][1]["values"][0].get<Real>(), 1e-6);
  EXPECT_GT(lengths["series"][0]["values"][20].get<Real>(), lengths["series"][0]["values"][0].get<Real>());
}

TEST(ReportData, shows_tensions_and_moments_where_the_run_knows_them) {
  const TestFolder folder;
  FlexingLeg leg(6);
  leg.knows_forces = true;
  const Json data = report_data(leg.written(folder.path()));
  const Json& tension = named(data["charts"], "id", "tension");
  ASSERT_EQ(tension["series"].size(), 1u) << "the other muscle knows none";
  EXPECT_NEAR(tension["series"][0]["values"][5].get<Real>(), 3.2, 1e-6);
  const Json& moment = named(data["charts"], "id", "moment_hip_flexion_r");
  EXPECT_EQ(moment["unit"], "N·m");
  EXPECT_NEAR(moment["series"][0]["values"][5].get<Real>(), -0.32, 1e-6);
  for (const Json& chart : report_data(FlexingLeg(2).written(folder.path() / "without"))["charts"])
    EXPECT_NE(chart["id"], "tension");
}

TEST(ReportShapes, hold_recorded_points_to_a_hundredth_of_a_millimetre_and_the_stretch_of_edges) {
  const TestFolder folder;
  const FlexingLeg leg(21);
  const ReportShapes shapes = report_shapes(leg.written(folder.path()), 8'000'000);
  const Json& muscle = named(shapes.description["surfaces"], "name", "gluteus_maximus_r");
  const auto vertices = muscle["vertices"].get<std::size_t>();
  const Points truth = leg.record(20).frame.muscles[0].points;
  ASSERT_EQ(vertices, static_cast<std::size_t>(truth.cols()));
  for (std::size_t v = 0; v < vertices; ++v)
    ASSERT_LT((stored_point(shapes, muscle, 20 * vertices + v) - truth.col(static_cast<Index>(v))).norm(), 1e-5);
  const auto byte = static_cast<unsigned char>(shapes.bytes[muscle["stretch_at"].get<std::size_t>() + 20 * vertices]);
  EXPECT_NEAR(std::exp2((byte - 128) / 126.0), 1.2, 0.005);
}

TEST(ReportShapes, hold_what_a_muscle_looks_like) {
  const TestFolder folder;
  const RecordedRun run = FlexingLeg(2).written(folder.path());
  const ReportShapes shapes = report_shapes(run, 8'000'000);
  const Json& muscle = named(shapes.description["surfaces"], "name", "gluteus_maximus_r");
  const MuscleLook look = recorded_look(run, "gluteus_maximus_r");
  const Real low = muscle["stripes"][0], range = muscle["stripes"][1];
  for (std::size_t v = 0; v < look.tendon.size(); ++v) {
    const auto tendon = static_cast<unsigned char>(shapes.bytes[muscle["tendon_at"].get<std::size_t>() + v]);
    std::uint16_t stripe = 0;
    std::memcpy(&stripe, shapes.bytes.data() + muscle["stripes_at"].get<std::size_t>() + 2 * v, 2);
    ASSERT_NEAR(tendon / 255.0, look.tendon[v], 0.5 / 255 + 1e-9);
    ASSERT_NEAR(stripe_width * (low + range * stripe / 65535), look.stripes[v], 1e-5);
  }
  const auto brightest =
      static_cast<unsigned char>(shapes.bytes[shapes.description["brightness_at"].get<std::size_t>()]);
  EXPECT_NEAR(brightest / 255.0, stripe_brightness(512).front(), 0.5 / 255 + 1e-9);
}

TEST(ReportShapes, keep_to_their_budget_by_thinning_and_leaving_frames_out) {
  const TestFolder folder;
  const RecordedRun run = FlexingLeg(130).written(folder.path());
  const ReportShapes shapes = report_shapes(run, 500'000);
  EXPECT_LT(shapes.bytes.size(), 500'000u);
  const Json& frames = shapes.description["frames"];
  EXPECT_LE(frames.size(), 120u);
  EXPECT_EQ(frames.front(), 0);
  EXPECT_EQ(frames.back(), 129);
}

TEST(ReportShapes, keep_to_their_budget_where_the_fewest_vertices_and_many_fibers_of_all_frames_do_not_fit) {
  const TestFolder folder;
  FlexingLeg leg(130);
  leg.fibers = 400;
  const ReportShapes shapes = report_shapes(leg.written(folder.path()), 150'000);
  EXPECT_LT(shapes.bytes.size(), 150'000u);
  EXPECT_GT(shapes.bytes.size(), 75'000u);
  EXPECT_EQ(shapes.description["frames"].front(), 0);
  EXPECT_EQ(shapes.description["frames"].back(), 129);
  EXPECT_GE(shapes.description["fibers"][0]["sizes"].size(), 4u);
}

TEST(Report, what_runs_say_cannot_break_the_page) {
  const TestFolder folder;
  write_report(folder.path() / "report.html", {FlexingLeg(3).written(folder.path() / "run")});
  std::stringstream page;
  page << std::ifstream(folder.path() / "report.html").rdbuf();
  EXPECT_THAT(page.str(), HasSubstr("\\u003c/script> & \\u003cb>"));
  EXPECT_THAT(page.str(), testing::Not(HasSubstr("<b>suspicious")));
  EXPECT_EQ(page.str().find("{{"), std::string::npos);
}

/// One after the first, when it is shown, however long a busy machine draws; 0 after 20 s.
static constexpr const char* later_frame =
    "new Promise(done => { let looks = 0; const look = () => { const frame = page.state.frame; "
    "frame > 0 || ++looks > 1000 ? done(frame) : setTimeout(look, 20); }; look(); })";

TEST_F(ReportInBrowser, plays_pauses_and_scrubs_view_and_plots_together) {
  open({FlexingLeg(21).written(folder.path() / "run")});
  EXPECT_EQ(js("document.getElementById('title').textContent"), "flexing leg");
  const std::string first = picture();
  const auto cursor = "document.querySelector('.plot svg > g:last-child line').getAttribute('x1')";
  const nlohmann::json cursor_before = js(cursor);
  click("#play");
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  EXPECT_EQ(js("page.state.playing"), true);
  EXPECT_GT(js(later_frame).get<int>(), 0);
  click("#play");
  EXPECT_EQ(js("page.state.playing"), false);
  js("document.getElementById('slider').focus()");
  browser->press("End");
  EXPECT_EQ(js("page.state.frame"), 20);
  EXPECT_THAT(js("document.getElementById('pose').textContent").get<std::string>(), HasSubstr("hip flexion r 60°"));
  EXPECT_NE(picture(), first);
  EXPECT_NE(js(cursor), cursor_before);
  expect_peace();
}

TEST_F(ReportInBrowser, plays_on_from_an_image_that_was_begun_before_the_click) {
  open({FlexingLeg(21).written(folder.path() / "run")});
  js("(request => { window.requestAnimationFrame = act => request(now => act(now - 1000)); })"
     "(window.requestAnimationFrame.bind(window))");
  picture();
  click("#play");
  EXPECT_EQ(js("page.state.playing"), true);
  EXPECT_GT(js(later_frame).get<int>(), 0);
  expect_peace();
}

TEST_F(ReportInBrowser, toggles_muscles_colors_and_fibers) {
  open({FlexingLeg(21).written(folder.path() / "run")});
  const std::string all = picture();
  const int lines = js("document.querySelectorAll('.plot path').length");
  click("#muscles input[data-muscle=gluteus_maximus_r]");
  EXPECT_NE(picture(), all);
  EXPECT_LT(js("document.querySelectorAll('.plot path').length").get<int>(), lines);
  click("#all");
  EXPECT_EQ(picture(), all);
  js("page.goTo(20)");
  std::set<std::string> pictures;
  for (const std::string key : {"natural", "muscle", "stretch", "activation", "strain", "volume"}) {
    js("(s => { s.value = '" + key +
       "'; s.dispatchEvent(new Event('change')); })(document.getElementById('color-by'))");
    EXPECT_EQ(js("document.getElementById('color-by').value"), key);
    pictures.insert(picture());
  }
  EXPECT_EQ(pictures.size(), 6u);
  expect_peace();
}

TEST_F(ReportInBrowser, turns_zooms_and_has_standard_views_by_mouse_and_by_keys) {
  open({FlexingLeg(3).written(folder.path() / "run")});
  const Eigen::Vector2d at = middle("#canvas");
  const std::string before = picture();
  browser->drag(at.x(), at.y(), at.x() + 80, at.y() + 30);
  const std::string turned = picture();
  EXPECT_NE(turned, before);
  const double half_height = js("stage.orbit.halfHeight");
  browser->wheel(at.x(), at.y(), -200);
  EXPECT_LT(js("stage.orbit.halfHeight").get<double>(), half_height);
  EXPECT_NE(js("new Promise(done => setTimeout(() => done(document.getElementById('canvas').toDataURL()), 100))"),
            turned);
  browser->press("1");
  EXPECT_NEAR(js("stage.orbit.direction().x").get<double>(), 1, 1e-3);  // from the front
  js("document.getElementById('canvas').focus()");
  browser->press("ArrowLeft");
  EXPECT_LT(js("stage.orbit.direction().x").get<double>(), 0.999);
  expect_peace();
}

TEST_F(ReportInBrowser, plots_tell_values_under_the_pointer_and_go_where_one_clicks) {
  open({FlexingLeg(21).written(folder.path() / "run")});
  const Eigen::Vector2d at = middle(".plot svg");
  browser->click(at.x(), at.y());
  const int frame = js("page.state.frame");
  EXPECT_GT(frame, 5);
  EXPECT_LT(frame, 15);
  EXPECT_EQ(js("document.querySelector('.plot .tooltip').hidden"), false);
  EXPECT_THAT(js("document.querySelector('.plot .tooltip').textContent").get<std::string>(),
              HasSubstr("gluteus maximus r"));
  expect_peace();
}

TEST_F(ReportInBrowser, gates_link_to_their_worst_frame_and_warnings_stand_there_in_words) {
  open({FlexingLeg(21).written(folder.path() / "run")});
  EXPECT_THAT(js("document.getElementById('verdict').textContent").get<std::string>(), HasSubstr("1 of 24"));
  EXPECT_THAT(js("document.querySelector('#gates tbody tr').textContent").get<std::string>(), HasSubstr("and 19 more"));
  click("#gates tbody tr button");
  EXPECT_EQ(js("page.state.frame"), 20);
  EXPECT_EQ(js("document.getElementById('color-by').value"), "volume");
  click("#gates tbody tr td:nth-child(5) button");  // behind the name: volume, edges away from and at attachments
  EXPECT_EQ(js("document.getElementById('color-by').value"), "shape") << "of spikes, where they are";
  EXPECT_EQ(js("document.querySelector('.warning').textContent"), "gluteus_medius_r looks <b>suspicious</b>");
  expect_peace();
}

TEST_F(ReportInBrowser, several_runs_share_plots_and_meet_in_the_same_pose) {
  FlexingLeg slow(21), fast(11);
  for (int i = 0; i < 11; ++i) fast.poses[static_cast<std::size_t>(i)] = slow.poses[static_cast<std::size_t>(2 * i)];
  open({slow.written(folder.path() / "slow"), fast.written(folder.path() / "fast")});
  EXPECT_EQ(js("charts.find(each => each.chart.id === 'volume_ratio').lines.length"), 4);
  EXPECT_EQ(js("page.frameOf(1, 20)"), 10);
  EXPECT_EQ(js("page.frameOf(1, 10)"), 5);
  EXPECT_THAT(js("document.getElementById('title').textContent").get<std::string>(),
              HasSubstr("flexing leg: slow · fast"));
  EXPECT_EQ(js("new Set([...document.querySelectorAll('.plot path')].map(p => p.getAttribute('stroke-dasharray'))"
               ".filter(d => d !== null)).size"),
            2);
  expect_peace();
}

TEST_F(ReportInBrowser, on_a_phone_nothing_is_wider_than_the_page_and_no_word_is_broken) {
  browser->set_size(390, 844);
  open({FlexingLeg().written(folder.path() / "run")});
  ASSERT_EQ(js("innerWidth"), 390);
  EXPECT_EQ(js("document.documentElement.scrollWidth"), 390);
  EXPECT_EQ(js("[...document.querySelectorAll('main *')].filter(e => e.getClientRects().length && !e.closest('svg') && "
               "e.getBoundingClientRect().right > 390).map(e => e.tagName + ' ' + e.className + ' ' + e.id).join()"),
            "");
  // A word is broken where its letters lie on more than one line.
  EXPECT_EQ(
      js("(() => { const broken = []; const range = document.createRange(); "
         "const walk = document.createTreeWalker(document.querySelector('#gates'), NodeFilter.SHOW_TEXT); "
         "while (walk.nextNode()) for (const word of walk.currentNode.data.matchAll(/\\p{L}+/gu)) { "
         "range.setStart(walk.currentNode, word.index); range.setEnd(walk.currentNode, word.index + word[0].length); "
         "if (new Set([...range.getClientRects()].map(r => r.top)).size > 1) broken.push(word[0]); } "
         "return broken.join(); })()"),
      "");
}

TEST_F(ReportInBrowser, a_view_fits_a_window_that_becomes_narrower_until_somebody_turns_it) {
  open({FlexingLeg().written(folder.path() / "run")});
  const std::string farthest =
      "Math.max(...stage.shapes[0].corners().map(c => Math.abs(c.clone().project(stage.shapes[0].camera).x)))";
  EXPECT_LE(js(farthest).get<Real>(), 1);
  browser->set_size(390, 844);
  EXPECT_EQ(js("new Promise(done => setTimeout(() => done(innerWidth), 300))"), 390);
  EXPECT_LE(js(farthest).get<Real>(), 1);
  js("stage.orbit.halfHeight /= 4; stage.orbit.changed()");
  browser->set_size(420, 844);
  EXPECT_EQ(js("new Promise(done => setTimeout(() => done(innerWidth), 300))"), 420);
  EXPECT_GT(js(farthest).get<Real>(), 1) << "a view that somebody chose stays";
}

TEST_F(ReportInBrowser, can_be_read_aloud_and_on_paper) {
  open({FlexingLeg(3).written(folder.path() / "run")});
  EXPECT_EQ(js("[...document.querySelectorAll('button, input, select, [role=img]')].filter(e => !(e.ariaLabel || "
               "e.textContent.trim() || e.closest('label') || e.labels?.length)).map(e => e.outerHTML)"),
            nlohmann::json::array());
  EXPECT_THAT(js("document.querySelector('.plot svg').ariaLabel").get<std::string>(), HasSubstr("gluteus maximus r: "));
  EXPECT_TRUE(browser->print().starts_with("%PDF"));
  EXPECT_EQ(js("document.querySelector('#settings details').open"), true);
  expect_peace();
}
