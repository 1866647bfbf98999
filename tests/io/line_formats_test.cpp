#include <gracilis/io/mesh/polyline_file.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <io/test_files.hpp>

#include <cstring>
#include <limits>

namespace gracilis {
namespace {

using testing::HasSubstr;

constexpr float nan = std::numeric_limits<float>::quiet_NaN(), infinite = std::numeric_limits<float>::infinity();

template <class Number>
std::string bytes_of_one(Number number, bool swapped = false) {
  std::string bytes(sizeof(Number), '\0');
  std::memcpy(bytes.data(), &number, sizeof(Number));
  return swapped ? std::string(bytes.rbegin(), bytes.rend()) : bytes;
}

std::string floats(const std::vector<float>& numbers, bool swapped = false) {
  std::string bytes;
  for (const float number : numbers) bytes += bytes_of_one(number, swapped);
  return bytes;
}

/// A .tck whose tracks begin at byte 100.
std::string tck(const std::string& tracks, const std::string& type = "Float32LE", const std::string& file = ". 100") {
  std::string head = "mrtrix tracks\ncount: 2\ndatatype: " + type + "\nfile: " + file + "\nEND\n";
  head.resize(100, '\0');
  return head + tracks;
}

const std::vector<float> two_tracks = {1, 2, 3, 1, 2, 5, nan, nan, nan, 0,        0,        0,
                                       0, 1, 0, 0, 2, 0, nan, nan, nan, infinite, infinite, infinite};

/// A .trk of voxels of 1 x 1 x 2 mm.
struct Trk {
  std::string head = std::string(1000, '\0');
  std::string tracks;

