#include "agreement.hpp"
#include "drafted_scene.hpp"

#include <fmt/format.h>

/// Folders of scanned and modelled bodies against the scenes that were written for them by hand.
namespace gracilis {
namespace {

namespace fs = std::filesystem;

void copy_into(const fs::path& from, const fs::path& to) {
  fs::create_directories(to);
  for (const fs::directory_entry& entry : fs::directory_iterator(from))
    if (entry.is_regular_file()) fs::copy_file(entry.path(), to / entry.path().filename());
}

/// The scenes compared, told as a table where somebody asks for it.
struct Compared {
  std::vector<EndAgreement> ends;
  std::vector<JointAgreement> joints;
  std::size_t on_muscles = 0;  ///< ends that were drafted so

  Compared(const Scene& by_hand, const Scene& drafted)
      : ends(ends_compared(by_hand, drafted)),
        joints(joints_compared(by_hand, drafted)),
        on_muscles(drafted.muscle_bodies.size()) {
    if (!std::getenv("GRACILIS_TELL")) return;
    for (const EndAgreement& each : ends)
      fmt::print("{:28} {:9} {:5} by hand {:5} drafted {:3.0f} % common, {:5.1f} mm apart{}\n", each.muscle,
                 each.end == AttachmentEnd::origin ? "origin" : "insertion", each.by_hand, each.drafted,
                 100 * each.share(), 1000 * each.apart, each.same_body ? "" : ", other body");
    for (const JointAgreement& each : joints) {
      fmt::print("{:28} {:.1f} mm apart, {:.1f} mm from the axis, turned by", each.joint, 1000 * each.apart,
                 1000 * each.from_axis);
      for (const Real angle : each.angles) fmt::print(" {:.1f}", degrees(angle));
      fmt::print(" degrees\n");
    }
  }

