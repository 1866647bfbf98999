#include <gracilis/core/errors.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/io/mesh/mesh_reader.hpp>
#include <gracilis/io/mesh/mesh_writer.hpp>
#include <gracilis/view/pictures/run_film.hpp>
#include <gracilis/view/pictures/run_picture.hpp>

#include "view/recorded_runs.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <io/test_files.hpp>

using namespace gracilis;

namespace {

/// Draws, or skips the test where there is no OpenGL.
#define DRAW_OR_SKIP(image, ...)                                    \
  try {                                                             \
    image = PictureDrawer().draw(__VA_ARGS__);                      \
  } catch (const Error& error) {                                    \
    ASSERT_EQ(error.code(), ExitCode::unsupported) << error.what(); \
    GTEST_SKIP() << error.what();                                   \
  }

/// How many pixels fulfill a condition on red, green, blue and opacity.
template <class Condition>
int count(const PixelImage& image, Condition condition) {
  int result = 0;
  for (std::size_t i = 0; i < image.rgba.size(); i += 4)
    if (condition(image.rgba[i], image.rgba[i + 1], image.rgba[i + 2], image.rgba[i + 3])) ++result;
  return result;
}

class RunPicture : public testing::Test {
 protected:
  Picture picture(const RunPictureOptions& options, const std::vector<int>& frames) {
    runs.assign(1, FlexingLeg(21).written(folder.path() / "run"));
    std::vector<RunPainter> painters;
    painters.emplace_back(runs[0], options);
    Picture result = run_picture(runs, painters, frames, options);
    result.panel_width = 240;
    return result;
  }

