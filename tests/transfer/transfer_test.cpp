#include "bent_body.hpp"

#include "io/test_files.hpp"

#include <gracilis/core/errors.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/io/scene/scene_reader.hpp>
#include <gracilis/transfer/mirrored_scene.hpp>
#include <gracilis/transfer/transfer_folder.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

/// A template on bones whose owner is known: the template itself, bent.
namespace gracilis {
namespace {

using testing::HasSubstr;

const std::map<std::string, std::string> all_bones = {
    {"hip_bone_r", "Os coxae dextrum.vtp"}, {"sacrum", "sacrum.vtp"}, {"femur_r", "right femur.vtp"}};

/// From where attached vertices should be to where they are: mean, m.
Real attachment_error(const Muscle& made, const Muscle& from, const std::function<Vec3(const Vec3&)>& placed) {
  Real sum = 0;
  Index count = 0;
  for (const Attachment& attachment : from.attachments)
    for (const Index v : attachment.vertices) {
      sum += (made.surface.vertices.col(v) - placed(from.surface.vertices.col(v))).norm();
      ++count;
    }
  return sum / count;
}

TEST(Transfer, bones_of_a_bent_body_are_met_and_muscles_end_where_theirs_do) {
  const TestFolder folder;
  write_bones(folder.path() / "bones", small_hip(), all_bones, bent);
  const Transferred made = transfer(small_hip(), find_surfaces(folder.path() / "bones"), {});
  ASSERT_EQ(made.skeleton.bones.size(), 3u);
  EXPECT_FALSE(made.is_mirrored);
  for (const FittedBone& bone : made.skeleton.bones) {
    EXPECT_LT(bone.registered.fit.to_subject, 0.001);
    EXPECT_LT(bone.registered.fit.to_template, 0.001);
    EXPECT_LT(bone.registered.fit.all, 0.0015) << "nothing may be trimmed away";
  }
  ASSERT_EQ(made.scene.muscles.size(), 2u);
  for (std::size_t m = 0; m < 2; ++m)
    EXPECT_LT(attachment_error(made.scene.muscles[m], small_hip().muscles[m], bent), 0.002)
        << made.scene.muscles[m].name;
  for (const AttachmentFit& each : made.muscles.attachments) EXPECT_TRUE(each.on_bone) << each.attachment;
  ASSERT_EQ(made.scene.joints.size(), 1u);
  EXPECT_LT((made.scene.joints[0].frame.translation() - bent(Vec3::Zero())).norm(), 0.003);

  // What is written reads back as the same and runs.
  const std::vector<std::string> left_out =
      write_transfer_folder(template_of(small_hip()), made, {"0", {}, {}}, folder.path() / "made");
  EXPECT_TRUE(left_out.empty());
  const LoadedScene loaded = read_scene(folder.path() / "made" / "scene.toml");
  ASSERT_EQ(loaded.scene.muscles.size(), 2u);
  EXPECT_EQ(loaded.scene.muscles[0].surface.vertices, made.scene.muscles[0].surface.vertices);
  EXPECT_EQ(loaded.scene.muscles[0].attachments[0].vertices, made.scene.muscles[0].attachments[0].vertices);
  EXPECT_EQ(loaded.scene.motion.values.rows(), small_hip().motion.values.rows());
}

TEST(Transfer, a_left_body_gets_the_template_mirrored_and_bones_that_are_missing_are_named) {
  const TestFolder folder;
  const auto left = [](const Vec3& p) { return bent(Vec3(p.x(), p.y(), -p.z())); };
  write_bones(folder.path(), small_hip(), {{"hip_bone_r", "hip_bone_l.vtp"}, {"femur_r", "femur_l.vtp"}}, left, true);
  TransferOptions options;
  options.volumes["iliacus_l"] = 1e-4;
  const Transferred made = transfer(small_hip(), find_surfaces(folder.path()), options);
  EXPECT_TRUE(made.is_mirrored);
  ASSERT_EQ(made.scene.bones.size(), 2u);
  EXPECT_EQ(made.scene.bones[1].name, "femur_l");
  EXPECT_EQ(made.scene.joints[0].axes[0].coordinate, "hip_flexion_l");
  EXPECT_THAT(made.left_out, testing::ElementsAre("bone sacrum: the subject has none of this name"));
  for (std::size_t m = 0; m < 2; ++m) {
    EXPECT_LT(attachment_error(made.scene.muscles[m], small_hip().muscles[m], left), 0.002);
    EXPECT_THAT(made.scene.muscles[m].name, testing::EndsWith("_l"));
    EXPECT_GT(enclosed_volume(made.scene.muscles[m].surface.vertices, made.scene.muscles[m].surface.faces), 0);
  }
  ASSERT_EQ(made.muscles.muscles[0].muscle, "iliacus_l");
  EXPECT_NEAR(made.muscles.muscles[0].volume, 1e-4, 1e-8);
}

TEST(Transfer, bones_whose_names_are_exchanged_are_told) {
  const TestFolder folder;
  write_bones(folder.path(), small_hip(), {{"hip_bone_r", "femur_r.vtp"}, {"femur_r", "hip_bone_r.vtp"}}, bent);
  try {
    transfer(small_hip(), find_surfaces(folder.path()), {});
    FAIL() << "exchanged names went through";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("their names seem to be exchanged"));
  }
}

TEST(Transfer, other_bones_than_the_templates_are_refused_with_both_lists) {
  const TestFolder folder;
  write_bones(folder.path(), small_hip(), {{"femur_r", "tibia_r.vtp"}}, bent);
  try {
    transfer(small_hip(), find_surfaces(folder.path()), {});
    FAIL() << "a tibia was taken for a hip";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("hip_bone_r"));
    EXPECT_THAT(error.what(), HasSubstr("tibia_r"));
  }
}

