#include <gracilis/core/errors.hpp>
#include <gracilis/view/pictures/picture.hpp>
#include <gracilis/view/pictures/picture_layout.hpp>
#include <gracilis/view/pictures/picture_renderer.hpp>

#include "io/test_files.hpp"

#include <gtest/gtest.h>

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

#include <filesystem>

using namespace gracilis;

namespace {

/// A cube with edges of length 1 around `center`.
TriangleMesh cube(const Vec3& center) {
  TriangleMesh mesh;
  mesh.vertices.resize(3, 8);
  for (int i = 0; i < 8; ++i)
    mesh.vertices.col(i) = center + Vec3(i & 1, (i >> 1) & 1, (i >> 2) & 1) - Vec3::Constant(0.5);
  mesh.faces.resize(3, 12);
  mesh.faces << 0, 0, 4, 4, 0, 0, 2, 2, 0, 0, 1, 1,  //
      2, 3, 5, 7, 1, 5, 6, 7, 4, 6, 3, 7,            //
      3, 1, 7, 6, 5, 4, 7, 3, 6, 2, 7, 5;
  return mesh;
}

Picture two_panels() {
  Picture picture;
  picture.panel_width = 200;
  picture.panel_height = 120;
  const PaintedSurface red{"a", cube(Vec3::Zero()), Color(0.8, 0.1, 0.1)};
  const PaintedSurface blue{"b", cube(Vec3::Zero()), Color(0.1, 0.1, 0.8)};
  picture.panels = {{"", {red}}, {"", {blue}}};
  return picture;
}

Picture two_panels_beside_scale_bar(const std::string& caption, int panel_width) {
  Picture picture = two_panels();
  for (Panel& panel : picture.panels) panel.caption = caption;
  picture.panel_width = panel_width;
  picture.scale_bar = true;
  return picture;
}

Vec3 pixel(vtkImageData& image, int x, int y) {
  return {image.GetScalarComponentAsDouble(x, y, 0, 0), image.GetScalarComponentAsDouble(x, y, 0, 1),
          image.GetScalarComponentAsDouble(x, y, 0, 2)};
}

}  // namespace

TEST(Picture, panels_stand_side_by_side_above_the_legend) {
  const PictureLayout layout = lay_out(two_panels());
  EXPECT_EQ(layout.width, 400);
  EXPECT_EQ(layout.height, 120 + layout.legend.height);
  EXPECT_EQ(layout.panels[0].x, 0);
  EXPECT_EQ(layout.panels[1].x, 200);
  ASSERT_EQ(layout.legend_entries.size(), 2u);
  EXPECT_EQ(layout.legend_entries[1].first, "b");
}

/// One panel with a surface per name, the last one's purple.
static Picture picture_of_names(int count) {
  Picture picture;
  picture.panel_width = 480;
  picture.panel_height = 800;
  picture.panels.resize(1);
  for (int i = 0; i < count; ++i)
    picture.panels[0].surfaces.push_back(
        {"semimembranosus right " + std::to_string(10 + i), cube(Vec3(2 * i, 0, 0)), Color(0.2, 0.6, 0.2)});
  picture.panels[0].surfaces.back().color = Color(0.8, 0, 0.8);
  return picture;
}

TEST(Picture, a_legend_of_many_names_has_rows_in_which_each_can_be_read) {
  const PictureLayout layout = lay_out(picture_of_names(26));
  ASSERT_EQ(layout.legend_entries.size(), 26u);
  const LegendGrid& grid = layout.legend_grid;
  EXPECT_EQ(grid.columns, 2);
  EXPECT_GE(grid.font, 11);
  EXPECT_GE(layout.legend.width / grid.columns, 40 + 24 * 0.6 * grid.font - 1) << "names do not overlap";
  EXPECT_GE(layout.legend.height, (26 + grid.columns - 1) / grid.columns * grid.row_height);
  EXPECT_EQ(layout.panels[0].y, layout.legend.height);
  const PictureLayout few = lay_out(two_panels());
  EXPECT_EQ(few.legend_grid.columns, 2);
  EXPECT_EQ(few.legend_grid.font, 20);
  EXPECT_LT(few.legend.height, layout.legend.height);
}

