#include "agreement.hpp"
#include "made_body.hpp"

#include "io/glb_parts.hpp"

#include <gracilis/draft/name_search.hpp>
#include <gracilis/geometry/measures.hpp>

#include <gmock/gmock.h>

namespace gracilis {

TEST(FolderOfMadeBody, names_of_people_s_files_are_understood) {
  const auto bone = [](const char* name) {
    const NameMatch<KnownBone> match = find_bone(read_name(name, dictionary().words));
    return match.known ? match.known->name : "";
  };
  const auto muscle = [](const char* name) {
    const NameMatch<KnownMuscle> match = find_muscle(read_name(name, dictionary().words));
    return match.known ? match.known->name : "";
  };
  EXPECT_EQ(bone("Right femur"), "femur");
  EXPECT_EQ(bone("os coxae sinistrum"), "hip_bone");
  EXPECT_EQ(bone("vertebra_L4"), "vertebra_l4");
  EXPECT_EQ(bone("Fifth lumbar vertebra"), "vertebra_l5");
  EXPECT_EQ(bone("(Second metatarsal bone.r)"), "metatarsal_2");
  EXPECT_EQ(muscle("Long head of biceps brachii muscle.l"), "biceps_brachii_long");
  EXPECT_EQ(muscle("m. biceps femoris caput breve"), "biceps_femoris_short");
  EXPECT_EQ(muscle("glmax2_r"), "gluteus_maximus");
  EXPECT_EQ(muscle("(Acromial part of deltoid muscle.r)"), "deltoid_middle");
  EXPECT_EQ(muscle("Peroneus longus"), "fibularis_longus");
  EXPECT_EQ(muscle("Extensor carpi radialis brevis"), "extensor_carpi_radialis_brevis");
  EXPECT_EQ(muscle("gluteusmaximus"), "gluteus_maximus");
  EXPECT_EQ(muscle("semimembranosis"), "semimembranosus");
  EXPECT_EQ(bone("Proximal phalanx of right big toe"), "proximal_phalanges_foot_1");
  EXPECT_EQ(bone("Middle phalanx of second finger of foot.r"), "middle_phalanges_foot_2");
  EXPECT_EQ(bone("Middle phalanx of second finger of hand.r"), "middle_phalanges_hand_2");
  EXPECT_EQ(bone("Distal phalanx of right index finger"), "distal_phalanges_hand_2");
  EXPECT_EQ(bone("Right fifth metatarsal bone"), "metatarsal_5");
  EXPECT_EQ(bone("Third rib.l"), "rib_3");
  EXPECT_EQ(muscle("Lateral head of right gastrocnemius"), "gastrocnemius_lateral");
  EXPECT_EQ(muscle("Humero-ulnar head of flexor digitorum superficialis"), "flexor_digitorum_superficialis");
  EXPECT_EQ(muscle("Sternocostal head of pectoralis major muscle.r"), "pectoralis_major_sternal");
  EXPECT_EQ(muscle("Superior part of right trapezius"), "trapezius");
  EXPECT_EQ(muscle("Flexor hallucis longus.r"), "flexor_hallucis_longus");
  EXPECT_EQ(muscle("Oblique head of adductor hallucis"), "adductor_hallucis");
  EXPECT_EQ(muscle("First dorsal interosseus muscle of foot"), "interossei_foot");
  EXPECT_EQ(muscle("Caput longum musculi bicipitis brachii dextri"), "biceps_brachii_long");
  EXPECT_EQ(muscle("Caput mediale musculi gastrocnemii"), "gastrocnemius_medial");
  EXPECT_EQ(muscle("Pars clavicularis musculi deltoidei"), "deltoid_anterior");
  EXPECT_EQ(muscle("Pars clavicularis musculi pectoralis majoris"), "pectoralis_major_clavicular");
  EXPECT_EQ(muscle("Caput humerale musculi pronatoris teretis"), "pronator_teres");
  EXPECT_EQ(muscle("notes"), "");
  EXPECT_EQ(read_name("femur_l", dictionary().words).side, BodySide::left);
  EXPECT_EQ(read_name("Tibialis anterior.R", dictionary().words).side, BodySide::right);
}

TEST(FolderOfMadeBody, a_bone_that_is_spelled_as_it_should_be_is_no_misspelled_muscle) {
  const TestFolder folder;
  const TriangleMesh ball = shapes::sphere(Vec3::Zero(), 0.01, 1);
  for (const char* name : {"Trapezium.r.vtp", "trapezius_r.vtp"})
    write_surface(folder.path() / name, ball.vertices, ball.faces);
  const FolderFiles files = list_folder(folder.path());
  ASSERT_EQ(files.surfaces.size(), 2u);
  EXPECT_EQ(files.surfaces[0].kind, NamedKind::bone);
  EXPECT_EQ(files.surfaces[1].kind, NamedKind::muscle);
}

TEST(FolderOfMadeBody, every_site_of_the_dictionary_is_a_bone_that_it_knows) {
  const auto known = [](const Site& site) {
    if (site.bone.starts_with("#")) return !dictionary().segment(site.bone.substr(1)).name.empty();
    const bool many = site.bone.ends_with("*");
    const std::string start = many ? site.bone.substr(0, site.bone.size() - 1) : site.bone;
    return std::any_of(dictionary().bones.begin(), dictionary().bones.end(),
                       [&](const KnownBone& bone) { return many ? bone.name.starts_with(start) : bone.name == start; });
  };
  EXPECT_GT(dictionary().muscles.size(), 150u);
  for (const KnownMuscle& muscle : dictionary().muscles)
    for (const std::vector<Site>* sites : {&muscle.origin, &muscle.insertion}) {
      EXPECT_FALSE(sites->empty()) << muscle.name;
      for (const Site& site : *sites) {
        EXPECT_TRUE(known(site)) << muscle.name << " on " << site.bone;
        EXPECT_LT(site.from, site.to) << muscle.name;
      }
    }
  for (const KnownBone& bone : dictionary().bones) dictionary().segment(bone.segment);
}

TEST(FolderOfMadeBody, every_name_of_the_dictionary_finds_itself) {
  for (const KnownMuscle& muscle : dictionary().muscles)
    EXPECT_EQ(find_muscle(read_name(muscle.name, dictionary().words)).known, &muscle) << muscle.name;
  for (const KnownBone& bone : dictionary().bones)
    EXPECT_EQ(find_bone(read_name(bone.name, dictionary().words)).known, &bone) << bone.name;
}

TEST(FolderOfMadeBody, a_hip_in_millimetres_under_latin_and_short_names_becomes_a_scene) {
  const TestFolder folder;
  write_body(folder.path() / "hip", hip(), hip_names, 0.001);
  const LoadedScene drafted = drafted_scene(folder.path() / "hip");
  const Joint& joint = joint_named(drafted.scene, "hip_r");
  EXPECT_LT(joint.frame.translation().norm(), 0.002) << "the head's center is the origin";
  EXPECT_GT(direction(joint, 0).dot(Vec3::UnitZ()), 0.99) << "flexes forward";
  EXPECT_GT(direction(joint, 1).dot(Vec3::UnitX()), 0.99);
  EXPECT_EQ(joint.axes[0].coordinate, "hip_flexion_r");
  const std::vector<EndAgreement> ends = ends_compared(hip(), drafted.scene);
  ASSERT_EQ(ends.size(), 8u);
  for (const EndAgreement& each : ends) {
    EXPECT_TRUE(each.same_body) << each.muscle;
    EXPECT_LT(each.apart, 0.03) << each.muscle << (each.end == AttachmentEnd::origin ? " origin" : " insertion");
  }
  EXPECT_THAT(drafted.scene.motion.coordinates, testing::ElementsAre("hip_flexion_r"));
  EXPECT_THAT(drafted.guessed, testing::Contains(testing::HasSubstr("joint hip_r: a sphere")));
}

TEST(FolderOfMadeBody, a_left_arm_turned_in_its_frame_becomes_a_scene) {
  const TestFolder folder;
  // Mirrored into a left arm, z up and the subject looking along -y, as scanners have it.
  const auto placed = [](const Vec3& p) { return Vec3(p[2], -p[0], p[1]); };
  write_body(folder.path() / "arm", elbow(),
             {{"scapula_r", "scapula_l.vtp"},
              {"humerus_r", "left humerus.vtp"},
              {"ulna_r", "ulna_l.vtp"},
              {"radius_r", "radius_l.vtp"},
              {"brachialis_r", "brachialis_l.vtp"},
              {"biceps_brachii_long_r", "biceps long head L.vtp"},
              {"triceps_brachii_medial_r", "Caput mediale m. tricipitis_ triceps brachii sinister.vtp"}},
             1, placed, true);
  const LoadedScene drafted = drafted_scene(folder.path() / "arm");
  const Joint& joint = joint_named(drafted.scene, "elbow_l");
  EXPECT_EQ(joint.axes[0].coordinate, "elbow_flex_l");
  // Flexion turns the forearm forward, to -y: about the subject's right, -x.
  EXPECT_GT(direction(joint, 0).dot(-Vec3::UnitX()), std::cos(radians(8)));
  EXPECT_LT((joint.frame.translation() - joint.frame.translation()[0] * Vec3::UnitX()).norm(), 0.004)
      << "the axis runs through the origin";
  const Joint& shoulder = joint_named(drafted.scene, "shoulder_l");
  EXPECT_EQ(shoulder.axes[1].coordinate, "arm_add_l");
  EXPECT_GT(direction(shoulder, 1).dot(Vec3::UnitY()), 0.95) << "adduction of a left arm turns about backward";
  const Joint& by_hand = joint_named(elbow(), "shoulder_r");
  EXPECT_LT((shoulder.frame.translation() - placed(by_hand.frame.translation())).norm(), 0.004);
  EXPECT_EQ(drafted.scene.muscles.size(), 3u);
}

TEST(FolderOfMadeBody, a_muscle_of_an_unknown_name_attaches_where_it_touches) {
  const TestFolder folder;
  std::map<std::string, std::string> names = hip_names;
  names["iliacus_r"] = "muscles/object seven.vtp";
  write_body(folder.path() / "hip", hip(), names);
  const LoadedScene drafted = drafted_scene(folder.path() / "hip");
  for (const Muscle& muscle : drafted.scene.muscles) {
    if (muscle.name != "object_seven") continue;
    ASSERT_EQ(muscle.attachments.size(), 2u);
    for (const Attachment& each : muscle.attachments) {
      EXPECT_TRUE(each.guessed);
      EXPECT_EQ(drafted.scene.bodies[static_cast<std::size_t>(each.body)],
                each.end == AttachmentEnd::origin ? "pelvis" : "femur_r");
    }
    return;
  }
  FAIL() << "it is not in the scene";
}

TEST(FolderOfMadeBody, a_right_hip_mirrored_is_a_left_one) {
  const TestFolder folder;
  write_body(folder.path() / "hip", hip(), hip_names);
  DraftOptions options;
  options.mirror = true;
  const LoadedScene right = drafted_scene(folder.path() / "hip"), left = drafted_scene(folder.path() / "hip", options);
  const Joint &of_right = joint_named(right.scene, "hip_r"), &of_left = joint_named(left.scene, "hip_l");
  const Vec3 mirror(1, 1, -1);
  EXPECT_LT((of_left.frame.translation() - mirror.cwiseProduct(of_right.frame.translation())).norm(), 1e-4);
  // Turns are no vectors: what flexes forward on the right does so on the left, what adducts turns the other way.
  EXPECT_GT(direction(of_left, 0).dot(direction(of_right, 0)), 0.9999);
  EXPECT_LT(direction(of_left, 1).dot(direction(of_right, 1)), -0.9999);
  ASSERT_EQ(left.scene.muscles.size(), right.scene.muscles.size());
  for (std::size_t m = 0; m < left.scene.muscles.size(); ++m) {
    const Muscle &a = right.scene.muscles[m], &b = left.scene.muscles[m];
    EXPECT_TRUE(b.name.ends_with("_l")) << b.name;
    EXPECT_LT((mirror.asDiagonal() * a.surface.vertices - b.surface.vertices).cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_GT(enclosed_volume(b.surface.vertices, b.surface.faces), 0);
    for (std::size_t i = 0; i < a.attachments.size(); ++i)
      EXPECT_EQ(a.attachments[i].vertices, b.attachments[i].vertices) << a.name;
  }
}

TEST(FolderOfMadeBody, each_mesh_of_a_glb_is_a_surface_of_its_name) {
  const TestFolder folder;
  std::vector<std::pair<std::string, TriangleMesh>> bones, muscles;
  for (const Bone& bone : hip().bones) bones.emplace_back(bone.name, bone.surface);
  for (const Muscle& muscle : hip().muscles)
    if (muscle.name == "iliacus_r") muscles.emplace_back("Iliacus muscle.R", muscle.surface);
  fs::create_directories(folder.path() / "hip" / "x");
  write_parts(folder.path() / "hip" / "bones.glb", bones);
  write_parts(folder.path() / "hip" / "x" / "muscles.glb", muscles);
  folder.write("hip/damaged.glb", "glTF");
  const SceneDraft draft = draft_scene(folder.path() / "hip");
  EXPECT_THAT(draft.left_out, testing::ElementsAre(testing::HasSubstr("damaged.glb")));
  const Scene scene = drafted_scene(folder.path() / "hip").scene;
  ASSERT_EQ(scene.bones.size(), hip().bones.size());
  ASSERT_EQ(scene.muscles.size(), 1u);
  EXPECT_EQ(scene.muscles[0].name, "iliacus_r");
  EXPECT_EQ(scene.muscles[0].attachments.size(), 2u);
}

TEST(FolderOfMadeBody, a_folder_without_known_bones_is_refused_in_words) {
  const TestFolder folder;
  write_body(folder.path() / "hip", hip(), {{"iliacus_r", "iliacus.vtp"}, {"femur_r", "part_one.vtp"}});
  EXPECT_THAT(message_of_input_error([&] { draft_scene(folder.path() / "hip"); }),
              testing::AllOf(testing::HasSubstr("no bone whose name is known"), testing::HasSubstr("femur_r.ply")));
  EXPECT_THAT(message_of_input_error([&] { draft_scene(folder.path() / "nowhere"); }),
              testing::HasSubstr("cannot be read"));
}

TEST(FolderOfMadeBody, bones_of_no_possible_size_are_refused) {
  const TestFolder folder;
  write_body(folder.path() / "hip", hip(), hip_names, 1 / 2.5);
  EXPECT_THAT(message_of_input_error([&] { draft_scene(folder.path() / "hip"); }),
              testing::HasSubstr("times as large"));
}

TEST(FolderOfMadeBody, a_patch_goes_to_pieces_and_heads_of_its_muscle_or_is_left_out_and_named) {
  const TestFolder folder;
  std::map<std::string, std::string> names = hip_names;
  names["gluteus_medius_r"] = "muscles/gluteus_medius_r_1.vtp";
  write_body(folder.path() / "hip", hip(), names);
  write_patch(folder.path() / "hip" / "patches" / "gluteus_medius_r.vtp", hip(), "gluteus_medius_r");
  write_patch(folder.path() / "hip" / "patches" / "piriformis_r.vtp", hip(), "gluteus_maximus_r");
  const SceneDraft draft = draft_scene(folder.path() / "hip");
  EXPECT_EQ(ends_by_patch(draft, "gluteus_medius_1_r"), 2u);
  EXPECT_THAT(draft.left_out, testing::ElementsAre(testing::AllOf(testing::HasSubstr("patches/piriformis_r.vtp"),
                                                                  testing::HasSubstr("no muscle takes"))));

  names = forearm_names;
  names["scapula_r"] = "scapula_r.vtp";
  names["biceps_brachii_long_r"] = "biceps_brachii_long_r.vtp";
  write_body(folder.path() / "arm", elbow(), names);
  write_patch(folder.path() / "arm" / "patches" / "biceps_brachii_r.vtp", elbow(), "biceps_brachii_long_r");
  EXPECT_GE(ends_by_patch(draft_scene(folder.path() / "arm"), "biceps_brachii_long_r"), 1u);
}

TEST(FolderOfMadeBody, every_end_stands_in_the_scene_s_list_of_guesses) {
  const TestFolder folder;
  write_body(folder.path() / "hip", hip(), hip_names);
  write_patch(folder.path() / "hip" / "patches" / "gluteus_medius_r.vtp", hip(), "gluteus_medius_r");
  const SceneDraft draft = draft_scene(folder.path() / "hip");
  const std::vector<std::string> guessed = drafted_scene(folder.path() / "hip").guessed;
  EXPECT_EQ(ends_by_patch(draft, "gluteus_medius_r"), 2u);
  for (const DraftMuscle& muscle : draft.muscles)
    for (const DraftAttachment& each : muscle.attachments)
      EXPECT_THAT(guessed, testing::Contains(each.guess.subject + ": " + to_string(each.guess)));
}

}  // namespace gracilis
