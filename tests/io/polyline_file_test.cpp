#include <gracilis/io/mesh/polyline_file.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <io/test_files.hpp>

namespace gracilis {

using testing::HasSubstr;

static Points line_of(const std::vector<Vec3>& points) {
  Points line(3, static_cast<Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) line.col(static_cast<Index>(i)) = points[i];
  return line;
}

static std::string vtk_lines(const std::string& lines) {
  return "# vtk DataFile Version 3.0\nlines\nASCII\nDATASET POLYDATA\nPOINTS 5 float\n0 0 0 1 0 0 2 0 0 0 1 0 0 2 0\n" +
         lines + "\n";
}

TEST(PolylineFile, what_is_written_reads_back_with_the_same_bits) {
  const TestFolder folder;
  const Polylines lines = join({line_of({{0, 0, 0.1}, {1.0 / 3, 0, 0}, {2, 0, 0}}), line_of({{5, 5, 5}, {6, 5, 5}})});
  write_polylines(folder.path() / "lines.vtp", lines, {{"length_m", polyline_lengths(lines)}});
  const Polylines read = read_polylines(folder.path() / "lines.vtp", 1);
  EXPECT_TRUE(read.points == lines.points);
  EXPECT_EQ(read.offsets, lines.offsets);
}

TEST(PolylineFile, a_full_disk_is_one_clear_error) {
  const TestFolder folder;
  const Polylines lines = join({Points::Random(3, 20000)});
  const std::string text = message_on_a_full_disk([&] { write_polylines(folder.path() / "a.vtp", lines); });
  EXPECT_THAT(text, HasSubstr("a.vtp: cannot be written: "));
  EXPECT_THAT(text, testing::Not(HasSubstr("vtkInformation")));
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(PolylineFile, segments_that_meet_end_to_end_are_one_line) {
  const TestFolder folder;
  const auto file = folder.write("a.vtk", vtk_lines("LINES 3 9\n2 1 2\n2 1 0\n2 3 4"));
  const Polylines read = read_polylines(file, 0.001);
  ASSERT_EQ(read.count(), 2);
  EXPECT_EQ(read.size(0), 3);
  EXPECT_NEAR(polyline_length(read.line(0)), 0.002, 1e-12);
  EXPECT_NEAR(polyline_length(read.line(1)), 0.001, 1e-12);
}

TEST(PolylineFile, lines_end_where_three_meet) {
  const TestFolder folder;
  const auto file = folder.write("a.vtk", vtk_lines("LINES 3 9\n2 1 0\n2 1 2\n2 1 3"));
  EXPECT_EQ(read_polylines(file, 1).count(), 3);
}

TEST(PolylineFile, a_file_without_lines_or_with_points_that_do_not_exist_is_refused) {
  const TestFolder folder;
  EXPECT_THAT(message_of_input_error([&] { read_polylines(folder.write("a.vtk", vtk_lines("")), 1); }),
              HasSubstr("holds no lines"));
  EXPECT_THAT(message_of_input_error([&] { read_polylines(folder.write("b.vtk", vtk_lines("LINES 1 3\n2 0 9")), 1); }),
              HasSubstr("names point 9"));
  EXPECT_THAT(message_of_input_error([&] { read_polylines(folder.write("c.obj", "v 0 0 0\n"), 1); }),
              HasSubstr("not a format that lines can be read from"));
}

TEST(PolylineFile, the_cadaver_s_superficial_fibers_are_five_lines_of_six_points) {
  const auto file = data_root() / "lhdl-hip/seed/fibres_gluteus_maximus_r.vtk";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "the data are not here";
  const Polylines lines = read_polylines(file, 0.001);
  ASSERT_EQ(lines.count(), 5);
  for (Index i = 0; i < 5; ++i) EXPECT_EQ(lines.size(i), 6);
}

}  // namespace gracilis
