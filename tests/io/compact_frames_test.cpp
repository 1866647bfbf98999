#include <gracilis/core/errors.hpp>
#include <gracilis/io/mesh/mesh_reader.hpp>
#include <gracilis/io/mesh/mesh_reader_vtp.hpp>
#include <gracilis/io/mesh/vtp_pieces.hpp>
#include <gracilis/io/run/recorded_run.hpp>
#include <gracilis/io/run/run_folder.hpp>
#include <gracilis/io/run/run_size.hpp>
#include <gracilis/io/run/verify_run.hpp>
#include <gracilis/methods/registry.hpp>
#include <gracilis/simulate/fiber_tracker.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <io/test_files.hpp>
#include <io/tiny_run.hpp>
#include <scenes_for_tests.hpp>

#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>

#include <cmath>
#include <limits>

using namespace gracilis;
namespace fs = std::filesystem;

namespace {

/// Writes the same frames in both layouts and opens them.
struct BothLayouts {
  TestFolder folder;
  RecordedRun surfaces, compact;

  template <class Run>
  explicit BothLayouts(const Run& run) {
    surfaces = written(run, "surfaces", RunLayout::surfaces);
    compact = written(run, "compact", RunLayout::compact);
  }
  template <class Run>
  RecordedRun written(const Run& run, const std::string& name, RunLayout layout) const {
    RunFolder out(folder.path() / name, run.scene, run.poses, ExistingRun::refuse, layout);
    for (std::size_t i = 0; i < run.poses.size(); ++i) out.write_frame(run.record(static_cast<int>(i)));
    out.finish();
    RunManifest manifest;
    manifest.status = "complete";
    out.write_manifest(manifest);
    return open_recorded_run(folder.path() / name);
  }
};

/// A tube around a hinge, with fibers that follow it.
struct TubeRun {
  Scene scene = tube_scene();
  std::vector<Pose> poses;
  FiberTracker tracker;
  bool knows_fibers = false;

  TubeRun() : tracker(scene) {
    for (int i = 0; i < 4; ++i) {
      poses.push_back(flexed(scene, radians(10 * i)));
      poses.back().time = 0.1 * i;
    }
  }
  FrameRecord record(int number) const {
    FrameRecord result;
    result.frame = capture_frame(scene, poses[static_cast<std::size_t>(number)]);
    result.frame.number = number;
    Points& points = result.frame.muscles[0].points;
    points.row(0).array() += 0.01 * number * (20 * points.row(2).array()).sin();
    result.fibers = tracker.follow(result.frame);
    if (knows_fibers) {
      result.fibers[0].lines.points.array() += 0.001 * number;
      result.frame.muscles[0].fibers = result.fibers[0].lines;
    }
    result.measures.resize(1);
    return result;
  }
};

std::uintmax_t bytes_in(const fs::path& folder) {
  std::uintmax_t sum = 0;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) sum += entry.file_size();
  return sum;
}

}  // namespace

TEST(CompactFrames, are_read_from_the_disk_once) {
  const BothLayouts runs{TubeRun()};
  const auto read_all = [&](const CompactShapes& shapes) {
    for (const std::string& name : {runs.surfaces.muscles[0], runs.surfaces.bones[0], runs.surfaces.bones[1]})
      for (int frame = 0; frame < 4; ++frame)
        name == runs.surfaces.muscles[0] ? shapes.muscle(name, frame) : shapes.bone(name, frame);
  };
  const CompactShapes shapes(runs.compact.folder);
  read_all(shapes), read_all(shapes);
  EXPECT_EQ(shapes.files_read(), 4);
  const CompactShapes small(runs.compact.folder, 1);  // keeps the last file only
  read_all(small);
  EXPECT_EQ(small.files_read(), 4 + 3 + 3) << "bones stay where they are in frame 0";
}

TEST(CompactFrames, hold_the_same_bits) {
  const BothLayouts runs{TubeRun()};
  ASSERT_EQ(runs.compact.frame_count, 4);
  EXPECT_EQ(runs.compact.bones, runs.surfaces.bones);
  for (int frame = 0; frame < 4; ++frame) {
    for (const std::string& name : {runs.surfaces.muscles[0], runs.surfaces.bones[0], runs.surfaces.bones[1]}) {
      const TriangleMesh a = recorded_surface(runs.surfaces, name, frame),
                         b = recorded_surface(runs.compact, name, frame);
      EXPECT_EQ(a.vertices, b.vertices) << name << " " << frame;
      EXPECT_EQ(a.faces, b.faces);
    }
    const Polylines a = recorded_fibers(runs.surfaces, "tube", frame), b = recorded_fibers(runs.compact, "tube", frame);
    ASSERT_GT(a.count(), 0);
    EXPECT_EQ(a.points, b.points) << frame;
    EXPECT_EQ(a.offsets, b.offsets);
  }
  EXPECT_EQ(recorded_tissue(runs.compact, "tube"), recorded_tissue(runs.surfaces, "tube"));
  EXPECT_FALSE(fs::exists(runs.compact.folder / "fibers/0001.vtp")) << "they follow the surface";
}