TEST(Transfer, bones_that_are_there_but_cannot_be_used_are_named) {
  const TestFolder folder;
  write_bones(folder.path() / "points", small_hip(), {{"hip_bone_r", "hip_bone_r.vtp"}, {"femur_r", "femur_r.vtp"}},
              [](const Vec3&) { return Vec3(0.1, 0.2, 0.3); });
  try {
    find_surfaces(folder.path() / "points");
    FAIL() << "bones without size went through";
  } catch (const InputError& error) {
    ASSERT_EQ(error.problems().size(), 3u);
    EXPECT_THAT(error.problems()[0].what, HasSubstr("can be read"));
    EXPECT_THAT(error.problems()[1].file + error.problems()[1].what, HasSubstr("femur_r.vtp"));
    EXPECT_THAT(error.problems()[2].what, HasSubstr("one point"));
  }
  write_bones(folder.path() / "one", small_hip(), {{"hip_bone_r", "hip_bone_r.vtp"}}, bent);
  write_bones(folder.path() / "one", small_hip(), {{"femur_r", "femur_r.vtp"}},
              [](const Vec3&) { return Vec3(0.1, 0.2, 0.3); });
  try {
    transfer(small_hip(), find_surfaces(folder.path() / "one"), {});
    FAIL() << "a hip without a femur went through";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("femur_r.vtp"));
  }
}

TEST(Transfer, volumes_of_muscles_that_are_not_there_are_refused) {
  const TestFolder folder;
  write_bones(folder.path(), small_hip(), {{"femur_r", "femur_r.vtp"}}, bent);
  TransferOptions options;
  options.volumes["ilacus_r"] = 1e-4;
  EXPECT_THROW(transfer(small_hip(), find_surfaces(folder.path()), options), ConfigurationError);
}