  /// Ends that somebody would have to correct: on another body, or elsewhere.
  std::vector<std::string> wrong(Real apart) const {
    std::vector<std::string> names;
    for (const EndAgreement& each : ends)
      if (!each.same_body || each.apart > apart)
        names.push_back(each.muscle + (each.end == AttachmentEnd::origin ? " origin" : " insertion"));
    return names;
  }
};

Compared leg_compared(const TestFolder& folder, bool with_patches) {
  const fs::path leg = data_root() / "leg";
  copy_into(leg / "bones", folder.path() / "leg" / "bones");
  copy_into(leg / "muscles", folder.path() / "leg" / "muscles");
  copy_into(leg / "leg_mended", folder.path() / "leg" / "muscles");
  if (with_patches) copy_into(leg / "patches", folder.path() / "leg" / "patches");
  return {read_scene(leg / "leg.toml").scene, drafted_scene(folder.path() / "leg").scene};
}

Compared hip_compared(const TestFolder& folder, bool with_landmarks) {
  const fs::path hip = data_root() / "lhdl-hip";
  copy_into(hip / "clean", folder.path() / "hip");
  if (with_landmarks)
    fs::copy_file(hip / "attachment_landmarks.csv", folder.path() / "hip" / "attachment_landmarks.csv");
  SceneOptions options;
  options.data = data_root();
  const fs::path by_hand = fs::path(build_paths::source_folder) / "scenes" / "lhdl_hip" / "flexion.toml";
  return {read_scene(by_hand, options).scene, drafted_scene(folder.path() / "hip").scene};
}

constexpr Real elsewhere = 0.025;  // m: about as far as a hand would move an end

TEST(FolderOfData, the_leg_is_as_by_hand_but_for_four_ends) {
  GRACILIS_NEEDS_DATA("leg/leg.toml");
  const Compared compared = leg_compared(TestFolder(), true);
  EXPECT_EQ(compared.ends.size(), 52u);
  EXPECT_LE(compared.wrong(elsewhere).size(), 4u) << fmt::format("{}", fmt::join(compared.wrong(elsewhere), ", "));
  ASSERT_EQ(compared.joints.size(), 2u);
  EXPECT_LT(compared.joints[0].apart, 0.003);
  EXPECT_LT(compared.joints[1].from_axis, 0.006);
  for (const JointAgreement& each : compared.joints) EXPECT_LT(each.angles[0], radians(8)) << each.joint;
}

TEST(FolderOfData, the_leg_without_patches_is_as_by_hand_but_for_four_ends) {
  GRACILIS_NEEDS_DATA("leg/leg.toml");
  const Compared compared = leg_compared(TestFolder(), false);
  EXPECT_EQ(compared.ends.size(), 52u);
  EXPECT_EQ(compared.on_muscles, 0u) << "all its muscles reach their bones";
  EXPECT_LE(compared.wrong(elsewhere).size(), 4u) << fmt::format("{}", fmt::join(compared.wrong(elsewhere), ", "));
}

TEST(FolderOfData, the_cadaver_hip_is_as_by_hand) {
  GRACILIS_NEEDS_DATA("lhdl-hip/clean/femur_r.ply");
  const Compared compared = hip_compared(TestFolder(), true);
  EXPECT_EQ(compared.ends.size(), 10u);
  EXPECT_LE(compared.wrong(0.01).size(), 1u) << fmt::format("{}", fmt::join(compared.wrong(0.01), ", "));
  ASSERT_EQ(compared.joints.size(), 1u);
  EXPECT_LT(compared.joints[0].apart, 0.003);
  for (const Real angle : compared.joints[0].angles) EXPECT_LT(angle, radians(12));
}

TEST(FolderOfData, the_cadaver_hip_without_landmarks_is_as_by_hand_but_for_the_missing_spine) {
  GRACILIS_NEEDS_DATA("lhdl-hip/clean/femur_r.ply");
  const Compared compared = hip_compared(TestFolder(), false);
  EXPECT_LE(compared.wrong(elsewhere).size(), 2u) << fmt::format("{}", fmt::join(compared.wrong(elsewhere), ", "));
}

void copy_elbow(const TestFolder& folder) {
  const fs::path elbow = data_root() / "elbow";
  copy_into(elbow / "prepared", folder.path() / "elbow");
  for (const char* bone : {"humerus.ply", "radius.ply", "ulna.ply"})
    fs::copy_file(elbow / bone, folder.path() / "elbow" / bone);
}

TEST(FolderOfData, the_elbow_is_as_by_hand) {
  GRACILIS_NEEDS_DATA("elbow/elbow.toml");
  const TestFolder folder;
  copy_elbow(folder);
  const Compared compared(read_scene(data_root() / "elbow" / "elbow.toml").scene,
                          drafted_scene(folder.path() / "elbow").scene);
  EXPECT_EQ(compared.ends.size(), 8u);
  EXPECT_LE(compared.wrong(elsewhere).size(), 1u) << fmt::format("{}", fmt::join(compared.wrong(elsewhere), ", "));
  ASSERT_EQ(compared.joints.size(), 1u);
  EXPECT_LT(compared.joints[0].from_axis, 0.006);
  EXPECT_LT(compared.joints[0].angles[0], radians(10));
}

/// README.md of the data: "Short head of biceps ends on the long one, 37 mm above the radius".
TEST(FolderOfData, of_the_elbow_only_the_short_head_lies_on_another_muscle) {
  GRACILIS_NEEDS_DATA("elbow/elbow.toml");
  const TestFolder folder;
  copy_elbow(folder);
  const Scene scene = drafted_scene(folder.path() / "elbow").scene;
  ASSERT_EQ(scene.muscle_bodies.size(), 1u);
  EXPECT_EQ(scene.bodies[static_cast<std::size_t>(scene.muscle_bodies[0].body)],
            "biceps_brachii_short_r_on_biceps_brachii_long_r");
}

}  // namespace
}  // namespace gracilis