TEST(Picture, letters_of_a_wide_picture_are_large_enough_where_a_page_of_900_pixels_shows_it) {
  Picture picture = picture_of_names(3);
  picture.panels[0].caption = "pose";
  picture.panel_width = 1200;
  const PictureLayout narrow = lay_out(picture);
  picture.panel_width = 2400;
  const PictureLayout wide = lay_out(picture);
  EXPECT_EQ(narrow.text, 1);
  EXPECT_EQ(wide.text, 2);
  EXPECT_EQ(wide.legend_grid.font, 2 * narrow.legend_grid.font);
  EXPECT_EQ(wide.captions[0].height, 2 * narrow.captions[0].height);
  EXPECT_GE(text_pixels(wide, 15) * 900 / wide.width, 11) << "the smallest letters, of a color bar";
}

TEST(Picture, a_legend_never_takes_more_than_half_of_what_a_panel_does) {
  EXPECT_TRUE(lay_out(picture_of_names(92)).legend_entries.empty());
}

TEST(Picture, a_legend_stands_above_a_color_bar_that_leaves_it_no_room) {
  Picture picture = picture_of_names(3);
  picture.color_bar = ColorBar{"a", {Color::Zero(), Color::Ones()}, {"0", "1"}};
  const PictureLayout layout = lay_out(picture);
  EXPECT_EQ(layout.legend.y, layout.color_bar.height);
  EXPECT_EQ(layout.panels[0].y, layout.legend.y + layout.legend.height);
  picture.panel_width = 1800;
  EXPECT_EQ(lay_out(picture).legend.y, 0) << "beside it";
}

TEST(Picture, panels_that_look_the_same_way_share_one_camera_that_sees_everything) {
  Picture picture = two_panels();
  picture.panels[1].surfaces[0].mesh = cube(Vec3(4, 0, 0));
  const PictureLayout layout = lay_out(picture);
  EXPECT_TRUE(layout.cameras[0].center.isApprox(Vec3(2, 0, 0)));
  EXPECT_TRUE(layout.cameras[1].center.isApprox(Vec3(2, 0, 0)));
  EXPECT_GE(layout.half_height * 200 / 120, 2.5);
}

TEST(Picture, panels_with_cameras_of_their_own_look_at_what_they_show_at_the_same_scale) {
  Picture picture = two_panels();
  picture.panels[1].surfaces[0].mesh = cube(Vec3(4, 0, 0));
  const Real of_one = lay_out(two_panels()).half_height;
  for (Panel& panel : picture.panels) panel.has_own_camera = true;
  const PictureLayout layout = lay_out(picture);
  EXPECT_TRUE(layout.cameras[0].center.isApprox(Vec3::Zero()));
  EXPECT_TRUE(layout.cameras[1].center.isApprox(Vec3(4, 0, 0)));
  EXPECT_NEAR(layout.half_height, of_one, 1e-12);
}

/// Panels in two rows, of which the second is not full, with everything that stands around them.
static Picture panels_in_rows() {
  Picture picture = two_panels();
  picture.panels.push_back(picture.panels[0]);
  for (Panel& panel : picture.panels) panel.caption = "pose";
  picture.columns = 2;
  picture.title = "rows";
  picture.background = Color(0.2, 0.4, 0.6);
  picture.color_bar = ColorBar{"a", {Color::Zero(), Color::Ones()}, {"0", "1"}};
  return picture;
}

TEST(Picture, several_panels_are_drawn_one_at_a_time_and_every_part_once) {
  const PictureLayout layout = lay_out(panels_in_rows());
  std::vector<Rectangle> parts = {layout.title, layout.legend, layout.color_bar};
  for (const auto* list : {&layout.panels, &layout.captions}) parts.insert(parts.end(), list->begin(), list->end());
  std::vector<int> found(parts.size(), 0);
  for (const Rectangle& area : areas_to_draw(layout)) {
    int panels = 0;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const auto& [x, y, width, height] = parts[i];
      EXPECT_GT(height, 0) << i;
      if (x < area.x || y < area.y || x + width > area.x + area.width || y + height > area.y + area.height) continue;
      ++found[i];
      if (i >= 3 && i < 3 + layout.panels.size()) ++panels;
    }
    EXPECT_LE(panels, 1);
  }
  EXPECT_EQ(found, std::vector<int>(parts.size(), 1));
}