TEST(Transfer, landmarks_far_from_the_bones_are_refused) {
  const TestFolder folder;
  write_bones(folder.path(), small_hip(), {{"hip_bone_r", "hip_bone_r.vtp"}, {"femur_r", "femur_r.vtp"}}, bent);
  const auto refused = [&](const TransferOptions& options) -> std::string {
    try {
      transfer(small_hip(), find_surfaces(folder.path()), options);
    } catch (const ConfigurationError& error) {
      return error.what();
    }
    return "";
  };
  for (const Real far : {30.0, 1e300}) {
    TransferOptions options;
    options.landmarks.of_subject = {{"hip_r", bent(Vec3::Zero())}, {"spine", Vec3(0, far, 0)}};
    EXPECT_THAT(refused(options), AllOf(HasSubstr("--landmarks"), HasSubstr("'spine'"), HasSubstr("unit")));
    options.landmarks = {{{"spine", Vec3(0, far, 0)}}, {{"hip_r", bent(Vec3::Zero())}}};
    EXPECT_THAT(refused(options), AllOf(HasSubstr("--template-landmarks"), HasSubstr("'spine'")));
  }
}

TEST(MirroredScene, twice_is_the_scene_itself_and_flexion_stays_flexion) {
  const Scene& scene = small_hip();
  const Scene once = mirrored_scene(scene), twice = mirrored_scene(once);
  EXPECT_EQ(once.muscles[0].name.back(), 'l');
  EXPECT_LT((once.joints[0].axes[0].axis - scene.joints[0].axes[0].axis).norm(), 1e-12) << "about the right";
  EXPECT_LT((once.joints[0].axes[1].axis + scene.joints[0].axes[1].axis).norm(), 1e-12) << "about the front";
  EXPECT_LT((twice.muscles[0].surface.vertices - scene.muscles[0].surface.vertices).norm(), 1e-12);
  EXPECT_EQ(twice.muscles[0].name, scene.muscles[0].name);
}

TEST(TransferInputs, volumes_come_as_volumes_or_masses) {
  const TestFolder folder;
  const auto volumes = read_volumes(folder.write("v.csv", "muscle,volume_cm3\niliacus_r,120\n"));
  EXPECT_NEAR(volumes.at("iliacus_r"), 120e-6, 1e-12);
  const auto masses = read_volumes(folder.write("m.csv", "muscle,mass_g\niliacus_r,106\n"));
  EXPECT_NEAR(masses.at("iliacus_r"), 1e-4, 1e-12);
  EXPECT_THROW(read_volumes(folder.write("n.csv", "muscle,mass_g\niliacus_r,-1\n")), InputError);
  for (const char* amount : {"1e300", "1e-300"}) try {
      read_volumes(folder.write("p.csv", std::string("muscle,volume_cm3\niliacus_r,") + amount + "\n"));
      FAIL() << amount << " went through";
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(),
                  HasSubstr(std::string("no muscle has a volume of ") + (amount[2] == '-' ? "1e-300" : "1e+300")));
    }
  EXPECT_THROW(read_volumes(folder.write("o.csv", "muscle,mass\niliacus_r,1\n")), InputError);
}

TEST(TransferInputs, landmarks_come_as_a_table_or_as_names) {
  const TestFolder folder;
  const auto table = read_landmark_points(folder.write("l.csv", "cloud,index,x_mm,y_mm,z_mm\nHJC,,1,2,3\n"), 1);
  EXPECT_LT((table.at("HJC") - Vec3(0.001, 0.002, 0.003)).norm(), 1e-12);
  const auto names = read_landmark_points(folder.write("l.toml", "unit = \"mm\"\nhip_r = [1, 2, 3]\n"), 1);
  EXPECT_LT((names.at("hip_r") - Vec3(0.001, 0.002, 0.003)).norm(), 1e-12);
  EXPECT_THROW(read_landmark_points(folder.write("i.toml", "unit = \"inch\"\nhip_r = [1, 2, 3]\n"), 1),
               ConfigurationError);
}

}  // namespace
}  // namespace gracilis
