#include <gracilis/io/scene/landmarks.hpp>
#include <gracilis/io/tables/table.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <io/test_files.hpp>

#include <cmath>
#include <limits>

using namespace gracilis;
using testing::ElementsAre;
using testing::HasSubstr;

namespace {

const std::string opensim_3 =
    "walk\nversion=1\nnRows=2\nnColumns=3\ninDegrees=yes\n\nUnits are S.I. units\nendheader\n"
    "time\thip_flexion_r\tpelvis_tx\n0.5\t90\t1.5\n0.6\t-45\t2.5\n";

std::string changed(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

std::string table_message(const std::filesystem::path& path) {
  return message_of_input_error([&] { read_table(path); });
}

void expect_walk(const Table& table) {
  EXPECT_THAT(table.columns, ElementsAre("hip_flexion_r", "pelvis_tx"));
  EXPECT_THAT(table.times, ElementsAre(0.5, 0.6));
  ASSERT_EQ(table.values.rows(), 2);
  EXPECT_EQ(table.values(1, 0), -45);
  EXPECT_EQ(table.values(1, 1), 2.5);
}

}  // namespace

TEST(Table, all_header_dialects_say_the_same) {
  const TestFolder folder;
  const std::string body = opensim_3.substr(opensim_3.find("time\t"));
  for (const auto& [name, text] :
       {std::pair<std::string, std::string>{"opensim_3.mot", opensim_3},
        {"simm.mot", "name walk\ndatacolumns 3\ndatarows 2\nrange 0.5 0.6\nendheader\n" + body},
        {"opensim_4.sto", "inDegrees=yes\nDataType=double\nversion=3\nOpenSimVersion=4.4\nendheader\n" + body}}) {
    const Table table = read_table(folder.write(name, text));
    expect_walk(table);
    EXPECT_TRUE(table.in_degrees) << name;
    EXPECT_EQ(table.warnings.size(), name == "simm.mot" ? 1u : 0u) << name;
  }
}

TEST(Table, oddities_of_form_change_nothing) {
  const TestFolder folder;
  std::string crlf;
  for (const char c : opensim_3) crlf += c == '\n' ? "\t\t\r\n" : std::string(1, c);
  expect_walk(read_table(folder.write("crlf_and_trailing_tabs.mot", crlf)));
  expect_walk(read_table(folder.write("bom.mot", "\xef\xbb\xbf" + opensim_3)));
  expect_walk(read_table(folder.write("blank.mot", changed(opensim_3, "0.6\t", "\n\t\n0.6\t") + "\n\n")));
  expect_walk(read_table(folder.write("a.csv", "time,hip_flexion_r,pelvis_tx\n0.5,90,1.5\n0.6,-45,2.5,\n")));
  expect_walk(read_table(folder.write("spaces.mot",
                                      "x\ninDegrees = yes\nendheader\n  time   hip_flexion_r  pelvis_tx\n"
                                      "  0.5  90  1.5\n  0.6  -45  +2.5\n")));
  expect_walk(read_table(folder.write("order.mot",
                                      "x\ninDegrees=yes\nendheader\nhip_flexion_r\ttime\tpelvis_tx\n"
                                      "90\t0.5\t1.5\n-45\t0.6\t2.5\n")));
}

TEST(Table, wrong_counts_and_a_missing_unit_are_warnings) {
  const TestFolder folder;
  const Table rows = read_table(folder.write("a.mot", changed(opensim_3, "nRows=2", "nRows=51")));
  expect_walk(rows);
  ASSERT_EQ(rows.warnings.size(), 1u);
  EXPECT_THAT(rows.warnings[0], HasSubstr("a.mot: announces 51 rows but has 2"));
  EXPECT_THAT(read_table(folder.write("b.mot", changed(opensim_3, "nColumns=3", "nColumns=9"))).warnings[0],
              HasSubstr("announces 9 columns but has 3"));
  const Table unitless = read_table(folder.write("c.mot", changed(opensim_3, "inDegrees=yes\n", "")));
  EXPECT_FALSE(unitless.in_degrees);
  EXPECT_THAT(unitless.warnings[0], HasSubstr("does not say inDegrees"));
}

TEST(Table, what_cannot_be_survived_is_named_with_its_line) {
  const TestFolder folder;
  const auto refused = [&](const std::string& from, const std::string& to) {
    return table_message(folder.write("a.mot", changed(opensim_3, from, to)));
  };
  EXPECT_THAT(refused("-45", "-4x5"), HasSubstr("a.mot:11: '-4x5' in column 'hip_flexion_r' is not a number"));
  EXPECT_THAT(refused("-45", "nan"), HasSubstr("a.mot:11: column 'hip_flexion_r' is nan"));
  EXPECT_THAT(refused("-45", "1e999"), HasSubstr("a.mot:11:"));
  EXPECT_THAT(refused("\t2.5", ""), HasSubstr("a.mot:11: has 2 numbers where there are 3 columns"));
  EXPECT_THAT(refused("\t2.5", "\t2.5\t3"), HasSubstr("a.mot:11: has 4 numbers where there are 3 columns"));
  EXPECT_THAT(refused("-45", ""), HasSubstr("a.mot:11: '' in column 'hip_flexion_r'"));
  EXPECT_THAT(refused("0.6", "0.4"), HasSubstr("a.mot:11: time 0.4 does not come after 0.5"));
  EXPECT_THAT(refused("time", "tyme"), HasSubstr("a.mot:9: has no column 'time'"));
  EXPECT_THAT(refused("=yes", "=perhaps"), HasSubstr("a.mot:5: inDegrees must be yes or no, not 'perhaps'"));
  EXPECT_THAT(table_message(folder.write("b.mot", "hello\n")), HasSubstr("b.mot:1: has no column 'time'"));
  EXPECT_THAT(table_message(folder.write("c.mot", opensim_3.substr(0, opensim_3.find("0.5")))),
              HasSubstr("holds no rows"));
  EXPECT_THAT(table_message(folder.write("d.mot", "x\nendheader\n")), HasSubstr("has no column 'time'"));
}

TEST(Table, only_angles_become_radians_in_a_motion) {
  const TestFolder folder;
  Table table = read_table(folder.write("a.mot", opensim_3));
  const Motion motion = motion_from_table(table);
  EXPECT_THAT(motion.coordinates, ElementsAre("hip_flexion_r"));
  EXPECT_DOUBLE_EQ(motion.values(0, 0), pi / 2);
  table.in_degrees = false;
  table.columns = {"/jointset/hip_r/hip_flexion_r/value", "/jointset/hip_r/hip_flexion_r/speed"};
  const Motion states = motion_from_table(table);
  EXPECT_THAT(states.coordinates, ElementsAre("hip_flexion_r"));
  EXPECT_EQ(states.values(0, 0), 90);
}

TEST(Table, what_is_written_is_read_back_with_the_same_bits) {
  const TestFolder folder;
  Table table{"lengths", {"a", "b"}, {0, 0.1}, Eigen::MatrixXd(2, 2), false, {}};
  table.values << 1.0 / 3, 1e-300, -2e200, 4;
  write_sto(folder.path() / "a.sto", table);
  const Table read = read_table(folder.path() / "a.sto");
  EXPECT_EQ(read.name, "lengths");
  EXPECT_EQ(read.columns, table.columns);
  EXPECT_EQ(read.times, table.times);
  EXPECT_TRUE((read.values.array() == table.values.array()).all());
  EXPECT_TRUE(read.warnings.empty());
}

TEST(Table, what_is_not_finite_is_not_written) {
  const TestFolder folder;
  const auto refused = [&](const Table& table) -> std::string {
    try {
      write_sto(folder.path() / "a.sto", table);
    } catch (const QualityError& error) {
      return error.what();
    }
    return "";
  };
  Table table{"lengths", {"a", "b"}, {0, 0.1}, Eigen::MatrixXd::Ones(2, 2), false, {}};
  table.values(1, 1) = std::nan("");
  EXPECT_THAT(refused(table), HasSubstr("a.sto: would have nan in column 'b' of row 2"));
  table.times[0] = -std::numeric_limits<Real>::infinity();
  EXPECT_THAT(refused(table), HasSubstr("would have -inf in column 'time' of row 1"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "a.sto"));
}

TEST(Table, the_cadaver_s_motions_are_read) {
  GRACILIS_NEEDS_DATA("lhdl-hip/motion");
  const Table flexion = read_table(data_root() / "lhdl-hip/motion/hip_flexion.mot");
  EXPECT_EQ(flexion.times.size(), 36u);
  EXPECT_TRUE(flexion.in_degrees);
  ASSERT_EQ(flexion.warnings.size(), 1u);
  EXPECT_THAT(flexion.warnings[0], HasSubstr("announces 51 rows but has 36"));
  EXPECT_THAT(motion_from_table(flexion).coordinates,
              ElementsAre("xRotation", "yRotation", "zRotation", "hip_flexion_r", "hip_adduction_r", "hip_rotation_r"));
  EXPECT_EQ(read_table(data_root() / "lhdl-hip/motion/hip_adduction.mot").times.size(), 41u);
  EXPECT_EQ(read_table(data_root() / "lhdl-hip/motion/hip_rotation.mot").times.size(), 31u);
}

TEST(Table, the_gait_of_opensim_is_read) {
  GRACILIS_NEEDS_DATA("opensim");
  const Table kinematics = read_table(data_root() / "opensim/subject01_walk1_Kinematics.sto");
  EXPECT_EQ(kinematics.values.rows(), 1500);
  EXPECT_TRUE(kinematics.in_degrees);
  EXPECT_TRUE(kinematics.warnings.empty());
  EXPECT_EQ(read_table(data_root() / "opensim/subject01_StaticOptimization_activation.sto").columns.size(), 98u);
  EXPECT_EQ(read_table(data_root() / "opensim/subject01_StaticOptimization_force.sto").values.rows(), 151);
  const Table forces = read_table(data_root() / "opensim/subject01_walk1_grf.mot");
  EXPECT_EQ(forces.values.rows(), 9009);
  EXPECT_EQ(forces.columns.size(), 18u);
  EXPECT_EQ(forces.columns[0], "right_foot_force_vx");
}

TEST(Landmarks, clouds_keep_the_order_of_rows_and_the_unit_of_the_header) {
  const TestFolder folder;
  const auto clouds = read_landmarks(
      folder.write("a.csv", "cloud,index,x_mm,y_mm,z_mm\r\nb,2,1000,0,0\r\na,1,1,2,3\r\nb,1,2000,0,0\r\n\r\n"), 1);
  ASSERT_EQ(clouds.size(), 2u);
  EXPECT_EQ(clouds[0].name, "b");
  EXPECT_EQ(clouds[0].points, (Points(3, 2) << 1, 2, 0, 0, 0, 0).finished());
  EXPECT_THAT(clouds[0].labels, ElementsAre("2", "1"));
  EXPECT_TRUE(clouds[1].points.isApprox(Points(Vec3(0.001, 0.002, 0.003))));
  const auto unitless = read_landmarks(folder.write("b.csv", "z,y,x,cloud\n3,2,1,a\n"), 0.01);
  EXPECT_TRUE(unitless[0].points.isApprox(Points(Vec3(0.01, 0.02, 0.03))));
}

TEST(Landmarks, damage_is_named_with_its_line) {
  const TestFolder folder;
  const auto refused = [&](const std::string& text) {
    const auto path = folder.write("a.csv", text);
    return message_of_input_error([&] { read_landmarks(path, 1); });
  };
  EXPECT_THAT(refused("name,x,y,z\n"), HasSubstr("a.csv:1: names no column 'cloud'"));
  EXPECT_THAT(refused("cloud,x_mm,y_m,z_mm\n"), HasSubstr("a.csv:1: names no columns x, y and z"));
  EXPECT_THAT(refused("cloud,x,y,z\na,1,2,drei\n"), HasSubstr("a.csv:2: 'drei' is not a coordinate"));
  EXPECT_THAT(refused("cloud,x,y,z\na,1,2,3\na,1,2\n"), HasSubstr("a.csv:3: '' is not a coordinate"));
  EXPECT_THAT(refused("cloud,x,y,z\na,1,nan,3\n"), HasSubstr("a.csv:2: 'nan'"));
  EXPECT_THAT(refused("cloud,x,y,z\n,1,2,3\n"), HasSubstr("a.csv:2: has no name"));
  EXPECT_THAT(refused("cloud,x,y,z\n"), HasSubstr("holds no landmarks"));
  EXPECT_THAT(refused("\n \n"), HasSubstr("nothing but blank lines"));
}

TEST(Landmarks, the_cadaver_s_are_read) {
  GRACILIS_NEEDS_DATA("lhdl-hip/attachment_landmarks.csv");
  const auto clouds = read_landmarks(data_root() / "lhdl-hip/attachment_landmarks.csv", 1);
  ASSERT_EQ(clouds.size(), 14u);
  EXPECT_EQ(clouds[0].labels[3], "HJC");
  EXPECT_TRUE(clouds[0].points.col(3).isApprox(Vec3(0.143478, 0.243439, -0.4326695)));
  Index total = 0;
  for (const LandmarkCloud& cloud : clouds) total += static_cast<Index>(cloud.points.cols());
  EXPECT_EQ(total, 199);
}

TEST(Table, what_opensim_itself_writes_is_read_with_a_warning) {
  const TestFolder folder;
  const std::string head = "states\nversion=1\ninDegrees=no\nendheader\n";
  const Table repeated =
      read_table(folder.write("a.sto", head + "time\tq\tr\tq\n0\t1\t2\t3\n0\t4\t5\t6\n1\t7\t8\t9\n"));
  EXPECT_EQ(repeated.columns, (std::vector<std::string>{"q", "r"}));
  EXPECT_EQ(repeated.times, (std::vector<Real>{0, 1}));
  EXPECT_EQ(repeated.values(0, 0), 1);
  EXPECT_EQ(repeated.values(1, 1), 8);
  EXPECT_EQ(repeated.warnings.size(), 2u);
  const Table turned = read_table(folder.write(
      "b.sto", "DataRate=40\nDataType=Quaternion\ninDegrees=no\nendheader\ntime\ttorso_imu\n0\t1,0,0,0\n1\t0,1,0,0\n"));
  EXPECT_TRUE(turned.columns.empty());
  EXPECT_EQ(turned.values.rows(), 2);
  EXPECT_THAT(turned.warnings.at(0), HasSubstr("'torso_imu' holds several numbers"));
  const Table bare = read_table(folder.write("c.sto", head + "time\n0\n1\n"));
  EXPECT_EQ(bare.times.size(), 2u);
  EXPECT_THAT(bare.warnings.at(0), HasSubstr("no column beside 'time'"));
}