  template <class Number>
  void put(std::size_t at, Number number) {
    head.replace(at, sizeof(Number), bytes_of_one(number));
  }
  Trk() {
    head.replace(0, 5, "TRACK");
    for (const std::size_t k : {0, 1, 2})
      put(6 + 2 * k, static_cast<std::int16_t>(10)), put(12 + 4 * k, k == 2 ? 2.f : 1.f);
    put(988, std::int32_t{1}), put(992, std::int32_t{2}), put(996, std::int32_t{1000});
  }
  void add(const std::vector<float>& numbers, std::int32_t points) { tracks += bytes_of_one(points) + floats(numbers); }
  /// From voxels to the scanner's frame, row by row.
  void place(const std::vector<float>& matrix, const std::string& order) {
    for (std::size_t i = 0; i < 16; ++i) put(440 + 4 * i, matrix[i]);
    head.replace(948, order.size(), order);
  }
  std::string bytes() const { return head + tracks; }
};

}  // namespace

TEST(LineFormats, tracks_of_mrtrix_are_read_in_either_byte_order_and_precision) {
  const TestFolder folder;
  for (const bool swapped : {false, true}) {
    const auto file = folder.write("a.tck", tck(floats(two_tracks, swapped), swapped ? "Float32BE" : "Float32LE"));
    const Polylines lines = read_polylines(file, 0.001);
    ASSERT_EQ(lines.count(), 2);
    EXPECT_EQ(lines.size(0), 2);
    EXPECT_EQ(lines.size(1), 3);
    EXPECT_NEAR((lines.line(0).col(1) - Vec3(0.001, 0.002, 0.005)).norm(), 0, 1e-12);
  }
  std::string doubles;
  for (const float number : two_tracks) doubles += bytes_of_one(static_cast<double>(number));
  EXPECT_EQ(read_polylines(folder.write("b.tck", tck(doubles, "Float64LE")), 0.001).count(), 2);
}

TEST(LineFormats, a_broken_file_of_mrtrix_is_one_message_with_its_name) {
  const TestFolder folder;
  const auto message = [&](const std::string& bytes) {
    return message_of_input_error([&] { read_polylines(folder.write("a.tck", bytes), 0.001); });
  };
  EXPECT_THAT(message("mrtrix image\n"), HasSubstr("is not a .tck file"));
  EXPECT_THAT(message("mrtrix tracks\ndatatype: Float32LE\n"), HasSubstr("no 'END'"));
  EXPECT_THAT(message(tck(floats(two_tracks), "Int32LE")), HasSubstr("'Int32LE' is not a data type"));
  EXPECT_THAT(message(tck(floats(two_tracks), "Float32LE", ". 99999999")), HasSubstr("begin at byte 99999999"));
  EXPECT_THAT(message(tck(floats(two_tracks), "Float32LE", ". -1")), HasSubstr("where the tracks begin"));
  EXPECT_THAT(message(tck(floats(two_tracks), "Float32LE", "other.dat 0")), HasSubstr("in another file"));
  EXPECT_THAT(message(tck(floats(two_tracks).substr(0, 50))), HasSubstr("ends before"));
  EXPECT_THAT(message(tck(floats({1, nan, 3, 1, 2, 5, infinite, infinite, infinite}))), HasSubstr("not finite"));
  EXPECT_THAT(message(tck(floats({infinite, infinite, infinite}))), HasSubstr("holds no lines"));
}

TEST(LineFormats, tracks_of_trackvis_without_a_matrix_are_left_where_they_are) {
  const TestFolder folder;
  Trk trk;
  trk.put(36, std::int16_t{1}), trk.put(238, std::int16_t{2});  // a number per point, two per track
  trk.add({1, 2, 3, 99, 1, 2, 5, 99, 7, 7}, 2);
  const Polylines lines = read_polylines(folder.write("a.trk", trk.bytes()), 0.001);
  ASSERT_EQ(lines.count(), 1);
  EXPECT_NEAR((lines.line(0).col(1) - Vec3(0.001, 0.002, 0.005)).norm(), 0, 1e-12);
  trk.put(988, std::int32_t{0});  // how many there are is not known
  EXPECT_EQ(read_polylines(folder.write("b.trk", trk.bytes()), 0.001).count(), 1);
}

TEST(LineFormats, tracks_of_trackvis_come_into_the_scanner_s_frame) {
  const TestFolder folder;
  Trk trk;
  trk.add({1.5, 2.5, 3, 1.5, 2.5, 7}, 2);  // the middles of voxels (1, 2, 1) and (1, 2, 3)
  const auto first = [&](const std::vector<float>& matrix, const std::string& order) {
    trk.place(matrix, order);
    return Vec3(read_polylines(folder.write("a.trk", trk.bytes()), 1).line(0).col(0));
  };
  EXPECT_NEAR((first({1, 0, 0, 10, 0, 1, 0, 20, 0, 0, 2, 30, 0, 0, 0, 1}, "RAS") - Vec3(11, 22, 32)).norm(), 0, 1e-5);
  EXPECT_NEAR((first({1, 0, 0, 10, 0, 1, 0, 20, 0, 0, 2, 30, 0, 0, 0, 1}, "LAS") - Vec3(18, 22, 32)).norm(), 0, 1e-5)
      << "its first axis runs the other way: voxel 8 of 10";
  EXPECT_NEAR((first({0, -1, 0, 10, 1, 0, 0, 20, 0, 0, 2, 30, 0, 0, 0, 1}, "ALS") - Vec3(8, 21, 32)).norm(), 0, 1e-5);
  EXPECT_NEAR((first({0, -1, 0, 10, 1, 0, 0, 20, 0, 0, 2, 30, 0, 0, 0, 1}, "LAS") - Vec3(9, 22, 32)).norm(), 0, 1e-5)
      << "its axes are those of the matrix in another order";
}

TEST(LineFormats, a_broken_file_of_trackvis_is_one_message_with_its_name) {
  const TestFolder folder;
  const auto message = [&](const std::string& bytes) {
    return message_of_input_error([&] { read_polylines(folder.write("a.trk", bytes), 0.001); });
  };
  Trk trk;
  trk.add({1, 2, 3, 1, 2, 5}, 2);
  EXPECT_THAT(message("TRUCK" + trk.bytes().substr(5)), HasSubstr("is not a .trk file"));
  EXPECT_THAT(message(trk.bytes().substr(0, 500)), HasSubstr("ends within its header"));
  EXPECT_THAT(message(trk.bytes().substr(0, 1010)), HasSubstr("ends before"));
  Trk many = trk;
  many.put(988, std::int32_t{2'000'000'000});
  EXPECT_THAT(message(many.bytes()), HasSubstr("ends before"));
  Trk header = trk;
  header.put(996, std::int32_t{77});
  EXPECT_THAT(message(header.bytes()), HasSubstr("1000 bytes"));
  for (const std::int32_t points : {-5, 2'000'000'000}) {
    Trk wrong;
    wrong.add({1, 2, 3, 1, 2, 5}, points);
    EXPECT_THAT(message(wrong.bytes()), HasSubstr("which the file cannot hold"));
  }
  Trk undefined;
  undefined.add({1, nan, 3, 1, 2, 5}, 2);
  EXPECT_THAT(message(undefined.bytes()), HasSubstr("not finite"));
  Trk scalars = trk;
  scalars.put(36, std::int16_t{-3});
  EXPECT_THAT(message(scalars.bytes()), HasSubstr("negative count"));
}

TEST(LineFormats, a_table_of_tracts_says_its_unit_in_its_columns) {
  const TestFolder folder;
  const std::string rows = "7,1,2,3\n7,1,2,5\n8,0,0,0\n9,0,0,0\n9,0,1,0\n";
  const Polylines lines = read_polylines(folder.write("a.csv", "tract,x_mm,y_mm,z_mm\n" + rows), 1);
  ASSERT_EQ(lines.count(), 2) << "a single point is no line";
  EXPECT_NEAR((lines.line(0).col(1) - Vec3(0.001, 0.002, 0.005)).norm(), 0, 1e-12);
  EXPECT_NEAR(read_polylines(folder.write("b.csv", "tract,x,y,z\n" + rows), 0.01).line(0)(2, 1), 0.05, 1e-12);
  const auto message = [&](const std::string& text) {
    return message_of_input_error([&] { read_polylines(folder.write("c.csv", text), 1); });
  };
  EXPECT_THAT(message("x_mm,y_mm,z_mm\n1,2,3\n"), HasSubstr("no column 'tract'"));
  EXPECT_THAT(message("tract,x_mm,y_mm\n1,2,3\n"), HasSubstr("no column 'z_mm' or 'z'"));
  EXPECT_THAT(message("tract,x_mm,y_mm,z_mm\n1,2,3,nan\n"), HasSubstr("c.csv"));
  EXPECT_THAT(message("tract,x_mm,y_mm,z_mm\n"), HasSubstr("holds no lines"));
}

}  // namespace gracilis