  TestFolder folder;
  std::vector<RecordedRun> runs;
};

TEST_F(RunPicture, views_look_from_where_their_names_say) {
  const RecordedRun run = FlexingLeg(2).written(folder.path());
  EXPECT_TRUE(view_direction(run, "anterior").isApprox(Vec3::UnitX()));
  EXPECT_TRUE(view_direction(run, "posterior").isApprox(-Vec3::UnitX()));
  EXPECT_TRUE(view_direction(run, "lateral").isApprox(Vec3::UnitZ()));  // of a right leg
  EXPECT_TRUE(view_direction(run, "medial").isApprox(-Vec3::UnitZ()));
  EXPECT_TRUE(view_direction(run, "anteromedial").isApprox(Vec3(1, 0, -1).normalized()));
  EXPECT_TRUE(view_direction(run, "posterolateral").isApprox(Vec3(-1, 0, 1).normalized()));
  EXPECT_GT(view_direction(run, "superior").y(), 0.99);
  for (const std::string& view : view_names()) EXPECT_NEAR(view_direction(run, view).norm(), 1, 1e-9) << view;
}

TEST_F(RunPicture, frames_stand_side_by_side_and_runs_below_each_other) {
  runs = {FlexingLeg(21).written(folder.path() / "a"), FlexingLeg(21).written(folder.path() / "b")};
  const RunPictureOptions options;
  std::vector<RunPainter> painters;
  for (const RecordedRun& run : runs) painters.emplace_back(run, options);
  const Picture many = run_picture(runs, painters, {0, 10, 20}, options);
  EXPECT_EQ(many.columns, 3);
  ASSERT_EQ(many.panels.size(), 6u);
  EXPECT_EQ(many.panels[5].caption, "b: hip flexion r 60°");
  EXPECT_EQ(run_picture(runs, painters, {0}, options).columns, 2);
}

TEST_F(RunPicture, stretch_is_seen_where_it_is) {
  RunPictureOptions options;
  options.color_by = ColorBy::edge_stretch;
  options.muscles = {"gluteus_maximus_r"};
  PixelImage rest, stretched;
  const auto reddish = [](int r, int, int b, int) { return r > b + 35; };
  DRAW_OR_SKIP(rest, picture(options, {0}));
  DRAW_OR_SKIP(stretched, picture(options, {20}));
  // The color bar has some red in both.
  EXPECT_GT(count(stretched, reddish), 3 * count(rest, reddish));
}

// The middle of their scale is gray.
TEST_F(RunPicture, fibers_colored_by_length_lie_on_bones_that_look_like_bone) {
  const RecordedRun run = FlexingLeg(6).written(folder.path() / "lengths");
  RunPictureOptions options;
  options.color_by = ColorBy::fiber_strain;
  EXPECT_EQ(RunPainter(run, options).panel(0).surfaces[0].color, bone_color());
  options.color_by = ColorBy::edge_stretch;
  EXPECT_NE(RunPainter(run, options).panel(0).surfaces[0].color, bone_color());
}

TEST_F(RunPicture, stress_and_tension_are_seen_where_a_method_knows_them) {
  FlexingLeg leg(6);
  RunPictureOptions options;
  options.color_by = ColorBy::stress;
  const RecordedRun without = leg.written(folder.path() / "without");
  EXPECT_THROW(RunPainter(without, options), ConfigurationError);
  leg.knows_forces = true;
  const RecordedRun run = leg.written(folder.path() / "with");
  const RunPainter by_stress(run, options);
  const auto expected = [](ColorBy by, Real value) { return color_at(color_scale(by), std::log10(value)); };
  // The bone comes first. The other muscle knows none and is gray.
  EXPECT_TRUE(by_stress.panel(0).surfaces[1].colors.col(7).isApprox(expected(ColorBy::stress, 1e4)));
  EXPECT_TRUE(by_stress.panel(5).surfaces[1].colors.col(7).isApprox(expected(ColorBy::stress, 3.2e5)));
  EXPECT_TRUE(by_stress.panel(5).surfaces[2].colors.col(7).isApprox(Color(Color::Constant(0.6))));
  options.color_by = ColorBy::tension;
  const RunPainter by_tension(run, options);
  EXPECT_TRUE(by_tension.panel(5).lines[0].colors.at(0).isApprox(expected(ColorBy::tension, 3.2)));
  EXPECT_FALSE(expected(ColorBy::tension, 3.2).isApprox(expected(ColorBy::tension, 0.1)));
}

TEST_F(RunPicture, an_end_of_a_muscle_fills_the_picture) {
  FlexingLeg leg(3);
  leg.scene.muscles[0].attachments = {{"o", AttachmentEnd::origin, 0, {0, 1, 2}}};
  const RecordedRun run = leg.written(folder.path() / "run");
  RunPictureOptions options;
  options.focus = "gluteus_maximus_r:origin";
  const RunPainter painter(run, options);
  const Panel panel = painter.panel(2);
  const Points expected = recorded_surface(run, "gluteus_maximus_r", 2).vertices.leftCols(3);
  EXPECT_EQ(panel.room, expected);
  for (const PaintedSurface& surface : panel.surfaces) EXPECT_FALSE(surface.framed);
  const Points at_rest = recorded_surface(run, "gluteus_maximus_r", 0).vertices.leftCols(3);
  EXPECT_NEAR(painter.extent(), (at_rest.rowwise().maxCoeff() - at_rest.rowwise().minCoeff()).norm(), 1e-12);
  EXPECT_EQ(panel.surfaces[1].opacity, 1) << "the muscle itself is not seen through";
  EXPECT_EQ(panel.surfaces[2].opacity, 0.25);
  options.focus = "gluteus_maximus_r:insertion";
  EXPECT_THROW(RunPainter(run, options), ConfigurationError);
}

TEST_F(RunPicture, a_transparent_background_is_transparent_and_shapes_are_not) {
  PixelImage image;
  DRAW_OR_SKIP(image, picture({}, {0}), true);
  const int all = image.width * image.height;
  EXPECT_EQ(image.rgba[3], 0);
  EXPECT_GT(count(image, [](int, int, int, int a) { return a == 0; }), all / 4);
  EXPECT_GT(count(image, [](int, int, int, int a) { return a == 255; }), all / 20);
}

TEST_F(RunPicture, muscles_can_be_chosen_by_name) {
  RunPictureOptions options;
  options.muscles = {"gluteus_medius_r"};
  EXPECT_EQ(picture(options, {0}).panels[0].surfaces.size(), 2u);  // with the bone
  options.muscles = {"gluteus_medus_r"};
  try {
    picture(options, {0});
    FAIL() << "no error";
  } catch (const ConfigurationError& error) {
    EXPECT_NE(std::string(error.what()).find("gluteus_medius_r"), std::string::npos) << error.what();
  }
}

TEST_F(RunPicture, from_medial_the_other_side_is_left_out) {
  FlexingLeg(21).written(folder.path() / "run");
  for (int frame = 0; frame < 21; ++frame)
    std::filesystem::copy_file(frame_file(folder.path() / "run", "femur_r", frame),
                               frame_file(folder.path() / "run", "femur_l", frame));
  const RecordedRun run = open_recorded_run(folder.path() / "run");
  ASSERT_EQ(run.bones.size(), 2u);
  const auto surfaces = [&](const std::string& view, const std::vector<std::string>& bones = {}) {
    RunPictureOptions options;
    options.view = view;
    options.bones = bones;
    return RunPainter(run, options).panel(0).surfaces.size();
  };
  EXPECT_EQ(surfaces("lateral"), 4u);
  EXPECT_EQ(surfaces("medial"), 3u);
  EXPECT_EQ(surfaces("posteromedial"), 3u);
  EXPECT_EQ(surfaces("medial", {"femur_l"}), 3u) << "what is asked for is shown";
}

TEST_F(RunPicture, muscles_and_bones_can_be_hidden_and_one_can_fill_the_picture) {
  RunPictureOptions options;
  options.hidden = {"gluteus_medius_r"};
  options.without_bones = true;
  EXPECT_EQ(picture(options, {0}).panels[0].surfaces.size(), 1u);
  options = {};
  options.color_by = ColorBy::muscle;  // names stand in legends of these only
  options.focus = "gluteus_medius_r";
  const Picture focused = picture(options, {0});
  for (const PaintedSurface& surface : focused.panels[0].surfaces)
    EXPECT_EQ(surface.framed, surface.name == "gluteus medius r") << surface.name;
  options.focus = "gluteus_medus_r";
  EXPECT_THROW(picture(options, {0}), ConfigurationError);
}

TEST_F(RunPicture, a_scale_that_values_go_beyond_says_so) {
  RunPictureOptions options;
  options.color_by = ColorBy::bone_gap;  // everything farther than the scale has its last color
  EXPECT_EQ(picture(options, {0}).color_bar->ticks.back(), "≥ 10");
  options.color_by = ColorBy::volume;
  EXPECT_EQ(picture(options, {0}).color_bar->ticks.back(), "+1");
  const ColorBar swollen = *picture(options, {20}).color_bar;
  EXPECT_EQ(swollen.ticks.back(), "≥ +1");
  EXPECT_EQ(swollen.ticks.front(), "-1");
}

TEST_F(RunPicture, scales_of_stress_and_tension_say_so_too) {
  FlexingLeg leg(8);  // 10 to 1280 kPa, 0.1 to 12.8 N
  leg.knows_forces = true;
  runs = {leg.written(folder.path() / "run")};
  const auto bar = [&](ColorBy by, int frame) {
    RunPictureOptions options;
    options.color_by = by;
    std::vector<RunPainter> painters;
    painters.emplace_back(runs[0], options);
    return *run_picture(runs, painters, {frame}, options).color_bar;
  };
  EXPECT_EQ(bar(ColorBy::stress, 5).ticks.back(), "1000");
  EXPECT_EQ(bar(ColorBy::stress, 7).ticks.back(), "≥ 1000");
  EXPECT_EQ(bar(ColorBy::tension, 5).ticks.back(), "10");
  EXPECT_EQ(bar(ColorBy::tension, 7).ticks.back(), "≥ 10");
}

TEST_F(RunPicture, looks_as_the_preview_does_unless_it_is_told_otherwise) {
  RecordedRun run = FlexingLeg(2).written(folder.path());
  run.preview_looking = Vec3(0, 0, 2);
  run.preview_up = Vec3::UnitX();
  EXPECT_EQ(RunPainter(run, {}).panel(0).looking, Vec3::UnitZ());
  EXPECT_EQ(RunPainter(run, {}).panel(0).up, Vec3::UnitX());
  RunPictureOptions options;
  options.view = "anterior";
  EXPECT_TRUE(RunPainter(run, options).panel(0).looking.isApprox(-Vec3::UnitX()));
}

TEST_F(RunPicture, the_camera_goes_around_the_subject_and_rises_by_angles) {
  const RecordedRun run = FlexingLeg(2).written(folder.path());  // x anterior, y superior, z to the right
  const auto camera = [&](Real turn, Real tilt) {
    RunPictureOptions options;
    options.view = "anterior";
    options.turn = radians(turn), options.tilt = radians(tilt);
    const Panel panel = RunPainter(run, options).panel(0);
    EXPECT_NEAR(panel.looking.dot(panel.up), 0, 1e-12);
    return std::pair(panel.looking, panel.up);
  };
  EXPECT_TRUE(camera(0, 0).first.isApprox(-Vec3::UnitX()));
  EXPECT_TRUE(camera(90, 0).first.isApprox(Vec3::UnitZ())) << "from the subject's left";
  EXPECT_TRUE(camera(-90, 0).first.isApprox(-Vec3::UnitZ())) << "from the right";
  EXPECT_TRUE(camera(0, 30).first.isApprox(Vec3(-std::cos(radians(30)), -0.5, 0))) << "from above";
  EXPECT_TRUE(camera(0, 90).second.isApprox(-Vec3::UnitX())) << "up is away from the subject's front";
}

TEST_F(RunPicture, images_of_a_film_have_one_size_whatever_single_frames_need) {
  FlexingLeg(60).written(folder.path() / "run");
  // A frame in which the bone swings far out, which is none of those that are asked how much room they take.
  const std::vector<int> asked = spread_frames(60, 36);
  int far = 1;
  while (std::find(asked.begin(), asked.end(), far) != asked.end()) ++far;
  const std::filesystem::path file = frame_file(folder.path() / "run", "femur_r", far);
  const TriangleMesh bone = read_mesh(file, 1);
  write_surface(file, 2 * bone.vertices, bone.faces);
  const std::vector<RecordedRun> runs = {open_recorded_run(folder.path() / "run")};
  const RunPictureOptions options;
  std::vector<RunPainter> painters;
  painters.emplace_back(runs[0], options);
  RunFilm film(runs, painters, options, 0, 1, [](Picture& picture) { picture.panel_width = 120; });
  ASSERT_EQ(film.count(), 60);
  const PixelImage first = film.image(0);
  for (const int i : {far, far + 1, 59, 1}) {
    const PixelImage image = film.image(i);
    EXPECT_EQ(image.width, first.width) << i;
    EXPECT_EQ(image.height, first.height) << i;
    EXPECT_NE(image.rgba, first.rgba) << i;
  }
}

TEST_F(RunPicture, what_is_not_closed_shows_its_inside) {
  FlexingLeg(2).written(folder.path() / "run");
  const std::filesystem::path file = frame_file(folder.path() / "run", "femur_r", 0);
  const TriangleMesh bone = read_mesh(file, 1);
  write_surface(file, bone.vertices, bone.faces.leftCols(bone.face_count() - 1));
  const RecordedRun run = open_recorded_run(folder.path() / "run");
  for (const PaintedSurface& surface : RunPainter(run, {}).panel(0).surfaces)
    EXPECT_EQ(surface.solid, surface.mesh.face_count() != bone.face_count() - 1);
}

TEST(ColorScale, goes_from_its_first_color_to_its_last_and_no_further) {
  const ColorScale& scale = color_scale(ColorBy::edge_stretch);
  EXPECT_EQ(color_at(scale, -7), scale.colors.front());
  EXPECT_EQ(color_at(scale, 0), scale.colors[2]);
  EXPECT_EQ(color_at(scale, 1), scale.colors.back());
  EXPECT_EQ(color_at(scale, 99), scale.colors.back());
  EXPECT_TRUE(color_at(scale, 0.25).isApprox((scale.colors[2] + scale.colors[3]) / 2));
}

}  // namespace
