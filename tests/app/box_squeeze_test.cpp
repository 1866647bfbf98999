#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/topology.hpp>
#include <gracilis/io/mesh/mesh_reader.hpp>

#include <build_paths.hpp>

#include "app/program.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

/// The published test of a box between two plates, judged by the frames that the program wrote.
namespace gracilis {
namespace {

namespace fs = std::filesystem;

struct SqueezedBox {
  fs::path folder = fs::temp_directory_path() / "gracilis_box_squeeze_test";

  SqueezedBox() { fs::remove_all(folder); }
  ~SqueezedBox() { fs::remove_all(folder); }

  TriangleMesh surface(const std::string& name, int frame) const {
    return read_mesh(folder / "frames" / fmt::format("{}_{:04}.vtp", name, frame), 1);
  }
};

Real mean_edge_ratio(const TriangleMesh& now, const TriangleMesh& rest) {
  const std::vector<MeshEdge> edges = build_topology(rest.faces, rest.vertex_count()).edges;
  Real sum = 0;
  for (const MeshEdge& edge : edges)
    sum += (now.vertices.col(edge.a) - now.vertices.col(edge.b)).norm() /
           (rest.vertices.col(edge.a) - rest.vertices.col(edge.b)).norm();
  return sum / static_cast<Real>(edges.size());
}

/// Vertices beyond the face with which a plate presses, within its outline; `side` is 1 for a plate above.
Index through(const TriangleMesh& box, const TriangleMesh& plate, Real side) {
  const Vec3 low = plate.vertices.rowwise().minCoeff(), high = plate.vertices.rowwise().maxCoeff();
  const Real face = side > 0 ? low.z() : high.z();
  Index count = 0;
  for (Index v = 0; v < box.vertex_count(); ++v) {
    const Vec3 p = box.vertices.col(v);
    const bool over = p.x() > low.x() && p.x() < high.x() && p.y() > low.y() && p.y() < high.y();
    count += over && side * (p.z() - face) > 0;
  }
  return count;
}

}  // namespace

TEST(BoxSqueeze, a_box_pressed_to_a_tenth_stays_between_the_plates_and_comes_back) {
  const SqueezedBox run;
  const ProgramResult result = run_program(std::string("run ") + build_paths::source_folder +
                                           "/scenes/box_squeeze/box_squeeze.toml --out " + run.folder.string());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const TriangleMesh rest = run.surface("box", 0);
  ASSERT_EQ(rest.face_count(), 5292);
  Real least_height = 1;
  for (int frame = 0; frame <= 300; ++frame) {
    const TriangleMesh box = run.surface("box", frame);
    EXPECT_EQ(through(box, run.surface("upper_plate", frame), 1), 0) << "frame " << frame;
    EXPECT_EQ(through(box, run.surface("lower_plate", frame), -1), 0) << "frame " << frame;
    const Vec3 size = box.vertices.rowwise().maxCoeff() - box.vertices.rowwise().minCoeff();
    EXPECT_LT(size.head<2>().maxCoeff(), 0.2) << "not beside the plates, frame " << frame;
    if (frame == 100) least_height = size.z();
  }
  EXPECT_LE(least_height, 0.0101);
  const TriangleMesh end = run.surface("box", 300);
  EXPECT_FALSE(fs::exists(run.folder / "frames" / "box_0301.vtp"));
  EXPECT_NEAR(mean_edge_ratio(end, rest), 1, 0.01);
  EXPECT_NEAR(enclosed_volume(end.vertices, end.faces) / enclosed_volume(rest.vertices, rest.faces), 1, 0.01);
}

}  // namespace gracilis
