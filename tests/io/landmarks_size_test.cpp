#include <gracilis/io/scene/landmarks.hpp>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <io/test_files.hpp>

#include <chrono>

using namespace gracilis;

TEST(Landmarks, hundreds_of_thousands_of_clouds_are_read_in_seconds) {
  const TestFolder folder;
  std::string text = "cloud,x_mm,y_mm,z_mm\n";
  for (int round = 0; round < 2; ++round)
    for (int i = 0; i < 200'000; ++i) text += fmt::format("cloud_{},{},0,{}\n", i, i, round);
  const auto begin = std::chrono::steady_clock::now();
  const std::vector<LandmarkCloud> clouds = read_landmarks(folder.write("a.csv", text), 1);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(20)) << "by pairs it takes minutes";
  ASSERT_EQ(clouds.size(), 200'000u);
  EXPECT_EQ(clouds[7].points.cols(), 2);
  EXPECT_NEAR(clouds[7].points(2, 1), 0.001, 1e-12);
}

TEST(Landmarks, a_cloud_of_hundreds_of_thousands_of_points_is_read_in_seconds) {
  const TestFolder folder;
  std::string text = "cloud,x_mm,y_mm,z_mm\n";
  for (int i = 0; i < 400'000; ++i) text += fmt::format("a,{},0,0\n", i);
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(read_landmarks(folder.write("a.csv", text), 1).at(0).points.cols(), 400'000);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(20));
}
