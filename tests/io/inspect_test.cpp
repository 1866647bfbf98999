#include <gracilis/io/run/inspect.hpp>
#include <gracilis/io/run/run_folder.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <io/test_files.hpp>
#include <nlohmann/json.hpp>

using namespace gracilis;
using testing::HasSubstr;

namespace {

const std::string open_surface = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\n";

}  // namespace

TEST(Inspect, a_surface_is_judged_for_both_roles) {
  const TestFolder folder;
  const auto json = inspect_file(folder.write("a.obj", open_surface));
  EXPECT_EQ(json["kind"], "surface");
  EXPECT_EQ(json["triangles"], 3);
  EXPECT_EQ(json["unit_seems_to_be"], "m");
  EXPECT_EQ(json["closed"], false);
  EXPECT_EQ(json["as_muscle"]["usable"], false);
  EXPECT_EQ(json["as_bone"]["usable"], true);
  EXPECT_EQ(json["defects"][0]["defect"], "open edges");
  EXPECT_EQ(json["defects"][0]["count"], 3);
  const std::string text = to_text(json);
  EXPECT_THAT(text, HasSubstr("a.obj: surface\n"));
  EXPECT_THAT(text, HasSubstr("open edges: count 3, first_face 0"));
  EXPECT_THAT(text, HasSubstr("size: 1 1 1\n"));
}

TEST(Inspect, a_broken_surface_is_described_rather_than_refused) {
  const TestFolder folder;
  const auto json = inspect_file(folder.write("nan.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"));
  EXPECT_EQ(json["defects"][0]["defect"], "coordinates that are not finite");
  EXPECT_EQ(json["as_bone"]["usable"], false);
}

TEST(Inspect, tables_and_landmarks_are_told_apart_by_their_columns) {
  const TestFolder folder;
  const auto table = inspect_file(folder.write("a.csv", "time,hip\n0,1\n1,-3\n"));
  EXPECT_EQ(table["kind"], "table");
  EXPECT_EQ(table["columns"][0]["from"], -3);
  const auto landmarks = inspect_file(folder.write("b.csv", "cloud,x_mm,y_mm,z_mm\na,1,2,3\na,3,2,1\n"));
  EXPECT_EQ(landmarks["kind"], "landmarks");
  EXPECT_EQ(landmarks["clouds"][0]["points"], 2);
}

TEST(Inspect, models_of_both_document_layouts_are_counted) {
  const TestFolder folder;
  const auto model = [&](const std::string& version, const std::string& content) {
    return inspect_file(
        folder.write("a.osim", "<OpenSimDocument Version='" + version + "'><Model name='m'>" + content +
                                   "<ForceSet><objects><Millard name='glut'><max_isometric_force>1"
                                   "</max_isometric_force></Millard><Spring name='s'/></objects></ForceSet>"
                                   "</Model></OpenSimDocument>"));
  };
  const std::string coordinates = "<CoordinateSet><objects><Coordinate name='flexion'/></objects></CoordinateSet>";
  const auto old = model("30000", "<BodySet><objects><Body name='femur'><Joint><CustomJoint name='hip'>" + coordinates +
                                      "</CustomJoint></Joint></Body></objects></BodySet>");
  const auto recent =
      model("40000",
            "<BodySet><objects><Body name='femur'/></objects></BodySet><JointSet><objects><CustomJoint "
            "name='hip'><coordinates><Coordinate name='flexion'/></coordinates></CustomJoint></objects></JointSet>");
  for (const auto& json : {old, recent}) {
    EXPECT_EQ(json["body_count"], 1);
    EXPECT_EQ(json["joint_count"], 1);
    EXPECT_EQ(json["coordinates"][0], "flexion");
    EXPECT_EQ(json["muscles"][0], "glut");
    EXPECT_EQ(json["other_force_count"], 1);
  }
}

TEST(Inspect, what_is_no_model_is_refused_with_the_line) {
  const TestFolder folder;
  const auto refused = [&](const std::string& text) {
    const auto path = folder.write("a.osim", text);
    return message_of_input_error([&] { inspect_file(path); });
  };
  EXPECT_THAT(refused("<OpenSimDocument>\n<Model>\n</OpenSim>"), HasSubstr("a.osim:3: is not XML"));
  EXPECT_THAT(refused("<x/>"), HasSubstr("a.osim: holds no OpenSim model"));
}

TEST(Inspect, a_run_folder_tells_the_worst_of_all_frames) {
  const TestFolder folder;
  folder.write("run.json", R"({"status": "interrupted", "frames": 2})");
  folder.write("measures.csv",
               "frame,muscle,volume_ratio,edge_ratio_mean,edge_ratio_max_free,vertex_depth_beyond_rest_mm,"
               "midpoint_depth_beyond_rest_mm,milliseconds\n"
               "0,a,1,1,1,0,0,0\n1,a,0.99,1.001,1.5,0.01,0.2,30\n2,a,1.002,1,1,0,0.1,20\n3,a,1.0");
  const auto json = inspect_file(folder.path());
  EXPECT_EQ(json["kind"], "run folder");
  EXPECT_EQ(json["status"], "interrupted");
  EXPECT_EQ(json["worst_of_all_frames"][0]["volume_ratio"], 0.99);
  EXPECT_EQ(json["worst_of_all_frames"][0]["milliseconds"], 30);
}

TEST(Inspect, what_is_unknown_is_refused_with_what_is_known) {
  const TestFolder folder;
  EXPECT_THAT(message_of_input_error([&] { inspect_file(folder.path()); }), HasSubstr("is no run folder"));
  EXPECT_THAT(message_of_input_error([&] { inspect_file(folder.path() / "no.ply"); }), HasSubstr("does not exist"));
  const auto text = folder.write("a.txt", "x");
  EXPECT_THAT(message_of_input_error([&] { inspect_file(text); }), HasSubstr("run folders"));
}

TEST(Inspect, real_models_are_read) {
  GRACILIS_NEEDS_DATA("opensim");
  EXPECT_EQ(inspect_file(data_root() / "opensim/subject01_simbody_adjusted_StaticOp.osim")["muscle_count"], 92);
  EXPECT_EQ(inspect_file(data_root() / "lhdl-hip/motion/LHDL_hip_r.osim")["muscle_count"], 8);
}
