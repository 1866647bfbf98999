#include <gracilis/io/mesh/mesh_writer.hpp>
#include <gracilis/io/run/recorded_run.hpp>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <io/test_files.hpp>
#include <io/tiny_run.hpp>

#include <cmath>

using namespace gracilis;
using testing::HasSubstr;
namespace fs = std::filesystem;

namespace {

class RecordedRuns : public testing::Test {
 protected:
  RecordedRuns() {
    RunFolder out(folder.path(), run.scene, run.poses, ExistingRun::refuse);
    for (int i = 0; i < 3; ++i) out.write_frame(run.record(i));
    RunManifest manifest;
    manifest.scene = "tiny";
    manifest.status = "complete";
    out.write_manifest(manifest);
    out.finish();
    table = content(folder.path() / "measures.csv");
  }

  /// The table with the beginning of its last row, "2,", replaced.
  std::string with_last_frame(const std::string& frame) const {
    const std::size_t row = table.rfind('\n', table.size() - 2) + 1;
    return table.substr(0, row) + frame + table.substr(row + 1);
  }
  std::string refused(const std::string& measures) const {
    folder.write("measures.csv", measures);
    return message_of_input_error([&] { open_recorded_run(folder.path()); });
  }
  std::string refused_manifest(const std::string& text) const {
    folder.write("run.json", text);
    return message_of_input_error([&] { open_recorded_run(folder.path()); });
  }

