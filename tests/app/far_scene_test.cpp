#include <gracilis/io/mesh/mesh_reader.hpp>
#include <gracilis/io/mesh/mesh_writer.hpp>
#include <gracilis/io/run/run_folder.hpp>

#include "app/program.hpp"
#include "io/scene_folder.hpp"
#include "moved_scenes.hpp"
#include "scenes_for_tests.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace gracilis {
namespace {

/// Runs of the tube (scenes_for_tests.hpp) that stands anywhere.
class FarScene : public testing::Test {
 protected:
  FarScene() { setenv("XDG_CACHE_HOME", folder.path("cache").c_str(), 1); }

  /// The folder of a run of the tube scene shifted by `by`.
  std::filesystem::path run_at(const std::string& name, const Vec3& by) const {
    Scene scene = tube_scene();
    Points& vertices = scene.muscles[0].surface.vertices;
    // Of a muscle as wide as thick rounding would decide which way is which.
    vertices.row(1) *= 1.5;
    for (Index v = 0; v < vertices.cols(); ++v) vertices.col(v) += 0.0002 * Vec3(1 + std::sin(1.7 * v), 0, 0);
    scene = moved(RigidTransform(Eigen::Translation3d(by)), scene);
    const std::filesystem::path scene_file = folder.write(name + "/scene.toml", text(by));
    for (const Bone& bone : scene.bones)
      write_surface(folder.path(name + "/" + bone.name + ".vtp"), bone.surface.vertices, bone.surface.faces);
    const TriangleMesh& tube = scene.muscles[0].surface;
    write_surface(folder.path(name + "/tube.vtp"), tube.vertices, tube.faces);
    const std::filesystem::path out = folder.path(name + "_run");
    const ProgramResult result = run_program("run " + scene_file.string() + " --out " + out.string());
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return out;
  }

  static Points recorded(const std::filesystem::path& run, const std::string& name) {
    return read_mesh(frame_file(run, name, 12), 1).vertices;
  }

  SceneFolder folder;

 private:
  static std::string point(const Vec3& p) { return fmt::format("[{}, {}, {}]", p.x(), p.y(), p.z()); }

  static std::string text(const Vec3& by) {
    return "schema = 1\nname = \"tube\"\n"
           "[[bones]]\nname = \"upper\"\nfile = \"upper.vtp\"\n[[bones]]\nname = \"lower\"\nfile = \"lower.vtp\"\n"
           "[[joints]]\nname = \"hinge\"\nparent = \"upper\"\nchild = \"lower\"\ncenter = " +
           point(by + Vec3(-0.015, 0, 0)) +
           "\n[[joints.axes]]\ncoordinate = \"flexion\"\naxis = [0, 1, 0]\nrange_deg = [0, 120]\n"
           "[[muscles]]\nname = \"tube\"\nfile = \"tube.vtp\"\n" +
           attachment("top", "origin", "upper", by + Vec3(0.0255, 0, 0.08)) +
           attachment("bottom", "insertion", "lower", by + Vec3(0.0255, 0, -0.08)) +
           "[motion]\ncoordinates = [\"flexion\"]\nkey_poses_deg = [[0], [24]]\nstep_deg = 2\n";
  }

  static std::string attachment(const char* name, const char* end, const char* body, const Vec3& at) {
    return fmt::format("[[muscles.attachments]]\nname = \"{}\"\nend = \"{}\"\nbody = \"{}\"\npoints_mm = [{}]\n", name,
                       end, body, point(1000 * at)) +
           "landmark_distance_mm = 20\n";
  }
};

TEST_F(FarScene, is_run_and_written_as_at_the_origin) {
  const Vec3 far_off(5000.3, -3000.7, 8000.1);
  const std::filesystem::path near = run_at("near", Vec3::Zero()), away = run_at("far", far_off);
  EXPECT_GT((recorded(near, "tube") - tube_scene().muscles[0].surface.vertices).colwise().norm().maxCoeff(), 0.01);
  for (const char* name : {"tube", "lower"})
    EXPECT_LT((recorded(away, name) - (recorded(near, name).colwise() + far_off)).colwise().norm().maxCoeff(), 1e-5)
        << name;
}

}  // namespace
}  // namespace gracilis