TEST(CompactFrames, keep_fibers_that_the_method_knows) {
  TubeRun tube;
  tube.knows_fibers = true;
  const BothLayouts runs{tube};
  EXPECT_EQ(recorded_fibers(runs.compact, "tube", 3).points, recorded_fibers(runs.surfaces, "tube", 3).points);
  EXPECT_EQ(recorded_fibers(runs.compact, "femur", 3).count(), 0);
}

TEST(CompactFrames, are_few_and_small_and_VTK_reads_them) {
  const BothLayouts runs{TubeRun()};
  EXPECT_LT(2 * bytes_in(runs.compact.folder / "shapes"),
            bytes_in(runs.surfaces.folder / "frames") + bytes_in(runs.surfaces.folder / "fibers"));
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(shapes_file(runs.compact.folder, 2).c_str());
  reader->Update();
  const TriangleMesh tube = recorded_surface(runs.compact, "tube", 2);
  ASSERT_EQ(reader->GetOutput()->GetNumberOfPoints(), tube.vertex_count());
  EXPECT_EQ(reader->GetOutput()->GetNumberOfPolys(), tube.face_count());
  double point[3];
  reader->GetOutput()->GetPoint(3, point);
  EXPECT_EQ(point[0], tube.vertices(0, 3));
}

TEST(CompactFrames, of_several_muscles_are_one_data_set_with_a_number_per_muscle) {
  const TestFolder folder;
  const fs::path path = folder.path() / "a.vtp";
  const TriangleMesh one = tetrahedron(Vec3::Zero()), other = tetrahedron(Vec3(1, 2, 3));
  write_vtp_pieces(path, {{"one", one.vertices, one.faces}, {"other", other.vertices, other.faces}},
                   {{"numbers", Eigen::VectorXd(Eigen::Vector3d(1, 2, 3))}});
  EXPECT_EQ(read_vtp_piece(VtpFile(path), "other").vertices, other.vertices);
  EXPECT_EQ(VtpFile(path).field("numbers"), (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(read_mesh(path, 1).vertex_count(), 8);
  EXPECT_FALSE(VtpFile(path).has("third"));
  EXPECT_THROW(read_vtp_piece(VtpFile(path), "third"), InputError);
}

TEST(CompactFrames, a_run_of_them_is_found_unchanged_and_every_change_is_found) {
  const BothLayouts runs{TubeRun()};
  EXPECT_THAT(verify_run(runs.compact.folder).findings, testing::IsEmpty());
  write_surface(bone_file(runs.compact.folder, runs.compact.bones[0]), Points::Zero(3, 3),
                Eigen::Matrix3Xi::Zero(3, 1));
  EXPECT_THAT(verify_run(runs.compact.folder).findings, testing::Contains(testing::HasSubstr("has changed")));
}

TEST(CompactFrames, a_run_goes_on_in_its_layout_and_one_of_the_other_replaces_it) {
  const TestFolder folder;
  TinyRun run;
  run.scene.method.contact["muscle"] = "none";  // any frame can be resumed
  {
    RunFolder out(folder.path(), run.scene, run.poses, ExistingRun::refuse, RunLayout::compact);
    for (int i = 0; i < 4; ++i) out.write_frame(run.record(i));
  }
  fs::remove(shapes_file(folder.path(), 3));
  {
    const RunFolder out(folder.path(), run.scene, run.poses, ExistingRun::resume);
    EXPECT_EQ(out.frame_count(), 3);
    EXPECT_EQ(layout_of(folder.path()), RunLayout::compact);
  }
  RunFolder out(folder.path(), run.scene, run.poses, ExistingRun::replace);
  out.write_frame(run.record(0));
  EXPECT_EQ(layout_of(folder.path()), RunLayout::surfaces);
  EXPECT_FALSE(fs::exists(folder.path() / "shapes"));
  EXPECT_FALSE(fs::exists(folder.path() / "bones"));
  EXPECT_EQ(count_frames(folder.path(), run.scene), 1);
}

TEST(CompactFrames, of_fewer_vertices_than_frame_0_carry_no_fibers) {
  const BothLayouts runs{TubeRun()};
  const TriangleMesh few = tetrahedron(Vec3::Zero());
  write_vtp_pieces(shapes_file(runs.compact.folder, 2), {{"tube", few.vertices, few.faces}});
  EXPECT_THAT(message_of_input_error([&] { recorded_fibers(runs.compact, "tube", 2); }),
              testing::HasSubstr("shapes/0002.vtp: has 4 vertices, but frame 0 has"));
}

TEST(CompactFrames, with_numbers_that_are_not_finite_are_refused) {
  const BothLayouts runs{TubeRun()};
  TriangleMesh tube = recorded_surface(runs.compact, "tube", 2);
  const std::string bone = runs.compact.bones[0];
  tube.vertices(1, 3) = std::nan("");
  write_vtp_pieces(shapes_file(runs.compact.folder, 2), {{"tube", tube.vertices, tube.faces}},
                   {{"motion_of_" + bone, Eigen::VectorXd::Constant(12, std::numeric_limits<Real>::infinity())}});
  const RecordedRun run = open_recorded_run(runs.compact.folder);
  EXPECT_THAT(message_of_input_error([&] { recorded_surface(run, "tube", 2); }),
              testing::HasSubstr("shapes/0002.vtp: has a vertex that is not finite"));
  EXPECT_THAT(message_of_input_error([&] { recorded_surface(run, bone, 2); }),
              testing::HasSubstr("shapes/0002.vtp: has a motion of " + bone + " that is not finite"));
}

TEST(VtpLines, of_fewer_than_two_points_out_of_turn_or_not_finite_are_refused) {
  const TestFolder folder;
  const auto refused = [&](const Points& points, const std::vector<Index>& offsets) {
    write_vtp_pieces(folder.path() / "a.vtp", {{"a", points, Eigen::Matrix3Xi(3, 0), offsets}});
    return message_of_input_error([&] { read_vtp_lines(folder.path() / "a.vtp", "a"); });
  };
  Points points = Points::Random(3, 4);
  EXPECT_THAT(refused(points, {0, 1, 4}), testing::HasSubstr("a.vtp:a: has a line of 1 points"));
  EXPECT_THAT(refused(points, {0, 0, 4}), testing::HasSubstr("has a line of 0 points"));
  EXPECT_THAT(refused(points, {0, 2}), testing::HasSubstr("do not go through its points in turn"));
  points(2, 1) = std::nan("");
  EXPECT_THAT(refused(points, {0, 4}), testing::HasSubstr("has a point that is not finite"));
  const fs::path file = folder.write(
      "b.vtp",
      "<VTKFile type=\"PolyData\"><PolyData><Piece Name=\"a\" NumberOfPoints=\"2\" NumberOfLines=\"1\">\n"
      "<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 1 1"
      "</DataArray></Points>"
      "<Lines><DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">0 7</DataArray>"
      "<DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">2</DataArray></Lines></Piece></PolyData>"
      "</VTKFile>");
  EXPECT_THAT(message_of_input_error([&] { read_vtp_lines(file, "a"); }),
              testing::HasSubstr("b.vtp:a: has lines that do not go through its points in turn"));
}

TEST(RunSize, of_compact_frames_has_fibers_in_each_where_the_method_moves_them) {
  for (const MethodEntry& entry : methods()) {
    Scene scene = tube_scene();
    scene.method = {std::string(entry.name), {}, {}};
    const auto bytes = [&](int frames, bool with_fibers) {
      return estimated_size(scene, frames, with_fibers, RunLayout::compact).bytes;
    };
    const double of_frame = bytes(3, true) - bytes(2, true) - (bytes(3, false) - bytes(2, false));
    const auto method = make_method(scene, [](const DistanceFieldSettings&) { return tube_fields(); });
    const auto moved = static_cast<double>(frame_of(*method, flexed(scene, 0), 0).muscles[0].fibers.points.cols());
    const double followed = scene.muscles[0].fibers.count * (scene.muscles[0].fibers.segments + 1.0);
    if (moved > 0)
      EXPECT_NEAR(of_frame / (24 * moved), 1.3, 0.3) << entry.name;
    else
      EXPECT_LT(of_frame, 24 * followed / 3) << entry.name;
  }
}

TEST(RunSize, is_about_what_frames_take) {
  const TubeRun tube;
  const BothLayouts runs{tube};
  const double surfaces =
      static_cast<double>(bytes_in(runs.surfaces.folder / "frames") + bytes_in(runs.surfaces.folder / "fibers"));
  EXPECT_NEAR(estimated_size(tube.scene, 4, true).bytes / surfaces, 1, 0.3);
  EXPECT_EQ(estimated_size(tube.scene, 4, true).files, 4 * 4);
  EXPECT_GE(estimated_size(tube.scene, 4, true, RunLayout::compact).bytes,
            static_cast<double>(bytes_in(runs.compact.folder / "shapes")));
  EXPECT_EQ(size_text(8.13e9), "8.1 GB");
  EXPECT_EQ(duration_text(540), "9 min");
}
