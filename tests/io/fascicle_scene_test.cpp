#include <gracilis/io/scene/scene_reader.hpp>

#include "io/scene_reader_fixture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gracilis {
namespace {

using testing::HasSubstr;

/// The good scene whose muscle has fibers as `keys` say.
std::string with_fibers(const std::string& keys) {
  return with(good_scene(), "[[muscles.attachments]]", "[muscles.fibers]\n" + keys + "\n[[muscles.attachments]]");
}

/// Whose origin has an aponeurosis.
std::string with_aponeurosis(const std::string& keys) {
  return with(good_scene(), "name = \"top\"", "name = \"top\"\n" + keys);
}

const std::string tract_table = "tract,x_mm,y_mm,z_mm\n1,5,5,12\n1,5,5,28\n";

}  // namespace

TEST_F(SceneReader, tracts_and_aponeuroses_come_into_the_muscle) {
  folder.write("tracts.csv", tract_table);
  const Muscle along = read(with_fibers("tracts = \"tracts.csv\"")).scene.muscles[0];
  ASSERT_EQ(along.tracts.count(), 1);
  EXPECT_NEAR(along.tracts.points(2, 1), 0.028, 1e-12);
  EXPECT_EQ(along.given_fibers.count(), 0);

  folder.write_box("sheet.ply", 27, 28);
  const Muscle spread =
      read(with_aponeurosis("aponeurosis = [\"sheet.ply\", \"sheet.ply\"]\nunit = \"mm\"")).scene.muscles[0];
  ASSERT_EQ(spread.aponeuroses.size(), 2u);
  EXPECT_EQ(spread.aponeuroses[0].end, AttachmentEnd::origin);
  EXPECT_NEAR(spread.aponeuroses[0].surface.vertices.row(2).maxCoeff(), 0.028, 1e-9);
}

TEST_F(SceneReader, pennation_may_be_given_in_degrees) {
  EXPECT_NEAR(read(with_fibers("ends = \"aponeuroses\"\npennation_deg = 30")).scene.muscles[0].fibers.pennation, pi / 6,
              1e-12);
  EXPECT_THAT(problems(with_fibers("pennation_deg = 30\npennation = 0.5")), HasSubstr("given twice"));
  EXPECT_THAT(problems(with_fibers("pennation_deg = 90")),
              HasSubstr("'pennation_deg' must be a number from -68.0 to 68.0 degrees"));
  EXPECT_THAT(problems(with_fibers("ends = \"tendons\"")), HasSubstr("'attachments', 'aponeuroses'"));
}

TEST_F(SceneReader, what_is_wrong_with_tracts_and_aponeuroses_is_said) {
  folder.write("tracts.csv", tract_table);
  folder.write("far.csv", "tract,x,y,z\n1,5,5,12\n1,5,5,28\n");
  folder.write("flat.ply", "ply\nformat ascii 1.0\nend_header\n");
  folder.write_box("sheet.ply", 27, 28);
  EXPECT_THAT(problems(with_fibers("tracts = \"tracts.csv\"\nfile = \"tracts.csv\"")),
              HasSubstr("keep one of the two"));
  EXPECT_THAT(problems(with_fibers("tracts = \"far.csv\"")),
              HasSubstr("no tract of 'far.csv' lies in muscle (check the units"));
  EXPECT_THAT(problems(with_fibers("tracts = \"none.trk\"")), HasSubstr("'none.trk' does not exist"));
  EXPECT_THAT(problems(with_fibers("tracts = 7")), HasSubstr("'tracts' must be a text"));
  EXPECT_THAT(problems(with_aponeurosis("aponeurosis = \"sheet.ply\"")),
              HasSubstr("the aponeurosis 'sheet.ply' lies outside of muscle (check the units"))
      << "in metres";
  EXPECT_THAT(problems(with_aponeurosis("aponeurosis = \"none.ply\"")), HasSubstr("'none.ply' does not exist"));
  EXPECT_THAT(problems(with_aponeurosis("aponeurosis = \"flat.ply\"")), HasSubstr("flat.ply"));
}

TEST_F(SceneReader, files_of_tractography_are_in_mm_unless_the_scene_says_otherwise) {
  std::string head = "mrtrix tracks\ndatatype: Float32LE\nfile: . 60\nEND\n";
  head.resize(60, '\0');
  const float inf = std::numeric_limits<float>::infinity();
  for (const float number : {5.f, 5.f, 12.f, 5.f, 5.f, 28.f, inf, inf, inf})
    head.append(reinterpret_cast<const char*>(&number), sizeof(number));
  folder.write("a.tck", head);
  EXPECT_NEAR(read(with_fibers("tracts = \"a.tck\"")).scene.muscles[0].tracts.points(2, 0), 0.012, 1e-9);
  EXPECT_THAT(problems(with_fibers("tracts = \"a.tck\"\nunit = \"cm\"")),
              HasSubstr("no tract of 'a.tck' lies in muscle"));
}

}  // namespace gracilis