TEST(Picture, what_cannot_be_seen_is_a_configuration_error) {
  EXPECT_THROW(lay_out(Picture{}), ConfigurationError);
  Picture no_points = two_panels();
  for (Panel& panel : no_points.panels) panel.surfaces.clear();
  EXPECT_THROW(lay_out(no_points), ConfigurationError);
  Picture bad_camera = two_panels();
  bad_camera.panels[0].up = bad_camera.panels[0].looking;
  EXPECT_THROW(lay_out(bad_camera), ConfigurationError);
  Picture not_finite = two_panels();
  not_finite.panels[0].surfaces[0].mesh.vertices(0, 0) = std::numeric_limits<Real>::quiet_NaN();
  EXPECT_THROW(lay_out(not_finite), ConfigurationError);
}

/// The picture of two panels as it is written.
class DrawnPicture : public testing::Test {
 protected:
  void draw(const Picture& picture) {
    const std::filesystem::path path = folder_.path() / "picture.png";
    try {
      render_picture(picture, path);
    } catch (const Error& error) {
      ASSERT_EQ(error.code(), ExitCode::unsupported) << error.what();
      GTEST_SKIP() << error.what();
    }
    reader_->SetFileName(path.c_str());
    reader_->Update();
  }
  vtkImageData& image() { return *reader_->GetOutput(); }

 private:
  TestFolder folder_;
  vtkNew<vtkPNGReader> reader_;
};

TEST_F(DrawnPicture, surfaces_appear_in_their_colors_on_the_background) {
  draw(two_panels());
  if (IsSkipped()) return;
  const PictureLayout layout = lay_out(two_panels());
  ASSERT_EQ(image().GetDimensions()[0], layout.width);
  ASSERT_EQ(image().GetDimensions()[1], layout.height);
  const int middle = layout.panels[0].y + 60;
  EXPECT_GT(pixel(image(), 100, middle).x(), 2 * pixel(image(), 100, middle).z());
  EXPECT_GT(pixel(image(), 300, middle).z(), 2 * pixel(image(), 300, middle).x());
  EXPECT_EQ(pixel(image(), 5, layout.height - 5), Vec3(255, 255, 255));
}

TEST_F(DrawnPicture, panels_stand_in_rows_and_the_background_where_there_is_none) {
  const Picture picture = panels_in_rows();
  const PictureLayout layout = lay_out(picture);
  draw(picture);
  if (IsSkipped()) return;
  const auto middle_of = [&](const Rectangle& part) {
    return pixel(image(), part.x + part.width / 2, part.y + part.height / 2);
  };
  for (const std::size_t red : {0, 2}) EXPECT_GT(middle_of(layout.panels[red]).x(), 100) << red;
  EXPECT_GT(middle_of(layout.panels[1]).z(), 100);
  Rectangle empty = layout.panels[1];
  empty.y = layout.panels[2].y;
  EXPECT_EQ(middle_of(empty), Vec3(51, 102, 153));
  EXPECT_EQ(pixel(image(), layout.panels[2].x + 1, layout.panels[2].y + 1), Vec3(51, 102, 153));
}

TEST_F(DrawnPicture, the_last_of_many_names_stands_in_the_legend) {
  const Picture picture = picture_of_names(26);
  draw(picture);
  if (IsSkipped()) return;
  const Rectangle legend = lay_out(picture).legend;
  int purple = 0;
  for (int y = legend.y; y < legend.y + legend.height; ++y)
    for (int x = 0; x < legend.width; ++x) {
      const Vec3 seen = pixel(image(), x, y);
      purple += seen.x() > 180 && seen.y() < 60 && seen.z() > 180 ? 1 : 0;
    }
  EXPECT_GT(purple, 80);
}

/// How many pixels of a part, from the column `begin` on, have ink; and in how many rows there is any.
static std::pair<int, int> ink_in(const Rectangle& part, vtkImageData& image, int begin = 0) {
  int pixels = 0, rows = 0;
  for (int y = part.y; y < part.y + part.height; ++y) {
    const int before = pixels;
    for (int x = part.x + begin; x < part.x + part.width; ++x) pixels += pixel(image, x, y).x() < 150;
    rows += pixels > before;
  }
  return {pixels, rows};
}

