#include <gracilis/io/hdf5_writer.hpp>

#include "io/hdf5_reading.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <io/test_files.hpp>

namespace gracilis {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(Hdf5Writer, what_it_writes_the_library_reads_back) {
  const TestFolder folder;
  const std::filesystem::path path = folder.path() / "a.h5";
  std::vector<float> track(2 * 3 * 3);
  for (std::size_t i = 0; i < track.size(); ++i) track[i] = static_cast<float>(i) / 4;
  {
    Hdf5Writer file(path, path);
    file.write("/runs/a/track", {2, 3, 3}, std::span<const float>(track));
    file.write("/runs/a/time", {2}, std::span<const double>(std::vector<double>{0, 0.1}));
    file.write("/runs/a/faces", {1, 3}, std::span<const std::int32_t>(std::vector<std::int32_t>{0, 2, 1}));
    file.describe("/runs/a", "scene", "µ-scene \"x\"");
    file.describe("/runs/a/time", "columns", std::vector<std::string>{"one", ""});
    file.make_group("/runs/b");
    file.remove("/runs/b");
    file.remove("/runs/c");
    file.close();
  }
  const Hdf5Numbers read = hdf5_numbers(path, "/runs/a/track");
  EXPECT_THAT(read.shape, ElementsAre(2, 3, 3));
  EXPECT_EQ(std::vector<float>(read.values.begin(), read.values.end()), track);
  EXPECT_THAT(hdf5_numbers(path, "/runs/a/time").values, ElementsAre(0, 0.1));
  EXPECT_THAT(hdf5_numbers(path, "/runs/a/faces").values, ElementsAre(0, 2, 1));
  EXPECT_THAT(hdf5_texts(path, "/runs/a", "scene"), ElementsAre("µ-scene \"x\""));
  EXPECT_THAT(hdf5_texts(path, "/runs/a/time", "columns"), ElementsAre("one", ""));
  EXPECT_FALSE(hdf5_has(path, "/runs/b"));
}

TEST(Hdf5Writer, a_file_that_cannot_be_made_or_an_object_twice_is_one_message_that_names_it) {
  const TestFolder folder;
  EXPECT_THAT(message_of_input_error([&] { Hdf5Writer(folder.path() / "missing" / "a.h5", "shown.h5"); }),
              HasSubstr("shown.h5"));
  Hdf5Writer file(folder.path() / "a.h5", "shown.h5");
  file.make_group("/a");
  EXPECT_THAT(message_of_input_error([&] { file.make_group("/a"); }), HasSubstr("cannot be written at /a"));
  EXPECT_THAT(message_of_input_error([&] { file.describe("/b", "scene", "x"); }), HasSubstr("/b"));
}

}  // namespace
}  // namespace gracilis