  TestFolder folder;
  TinyRun run;
  std::string table;
};

TEST_F(RecordedRuns, reads_back_what_was_written) {
  const RecordedRun recorded = open_recorded_run(folder.path());
  EXPECT_EQ(recorded.frame_count, 3);
  EXPECT_EQ(recorded.muscles, std::vector<std::string>{"gluteus_maximus_r"});
  EXPECT_NEAR(measure_of(recorded, "volume_ratio")(2, 0), 1.002, 1e-9);
}

TEST_F(RecordedRuns, no_number_of_a_frame_leads_outside_of_the_table) {
  EXPECT_THAT(refused(with_last_frame("2147483648")), HasSubstr("'2147483648' is not the number of a frame"));
  EXPECT_THAT(refused(with_last_frame("4294967290")), HasSubstr("is not the number of a frame"));
  EXPECT_THAT(refused(with_last_frame("4294967297")), HasSubstr("is not the number of a frame"));
  EXPECT_THAT(refused(with_last_frame("-1")), HasSubstr("is not the number of a frame"));
  EXPECT_THAT(refused(with_last_frame("2147483647")), HasSubstr("frame 2147483647 among 3 rows"));
}

TEST_F(RecordedRuns, each_muscle_has_one_row_in_each_frame) {
  EXPECT_THAT(refused(with_last_frame("1")), HasSubstr("does not have one row per frame and muscle"));
  EXPECT_THAT(refused(with_last_frame("3")), HasSubstr("does not have one row per frame and muscle"));
}

TEST_F(RecordedRuns, rows_with_too_few_cells_are_an_error_but_for_what_was_cut_off) {
  EXPECT_THAT(refused(table + "3,0.3\n"), HasSubstr("has 2 cells"));
  folder.write("measures.csv", table + "3,0.3");
  EXPECT_EQ(open_recorded_run(folder.path()).frame_count, 3);
  folder.write("measures.csv", table.substr(0, table.size() - 1));  // whole to the eye, but it may go on
  EXPECT_EQ(open_recorded_run(folder.path()).frame_count, 2);
}

TEST_F(RecordedRuns, names_of_muscles_lead_to_files_of_the_run_only) {
  std::string other = table;
  for (std::size_t at = 0; (at = other.find("gluteus_maximus_r", at)) != std::string::npos;)
    other.replace(at, 17, "../gluteus");
  EXPECT_THAT(refused(other), HasSubstr("is not the name of a muscle"));
}

TEST_F(RecordedRuns, a_surface_keeps_its_vertices) {
  const TriangleMesh ball = tetrahedron(Vec3::Zero());
  Points more(3, 5);
  more << ball.vertices, Vec3::Ones();
  write_surface(frame_file(folder.path(), "femur_r", 1), more, ball.faces);
  const RecordedRun recorded = open_recorded_run(folder.path());
  EXPECT_THAT(message_of_input_error([&] { recorded_surface(recorded, "femur_r", 1); }),
              HasSubstr("has 5 vertices, but frame 0 has 4"));
}

TEST_F(RecordedRuns, surfaces_that_are_not_finite_are_refused) {
  const RecordedRun recorded = open_recorded_run(folder.path());
  TriangleMesh surface = tetrahedron(Vec3::Zero());
  surface.vertices(2, 3) = std::nan("");
  for (const char* name : {"femur_r", "gluteus_maximus_r"}) {
    write_surface(frame_file(folder.path(), name, 1), surface.vertices, surface.faces);
    EXPECT_THAT(message_of_input_error([&] { recorded_surface(recorded, name, 1); }),
                HasSubstr(std::string(name) + "_0001.vtp: has a vertex that is not finite"));
  }
  EXPECT_THAT(message_of_input_error([&] { read_frame(folder.path(), run.scene, 1, run.poses[1]); }),
              HasSubstr("gluteus_maximus_r_0001.vtp: has a vertex that is not finite"));
}

TEST_F(RecordedRuns, only_an_empty_cell_was_not_measured) {
  const std::string head = "frame,time_s,knee_deg,muscle,spike,fiber_strain_mean,milliseconds\n";
  const auto refused_row = [&](const std::string& row) { return refused(head + row + "\n"); };
  EXPECT_THAT(refused_row("0,0,0,a,abc,0,1"), HasSubstr("measures.csv:2: 'abc' in column 'spike' is not a finite"));
  EXPECT_THAT(refused_row("0,0,0,a,nan,0,1"), HasSubstr("'nan' in column 'spike'"));
  EXPECT_THAT(refused_row("0,0,0,a,1,-inf,1"), HasSubstr("'-inf' in column 'fiber_strain_mean'"));
  EXPECT_THAT(refused_row("0,nan,0,a,1,0,1"), HasSubstr("'nan' in column 'time_s'"));
  EXPECT_THAT(refused_row("0,0,,a,1,0,1"), HasSubstr("'' in column 'knee_deg'"));
  folder.write("measures.csv", head + "0,0,0,gluteus_maximus_r,,nan,1\n");  // nan as earlier versions wrote it
  const RecordedRun recorded = open_recorded_run(folder.path());
  EXPECT_TRUE(std::isnan(measure_of(recorded, "spike")(0, 0)));
  EXPECT_TRUE(std::isnan(measure_of(recorded, "fiber_strain_mean")(0, 0)));
}

TEST_F(RecordedRuns, a_manifest_of_another_shape_is_told_of) {
  EXPECT_THAT(refused_manifest("[]"), HasSubstr("run.json: is no manifest"));
  EXPECT_THAT(refused_manifest("3"), HasSubstr("run.json: is no manifest"));
  EXPECT_THAT(refused_manifest(R"({"scene": 3})"), HasSubstr("'scene' must be a text"));
  EXPECT_THAT(refused_manifest(R"({"warnings": [1]})"), HasSubstr("'warnings' must be a list of texts"));
  EXPECT_THAT(refused_manifest(R"({"action_lines": []})"), HasSubstr("'action_lines' must be an object"));
  EXPECT_THAT(refused_manifest("{"), HasSubstr("is not JSON"));
  for (const char* joints : {R"([5])", R"([{"name": 5}])", R"([{"coordinates": {}}])", R"([{"coordinates": [5]}])",
                             R"([{"coordinates": [{"name": 5}]}])", R"([{"coordinates": [{"translation": 0}]}])"})
    EXPECT_THAT(refused_manifest(fmt::format(R"({{"joints": {}}})", joints)), HasSubstr("'joints' must be a list"));
  EXPECT_THAT(refused_manifest(R"({"inputs": [{"file": 5}]})"), HasSubstr("'inputs' must be a list of files"));
  EXPECT_THAT(refused_manifest(R"({"inputs": [{"sha256": []}]})"), HasSubstr("'inputs' must be a list of files"));
  for (const char* number : {"1e300", "-1", "1.5", "2147483648", "18446744073709551615"})
    for (const char* key : {"every", "first_motion_frame", "frames"})
      EXPECT_THAT(refused_manifest(fmt::format(R"({{"{}": {}}})", key, number)), HasSubstr("must be a count"));
}

TEST_F(RecordedRuns, a_manifest_nested_without_end_is_no_stack_overflow) {
  EXPECT_THAT(refused_manifest(std::string(2'000'000, '[')), HasSubstr("run.json:1: is nested more than 64 times"));
  folder.write("run.json", R"({"scene": ")" + std::string(100, '[') + R"("})");
  EXPECT_EQ(open_recorded_run(folder.path()).frame_count, 3) << "brackets in a text are no nesting";
}

}  // namespace