TEST_F(DrawnPicture, a_long_caption_stands_in_lines_that_can_be_read_and_are_not_cut_off) {
  Picture picture = two_panels();
  picture.panels[1].caption = "hip_flexion_r -21°, hip_adduction_r 5°, hip_rotation_r -12°";
  draw(picture);
  if (IsSkipped()) return;
  const Rectangle strip = lay_out(picture).captions[1];
  for (int y = strip.y; y < strip.y + strip.height; ++y)
    for (const int x : {strip.x + 2, strip.x + strip.width - 3})
      EXPECT_EQ(pixel(image(), x, y), Vec3(255, 255, 255)) << x << " " << y;
  const auto [pixels, rows] = ink_in(strip, image());
  EXPECT_GT(pixels, 300);
  EXPECT_GT(rows, 3 * 8) << "three lines of letters that are 11 pixels high with what hangs below the line";
}

TEST_F(DrawnPicture, a_caption_in_lines_keeps_a_coordinate_and_its_value_together) {
  Picture picture = two_panels();
  picture.panels[1].caption = "a demo: hip flexion right 90°";
  draw(picture);
  if (IsSkipped()) return;
  Rectangle lower = lay_out(picture).captions[1];
  lower.height /= 2;
  const Rectangle upper{lower.x, lower.y + lower.height, lower.width, lower.height};
  const int ink_above = ink_in(upper, image()).first, ink_below = ink_in(lower, image()).first;
  EXPECT_GT(ink_above, 20);
  EXPECT_LT(ink_above, 0.5 * ink_below) << "more than the name of the run stands in the first line";
}

TEST_F(DrawnPicture, the_caption_beside_the_scale_bar_is_as_large_as_the_others) {
  const Picture picture = two_panels_beside_scale_bar("swing 12°, 3 mm", 280);
  draw(picture);
  if (IsSkipped()) return;
  const PictureLayout layout = lay_out(picture);
  EXPECT_EQ(layout.scale_bar.height, 0);
  constexpr int beside_bar = 85;  // pixels
  const int first = ink_in(layout.captions[0], image(), beside_bar).first;
  const int second = ink_in(layout.captions[1], image()).first;
  EXPECT_GT(second, 100);
  EXPECT_NEAR(first, second, 0.1 * second);
}

TEST_F(DrawnPicture, a_scale_bar_stands_by_itself_where_it_would_leave_a_caption_no_room) {
  const Picture picture = two_panels_beside_scale_bar("hip_flexion_r 12°", 120);
  draw(picture);
  if (IsSkipped()) return;
  const PictureLayout layout = lay_out(picture);
  EXPECT_EQ(layout.captions[0].y, layout.scale_bar.y + layout.scale_bar.height);
  EXPECT_GT(ink_in(layout.scale_bar, image()).first, 50);
  const int first = ink_in(layout.captions[0], image()).first, second = ink_in(layout.captions[1], image()).first;
  EXPECT_GT(second, 100);
  EXPECT_EQ(first, second);
  for (int y = layout.captions[0].y; y < layout.captions[0].y + layout.captions[0].height; ++y)
    for (const int x : {2, 117, 122, 237}) EXPECT_EQ(pixel(image(), x, y), Vec3(255, 255, 255)) << x << " " << y;
}

TEST(Picture, a_folder_that_cannot_be_written_is_named) {
  try {
    render_picture(two_panels(), "/proc/no_such_folder/picture.png");
    FAIL() << "no error";
  } catch (const Error& error) {
    if (error.code() == ExitCode::unsupported) GTEST_SKIP() << error.what();
    EXPECT_NE(std::string(error.what()).find("/proc/no_such_folder/picture.png"), std::string::npos) << error.what();
  }
}

TEST(Picture, makes_room_for_lines_and_grows_with_the_zoom) {
  Picture picture = two_panels();
  const Real before = lay_out(picture).half_height;
  picture.zoom = 2;
  EXPECT_NEAR(lay_out(picture).half_height, before / 2, 1e-12);
  picture.zoom = 1;
  Points line(3, 2);
  line << 0, 9, 0, 0, 0, 9;
  picture.panels[0].lines.push_back({join({line})});
  EXPECT_GT(lay_out(picture).half_height, before);
  picture.panels[0].lines[0].framed = false;
  EXPECT_NEAR(lay_out(picture).half_height, before, 1e-12);
}
