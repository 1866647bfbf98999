#include <gracilis/io/tables/arm_reference.hpp>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <io/test_files.hpp>

#include <chrono>

using namespace gracilis;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(ArmReference, each_muscle_coordinate_and_source_is_a_curve_by_ascending_angles) {
  const TestFolder folder;
  const auto curves = read_arm_reference(folder.write("a.csv",
                                                      "angle_deg,model,moment_arm_mm,coordinate,muscle\n"
                                                      "30,first,20,knee,gracilis_r\n"
                                                      "\n"
                                                      "10,first,15,knee,gracilis_r\n"
                                                      "10,second,-7,knee,gracilis_r\n"
                                                      "10,first,3,hip,gracilis_r\n"));
  ASSERT_EQ(curves.size(), 3u);
  EXPECT_EQ(curves[0].muscle, "gracilis_r");
  EXPECT_EQ(curves[0].source, "first");
  EXPECT_EQ(curves[0].coordinate, "knee");
  EXPECT_EQ(curves[0].angles, (std::vector<Real>{radians(10), radians(30)}));
  EXPECT_EQ(curves[0].arms, (std::vector<Real>{0.015, 0.02}));
  EXPECT_TRUE(curves[0].low.empty());
  EXPECT_EQ(curves[1].source, "second");
  EXPECT_EQ(curves[2].coordinate, "hip");
}

TEST(ArmReference, bounds_come_with_the_mean_and_the_file_is_the_source) {
  const TestFolder folder;
  const auto curves =
      read_arm_reference(folder.write("measured.csv", "muscle,angle_deg,min,p10,mean,p90,max\npsoas,5,-1,0,2,3,4\n"));
  ASSERT_EQ(curves.size(), 1u);
  EXPECT_EQ(curves[0].source, "measured");
  EXPECT_EQ(curves[0].arms, std::vector<Real>{2});
  EXPECT_EQ(curves[0].low, std::vector<Real>{-1});
  EXPECT_EQ(curves[0].high, std::vector<Real>{4});
}

TEST(ArmReference, tables_of_rom_are_curves_too_and_what_led_to_the_range_gives_way) {
  const TestFolder folder;
  const auto table = folder.write("moment_arms.sto",
                                  "arms\nversion=1\nnRows=4\nnColumns=3\ninDegrees=yes\nendheader\ntime\tq\tpsoas\n"
                                  "0\t0\t9\n1\t10\t0.01\n2\t0\t0.02\n3\t-10\t0.03\n");
  const auto curves = read_arm_reference(table, "q");
  ASSERT_EQ(curves.size(), 1u);
  EXPECT_EQ(curves[0].muscle, "psoas");
  EXPECT_EQ(curves[0].coordinate, "q");
  EXPECT_THAT(curves[0].angles, ElementsAre(radians(-10), 0, radians(10)));
  EXPECT_THAT(curves[0].arms, ElementsAre(0.03, 0.02, 0.01));
  EXPECT_THAT(message_of_input_error([&] { read_arm_reference(table, "knee"); }), HasSubstr("no column 'knee'"));
}

TEST(ArmReference, lengths_are_read_alike) {
  const TestFolder folder;
  const auto curves = read_length_reference(folder.write("l.csv", "muscle,angle_deg,length_cm\npsoas,5,20\n"), "q");
  EXPECT_THAT(curves.at(0).arms, ElementsAre(0.2));
  EXPECT_THAT(message_of_input_error([&] {
                read_length_reference(folder.write("m.csv", "muscle,angle_deg,moment_arm_mm\npsoas,5,20\n"), "q");
              }),
              HasSubstr("names no column of lengths"));
}

TEST(ArmReference, what_is_wrong_is_told_with_its_line) {
  const TestFolder folder;
  const auto message = [&](const std::string& text) {
    return message_of_input_error([&] { read_arm_reference(folder.write("a.csv", text)); });
  };
  const std::string head = "muscle,angle_deg,moment_arm_mm\n";
  EXPECT_THAT(message("\n \n"), HasSubstr("blank lines"));
  EXPECT_THAT(message("angle_deg,mean\n"), HasSubstr("names no column 'muscle'"));
  EXPECT_THAT(message("muscle,mean\n"), HasSubstr("names no column 'angle_deg'"));
  EXPECT_THAT(message("muscle,angle_deg\n"), HasSubstr("names no column of moment arms"));
  EXPECT_THAT(message(head), HasSubstr("holds no moment arms"));
  EXPECT_THAT(message(head + "a,1,2\n\na,x,2\n"), AllOf(HasSubstr("a.csv:4"), HasSubstr("'x' is not an angle")));
  EXPECT_THAT(message(head + "a,1,nan\n"), HasSubstr("is not a moment arm"));
  EXPECT_THAT(message(head + "a,1\n"), HasSubstr("is not a moment arm"));
  EXPECT_THAT(message(head + ",1,2\n"), HasSubstr("names no muscle"));
  EXPECT_THAT(message(head + "a,1,2\na,1,3\n"), AllOf(HasSubstr("a.csv:3"), HasSubstr("an angle of 'a' twice")));
}

TEST(ArmReference, hundreds_of_thousands_of_angles_are_read_in_seconds) {
  const TestFolder folder;
  std::string text = "muscle,angle_deg,moment_arm_mm\n";
  for (int i = 0; i < 400'000; ++i) text += fmt::format("a,{},1\n", i);
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(read_arm_reference(folder.write("a.csv", text)).at(0).angles.size(), 400'000u);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(20));
}
