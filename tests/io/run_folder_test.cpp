#include <gracilis/io/content_hash.hpp>
#include <gracilis/io/mesh/mesh_reader.hpp>
#include <gracilis/io/mesh/mesh_reader_vtp.hpp>
#include <gracilis/io/mesh/mesh_writer.hpp>
#include <gracilis/io/run/recorded_run.hpp>
#include <gracilis/io/run/run_folder.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <io/test_files.hpp>
#include <io/tiny_run.hpp>
#include <nlohmann/json.hpp>


#include <sstream>

using namespace gracilis;
using testing::HasSubstr;
namespace fs = std::filesystem;

namespace {

long count_of(const std::string& text, const std::string& part) {
  long count = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

}  // namespace

TEST(MeshWriter, what_is_read_back_has_the_same_bits) {
  const TestFolder folder;
  const TriangleMesh mesh = tetrahedron(Vec3(1e-3, 1.0 / 7, -1e9));
  write_surface(folder.path() / "a.vtp", mesh.vertices, mesh.faces, {{"depth", Eigen::VectorXd::Ones(4)}});
  const TriangleMesh read = read_mesh(folder.path() / "a.vtp", 1);
  EXPECT_TRUE((read.vertices.array() == mesh.vertices.array()).all());
  EXPECT_TRUE((read.faces.array() == mesh.faces.array()).all());
  EXPECT_THAT(content(folder.path() / "a.vtp"), HasSubstr("Name=\"depth\""));
}

TEST(MeshWriter, a_folder_that_is_not_there_is_one_clear_error) {
  const TriangleMesh mesh = tetrahedron(Vec3::Zero());
  testing::internal::CaptureStderr();
  const std::string text = message_of_input_error([&] { write_surface("/no/such/a.vtp", mesh.vertices, mesh.faces); });
  EXPECT_THAT(text, HasSubstr("/no/such/a.vtp: cannot be written"));
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(MeshWriter, a_full_disk_is_one_clear_error_and_leaves_the_old_file) {
  const TestFolder folder;
  const fs::path path = folder.write("a.vtp", "as it was");
  Points points = Points::Random(3, 20000);
  Eigen::Matrix3Xi faces = Eigen::Matrix3Xi::Zero(3, 1);
  const std::string text = message_on_a_full_disk([&] { write_surface(path, points, faces); });
  EXPECT_THAT(text, HasSubstr("a.vtp: cannot be written"));
  EXPECT_EQ(content(path), "as it was");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 1);
}

TEST(RunFolder, frame_0_is_the_input_and_bones_move_with_their_body) {
  const TestFolder folder;
  const TinyRun run;
  RunFolder out(folder.path() / "run", run.scene, run.poses, ExistingRun::refuse);
  for (int i = 0; i < 3; ++i) out.write_frame(run.record(i));
  out.finish();
  const auto points = [&](const char* name, int number) {
    return read_mesh(frame_file(out.path(), name, number), 1).vertices;
  };
  EXPECT_TRUE((points("gluteus_maximus_r", 0).array() == run.scene.muscles[0].surface.vertices.array()).all());
  EXPECT_TRUE((points("femur_r", 0).array() == run.scene.bones[0].surface.vertices.array()).all());
  EXPECT_TRUE(points("femur_r", 2).isApprox(run.poses[2].bodies[1] * run.scene.bones[0].surface.vertices, 1e-15));
  EXPECT_EQ(count_frames(out.path(), run.scene), 3);
}

TEST(RunFolder, frame_0_tells_origins_insertions_and_bellies) {
  const TestFolder folder;
  TinyRun tiny;
  tiny.scene.muscles[0].attachments = {{"a", AttachmentEnd::origin, 0, {0}}, {"b", AttachmentEnd::insertion, 1, {2}}};
  RunFolder run(folder.path(), tiny.scene, tiny.poses, ExistingRun::refuse);
  for (int number = 0; number < 2; ++number) run.write_frame(tiny.record(number));
  RecordedRun recorded;
  recorded.folder = folder.path();
  const Points tissue = recorded_tissue(recorded, "gluteus_maximus_r");
  ASSERT_EQ(tissue.cols(), 4);
  EXPECT_EQ(tissue.row(0), Eigen::RowVector4d(1, 0, 0, 0));
  EXPECT_EQ(tissue.row(1), Eigen::RowVector4d(0, 0, 1, 0));
  EXPECT_EQ(tissue(2, 0), 0);
  EXPECT_EQ(tissue(2, 3), 1);  // farther away than a tendon is long
  EXPECT_EQ(VtpFile(frame_file(folder.path(), "gluteus_maximus_r", 1)).vectors(tissue_name).cols(), 0);
}

TEST(RunFolder, measures_have_a_row_per_frame_and_muscle_under_named_columns) {
  const TestFolder folder;
  const TinyRun run;
  RunFolder out(folder.path(), run.scene, run.poses, ExistingRun::refuse);
  out.write_frame(run.record(0));
  out.write_frame(run.record(1));
  std::istringstream lines(content(folder.path() / "measures.csv"));  // before finish: flushed frame by frame
  std::string header, row0, row1, more;
  std::getline(lines, header);
  std::getline(lines, row0);
  std::getline(lines, row1);
  EXPECT_FALSE(std::getline(lines, more));
  EXPECT_THAT(header, testing::StartsWith("frame,time_s,hip_flexion_r_deg,muscle,volume_ratio"));
  EXPECT_THAT(row1, testing::StartsWith("1,0.100000,10.0000,gluteus_maximus_r,1.001000,"));
  EXPECT_EQ(count_of(header, ","), count_of(row1, ","));
}

TEST(RunFolder, the_index_names_only_files_that_are_there) {
  const TestFolder folder;
  const TinyRun run;
  RunFolder out(folder.path(), run.scene, run.poses, ExistingRun::refuse);
  out.write_frame(run.record(0));
  out.write_frame(run.record(1));
  EXPECT_THAT(content(folder.path() / "run.pvd"), HasSubstr("</VTKFile>"));
  out.finish();
  const std::string index = content(folder.path() / "run.pvd");
  EXPECT_EQ(count_of(index, "<DataSet"), 4);
  EXPECT_THAT(index, HasSubstr("timestep=\"0.1\""));
  EXPECT_THAT(index, HasSubstr("file=\"frames/femur_r_0001.vtp\""));
}

TEST(RunFolder, a_run_that_is_there_already_is_refused_or_replaced) {
  const TestFolder folder;
  const TinyRun run;
  {
    RunFolder out(folder.path(), run.scene, run.poses, ExistingRun::refuse);
    for (int i = 0; i < 4; ++i) out.write_frame(run.record(i));
  }
  folder.write("notes.txt", "mine");
  EXPECT_THROW(RunFolder(folder.path(), run.scene, run.poses, ExistingRun::refuse), ConfigurationError);
  RunFolder out(folder.path(), run.scene, run.poses, ExistingRun::replace);
  out.write_frame(run.record(0));
  EXPECT_EQ(count_frames(folder.path(), run.scene), 1);
  EXPECT_FALSE(fs::exists(frame_file(folder.path(), "femur_r", 3)));
  EXPECT_EQ(count_of(content(folder.path() / "measures.csv"), "\n"), 2);
  EXPECT_TRUE(fs::exists(folder.path() / "notes.txt"));
}

TEST(RunFolder, files_that_are_of_no_run_are_replaced_only_when_that_is_asked_for) {
  const TestFolder folder;
  const TinyRun run;
  for (const std::string name : {"measures.csv", "forces.sto", "frames/mine_0003.vtp", "fibers/0000.vtp",
                                 "shapes/0001.vtp", "bones/femur_r.vtp"}) {
    const fs::path out = folder.path() / "run";
    fs::create_directories((out / name).parent_path());
    folder.write("run/" + name, "mine");
    for (const ExistingRun existing : {ExistingRun::refuse, ExistingRun::resume}) {
      try {
        RunFolder(out, run.scene, run.poses, existing);
        ADD_FAILURE() << name << " was taken for a run's";
      } catch (const ConfigurationError& error) {
        EXPECT_THAT(error.what(), HasSubstr((out / name).string() + ": is not of a run"));
      }
      EXPECT_EQ(content(out / name), "mine");
      const auto entries = fs::recursive_directory_iterator(out);
      EXPECT_EQ(std::count_if(begin(entries), end(entries), [](const auto& each) { return each.is_regular_file(); }), 1)
          << "nothing was left beside " << name;
    }
    RunFolder(out, run.scene, run.poses, ExistingRun::replace);
    EXPECT_NE(content(out / name), "mine");
    fs::remove_all(out);
  }
}

TEST(RunFolder, what_a_run_leaves_alone_does_not_keep_it_from_a_folder) {
  const TestFolder folder;
  const TinyRun run;
  fs::create_directories(folder.path() / "frames");  // as a run killed before its index leaves it
  folder.write("notes.txt", "mine");
  folder.write("frames/mine.vtp", "mine");
  RunFolder(folder.path(), run.scene, run.poses, ExistingRun::refuse).write_frame(run.record(0));
  EXPECT_EQ(content(folder.path() / "notes.txt"), "mine");
  EXPECT_EQ(content(folder.path() / "frames/mine.vtp"), "mine");
}

TEST(RunFolder, an_interrupted_run_goes_on_after_its_last_whole_frame) {
  const TestFolder folder;
  TinyRun run;
  run.scene.method.contact["muscle"] = "none";
  {
    RunFolder out(folder.path(), run.scene, run.poses, ExistingRun::refuse);
    for (int i = 0; i < 4; ++i) out.write_frame(run.record(i));
  }
  fs::remove(frame_file(folder.path(), "femur_r", 3));  // interrupted while frame 3 was being written
  RunFolder out(folder.path(), run.scene, run.poses, ExistingRun::resume);
  ASSERT_TRUE(out.resume_point());
  EXPECT_EQ(out.resume_point()->before.number, 1);
  EXPECT_EQ(out.resume_point()->last.number, 2);
  EXPECT_TRUE(
      (out.resume_point()->last.muscles[0].points.array() == run.record(2).frame.muscles[0].points.array()).all());
  EXPECT_FALSE(fs::exists(frame_file(folder.path(), "gluteus_maximus_r", 3)));
  out.write_frame(run.record(3));
  EXPECT_EQ(count_of(content(folder.path() / "measures.csv"), "\n"), 5);
}

TEST(RunFolder, an_interrupted_run_goes_on_from_where_contact_is_searched_anew) {
  const TestFolder folder;
  TinyRun run;
  run.scene.method.contact["update_period"] = 2;
  {
    RunFolder out(folder.path(), run.scene, run.poses, ExistingRun::refuse);
    for (int i = 0; i < 4; ++i) out.write_frame(run.record(i));
  }
  {
    RunFolder out(folder.path(), run.scene, run.poses, ExistingRun::resume);
    ASSERT_TRUE(out.resume_point());
    EXPECT_EQ(out.resume_point()->last.number, 2);
    EXPECT_FALSE(fs::exists(frame_file(folder.path(), "femur_r", 3)));
    EXPECT_EQ(count_of(content(folder.path() / "measures.csv"), "\n"), 4);
    for (int i = 3; i < 5; ++i) out.write_frame(run.record(i));
  }
  run.scene.method.contact["update_period"] = 3;
  EXPECT_EQ(RunFolder(folder.path(), run.scene, run.poses, ExistingRun::resume).frame_count(), 5)
      << "nothing of a complete run is dropped";
}

TEST(RunFolder, velocities_are_kept_where_there_are_any) {
  const TestFolder folder;
  const TinyRun run;
  RunFolder out(folder.path(), run.scene, run.poses, ExistingRun::refuse);
  FrameRecord moving = run.record(1);
  moving.frame.muscles[0].velocities = Points::Random(3, 4) / 3;
  out.write_frame(run.record(0));
  out.write_frame(moving);
  EXPECT_EQ(read_frame(folder.path(), run.scene, 0, run.poses[0]).muscles[0].velocities.cols(), 0);
  const Points read = read_frame(folder.path(), run.scene, 1, run.poses[1]).muscles[0].velocities;
  ASSERT_EQ(read.cols(), 4);
  EXPECT_TRUE((read.array() == moving.frame.muscles[0].velocities.array()).all());
}

TEST(RunFolder, resuming_another_scene_is_an_error) {
  const TestFolder folder;
  TinyRun run;
  {
    RunFolder out(folder.path(), run.scene, run.poses, ExistingRun::refuse);
    for (int i = 0; i < 2; ++i) out.write_frame(run.record(i));
  }
  run.scene.muscles[0].surface.vertices = Points::Zero(3, 7);
  EXPECT_THAT(message_of_input_error([&] { RunFolder(folder.path(), run.scene, run.poses, ExistingRun::resume); }),
              HasSubstr("has 4 vertices, but gluteus_maximus_r has 7"));
}

TEST(RunFolder, resuming_another_motion_is_an_error_that_leaves_the_run_alone) {
  const TestFolder folder;
  TinyRun run;
  run.scene.method.contact["muscle"] = "none";  // any frame can be resumed
  {
    RunFolder out(folder.path(), run.scene, run.poses, ExistingRun::refuse);
    for (int i = 0; i < 3; ++i) out.write_frame(run.record(i));
  }
  const std::string measures = content(folder.path() / "measures.csv");
  const std::vector<Pose> poses = run.poses;
  run.poses[1].coordinates[0] += radians(1);
  EXPECT_THAT(message_of_input_error([&] { RunFolder(folder.path(), run.scene, run.poses, ExistingRun::resume); }),
              HasSubstr("measures.csv:3: frame 1 is of another motion"));
  run.poses = poses;
  run.poses[2].time += 0.05;
  EXPECT_THAT(message_of_input_error([&] { RunFolder(folder.path(), run.scene, run.poses, ExistingRun::resume); }),
              HasSubstr("measures.csv:4: frame 2 is of another motion"));
  EXPECT_EQ(content(folder.path() / "measures.csv"), measures);
  EXPECT_EQ(RunFolder(folder.path(), run.scene, poses, ExistingRun::resume).frame_count(), 3);
}

TEST(RunFolder, the_manifest_hashes_every_input) {
  const TestFolder folder;
  const TinyRun run;
  RunFolder out(folder.path(), run.scene, run.poses, ExistingRun::refuse);
  out.write_frame(run.record(0));
  RunManifest manifest;
  manifest.status = "complete";
  manifest.inputs = {folder.write("a.txt", "abc")};
  out.write_manifest(manifest);
  const auto json = nlohmann::json::parse(content(folder.path() / "run.json"));
  EXPECT_EQ(json["inputs"][0]["sha256"], "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(json["frames"], 1);
  EXPECT_EQ(json["status"], "complete");
  EXPECT_TRUE(json["libraries"].contains("VTK"));
}

TEST(RunFolder, a_folder_that_cannot_be_made_is_named) {
  const TinyRun run;
  EXPECT_THAT(message_of_input_error([&] { RunFolder("/proc/run", run.scene, run.poses, ExistingRun::replace); }),
              HasSubstr("/proc/run: cannot be created"));
}
