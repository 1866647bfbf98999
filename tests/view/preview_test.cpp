#include <gracilis/core/errors.hpp>
#include <gracilis/io/run/run_folder.hpp>
#include <gracilis/view/pictures/picture_layout.hpp>
#include <gracilis/view/pictures/preview.hpp>

#include <gtest/gtest.h>

#include <filesystem>
#include <random>

using namespace gracilis;

namespace {

TriangleMesh tetrahedron(const Vec3& offset) {
  TriangleMesh mesh;
  mesh.vertices.resize(3, 4);
  mesh.vertices << 0, 0.1, 0, 0, 0, 0, 0.1, 0, 0, 0, 0, 0.1;
  mesh.vertices.colwise() += offset;
  mesh.faces.resize(3, 4);
  mesh.faces << 0, 0, 1, 2, 2, 1, 2, 0, 1, 3, 3, 3;
  return mesh;
}

/// A pelvis in the middle, the right hip beside it at x = -0.1 (x left, y backwards, z up), a femur below.
Scene right_hip() {
  Scene scene;
  scene.name = "hip";
  scene.bodies = {"pelvis", "femur_r"};
  scene.bones = {{"pelvis", 0, tetrahedron(Vec3(0, 0, 0))}, {"femur_r", 1, tetrahedron(Vec3(-0.12, 0, -0.5))}};
  Joint hip;
  hip.child_body = 1;
  hip.frame.translation() << -0.1, 0.03, 0;
  hip.axes = {
      {"hip_flexion_r", Vec3(-1, 0, 0)}, {"hip_adduction_r", Vec3(0, -1, 0)}, {"hip_rotation_r", Vec3(0, 0, 1)}};
  scene.joints = {hip};
  scene.muscles.resize(1);
  scene.muscles[0].name = "gluteus_maximus_r";
  scene.muscles[0].surface = tetrahedron(Vec3(-0.1, 0.1, -0.2));
  return scene;
}

std::vector<Pose> turning(int axis, int frames) {
  std::vector<Pose> poses;
  for (int i = 0; i < frames; ++i) {
    std::vector<Real> coordinates(3, 0.0);
    coordinates[static_cast<std::size_t>(axis)] = radians(i);
    poses.push_back({0.1 * i, coordinates, {RigidTransform::Identity(), RigidTransform::Identity()}});
  }
  return poses;
}

Picture picture_of(const Scene& scene, const std::vector<Pose>& poses) {
  std::vector<Frame> frames;
  for (const int number : preview_frames(poses, static_cast<int>(poses.size()))) {
    frames.push_back({number, poses[static_cast<std::size_t>(number)], {{scene.muscles[0].surface.vertices}}});
  }
  return preview_picture(scene, poses, frames);
}

}  // namespace

TEST(Preview, shows_the_capture_pose_the_farthest_pose_and_the_way_between) {
  std::vector<Pose> there_and_back = turning(0, 41);
  for (int i = 39; i >= 0; --i) there_and_back.push_back(there_and_back[static_cast<std::size_t>(i)]);
  EXPECT_EQ(preview_frames(there_and_back, 81), (std::vector<int>{0, 20, 40}));
  EXPECT_EQ(preview_frames(there_and_back, 11), (std::vector<int>{0, 5, 10}));
  EXPECT_EQ(preview_frames(there_and_back, 1), (std::vector<int>{0}));
  EXPECT_TRUE(preview_frames(there_and_back, 0).empty());
}

TEST(Preview, flexion_is_seen_from_the_side_and_abduction_along_its_own_axis) {
  const Panel flexion = picture_of(right_hip(), turning(0, 31)).panels[0];
  EXPECT_TRUE(flexion.looking.isApprox(Vec3(1, 0, 0)));  // from the subject's right
  EXPECT_TRUE(flexion.up.isApprox(Vec3::UnitZ()));
  EXPECT_NEAR(std::abs(picture_of(right_hip(), turning(1, 31)).panels[0].looking.y()), 1, 1e-12);
  // About the upright axis there would be nothing but the femur's end to see.
  EXPECT_TRUE(picture_of(right_hip(), turning(2, 31)).panels[0].looking.isApprox(Vec3(1, 0, 0)));
}

TEST(Preview, captions_say_the_pose) {
  const Picture picture = picture_of(right_hip(), turning(0, 31));
  ASSERT_EQ(picture.panels.size(), 3u);
  EXPECT_EQ(picture.panels[0].caption, "capture pose");
  EXPECT_EQ(picture.panels[2].caption, "hip flexion r 30°");
}

TEST(Preview, of_a_body_without_bones_or_with_some_about_its_joint_has_the_subjects_own_up) {
  Scene scene = right_hip();
  scene.bones.pop_back();
  EXPECT_EQ(preview_camera(scene, turning(0, 31)).up, scene.axes.superior);
  scene.bones.push_back({"about", 1, tetrahedron(Vec3(-0.15, -0.02, -0.05))});  // the joint is its box's middle
  EXPECT_EQ(preview_camera(scene, turning(0, 31)).up, scene.axes.superior);
  scene.bones.clear();
  EXPECT_EQ(preview_camera(scene, turning(0, 31)).up, scene.axes.superior);
}

TEST(Preview, of_any_scene_can_be_drawn) {
  std::mt19937 generator(7);
  std::normal_distribution<Real> normal;
  std::uniform_int_distribution<int> corner(-1, 1);
  // Half of all directions lie along a frame's axes or diagonals, where they are parallel to others.
  const auto direction = [&](bool plain) {
    Vec3 found = Vec3::Zero();
    while (found.norm() < 0.1)
      found = plain ? Vec3(corner(generator), corner(generator), corner(generator))
                    : Vec3(normal(generator), normal(generator), normal(generator));
    return Vec3(found.normalized());
  };
  for (int i = 0; i < 2000; ++i) {
    Scene scene = right_hip();
    const bool plain = i % 2 == 0;
    scene.bones[1].surface = tetrahedron(Vec3(-0.15, -0.02, -0.05) + 0.2 * (i % 3) * direction(plain));
    if (i % 5 == 0) scene.bones.clear();
    scene.axes.superior = direction(plain);
    scene.axes.anterior = scene.axes.superior.unitOrthogonal();
    for (JointAxis& axis : scene.joints[0].axes) axis.axis = direction(plain);
    const CameraDirection camera = preview_camera(scene, turning(i % 3, 31));
    EXPECT_GT(camera.looking.cross(camera.up).norm(), 0.5) << i;
    EXPECT_NO_THROW(lay_out(picture_of(scene, turning(i % 3, 31)))) << i;
  }
}

TEST(Preview, a_run_folder_gets_its_picture) {
  const std::filesystem::path folder = testing::TempDir() + "preview_run";
  const Scene scene = right_hip();
  const std::vector<Pose> poses = turning(0, 3);
  RunFolder run(folder, scene, poses, ExistingRun::replace);
  for (int i = 0; i < 3; ++i) {
    FrameRecord record;
    record.frame = {i, poses[static_cast<std::size_t>(i)], {{scene.muscles[0].surface.vertices}}};
    run.write_frame(record);
  }
  try {
    write_preview(folder, scene, poses);
    EXPECT_GT(std::filesystem::file_size(folder / "preview.png"), 1000u);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::unsupported) << error.what();
  }
  std::filesystem::remove_all(folder);
}
