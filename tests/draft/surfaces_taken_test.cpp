#include "agreement.hpp"
#include "made_body.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>

/// Which surfaces of a folder are taken, and what is said of the others.
namespace gracilis {

TEST(SurfacesTaken, what_a_run_would_refuse_is_mended_where_that_is_asked_for) {
  const TestFolder folder;
  write_body(folder.path() / "hip", hip(), hip_names, 0.001);
  const TriangleMesh whole = hip().muscles[0].surface;
  TriangleMesh open = whole;
  open.vertices *= 1000;
  open.faces.conservativeResize(3, open.faces.cols() - 10);
  const fs::path file = folder.path() / "hip" / "muscles" / "piriformis_r.vtp";
  write_surface(file, open.vertices, open.faces);
  DraftOptions options;
  options.mended_folder = "beside";
  std::string asked;
  options.mend = [&](const std::string& name, const TriangleMesh& mesh) {
    asked = name;
    EXPECT_LT(mesh.vertices.cwiseAbs().maxCoeff(), 2) << "metres";
    return MendedSurface{whole, {"hole filled"}};
  };
  const SceneDraft draft = draft_scene(folder.path() / "hip", options);
  EXPECT_EQ(asked, "piriformis_r");
  EXPECT_THAT(draft.left_out, testing::IsEmpty());
  const std::string text = draft_text(draft, "scene.toml", {});
  EXPECT_THAT(text, testing::HasSubstr("beside/piriformis_r.vtp\"\n"));
  EXPECT_THAT(text, testing::HasSubstr("piriformis_r: its surface is mended"));
  EXPECT_THAT(text, testing::HasSubstr("# mended, since a run would refuse"));

  options.mend = [](const std::string&, const TriangleMesh&) -> MendedSurface {
    throw InputError({"", "", "encloses nothing", ""});
  };
  EXPECT_THAT(draft_scene(folder.path() / "hip", options).left_out,
              testing::ElementsAre(testing::HasSubstr("nor could it be mended: encloses nothing")));
}

TEST(SurfacesTaken, what_cannot_be_used_is_left_out_and_named) {
  const TestFolder folder;
  write_body(folder.path() / "hip", hip(), hip_names);
  TriangleMesh open = hip().muscles[0].surface;
  open.faces.conservativeResize(3, open.faces.cols() - 10);
  write_surface(folder.path() / "hip" / "muscles" / "piriformis_r.vtp", open.vertices, open.faces);
  write_surface(folder.path() / "hip" / "thing7.vtp", open.vertices, open.faces);
  write_surface(folder.path() / "hip" / "iliofemoral ligament.vtp", open.vertices, open.faces);
  const SceneDraft draft = draft_scene(folder.path() / "hip");
  EXPECT_EQ(draft.muscles.size(), 4u);
  EXPECT_THAT(draft.left_out,
              testing::UnorderedElementsAre(
                  testing::AllOf(testing::HasSubstr("piriformis_r"), testing::HasSubstr("gracilis prepare")),
                  testing::AllOf(testing::HasSubstr("thing7"), testing::HasSubstr("rename")),
                  testing::AllOf(testing::HasSubstr("ligament"), testing::HasSubstr("neither bone nor"))));
}

TEST(SurfacesTaken, what_a_run_takes_with_flaws_is_mended_where_that_is_asked_for_and_cures_them) {
  const TestFolder folder;
  write_body(folder.path() / "hip", hip(), hip_names);
  const TriangleMesh outer = shapes::sphere(Vec3::Zero(), 0.02, 3), inner = shapes::sphere(Vec3::Zero(), 0.015, 3),
                     beside = shapes::sphere(Vec3(0.03, 0, 0), 0.02, 3);
  const TriangleMesh nested = shapes::both(outer, inner), crossing = shapes::both(outer, beside);
  write_surface(folder.path() / "hip" / "muscles" / "piriformis.R.vtp", nested.vertices, nested.faces);
  write_surface(folder.path() / "hip" / "muscles" / "gracilis.R.vtp", crossing.vertices, crossing.faces);
  const auto mended = [&](const MendFunction& mend, const std::string& name) {
    DraftOptions options;
    options.mend = mend;
    for (const FoundMuscle& muscle : draft_scene(folder.path() / "hip", options).found.muscles)
      if (muscle.name == name) return muscle.mended;
    return std::optional<MendedSurface>();
  };
  const MendFunction to_a_ball = [&](const std::string&, const TriangleMesh&) { return MendedSurface{outer}; };
  const MendFunction to_nothing_better = [&](const std::string&, const TriangleMesh& mesh) {
    return MendedSurface{mesh};
  };
  ASSERT_TRUE(mended(to_a_ball, "piriformis_r"));
  EXPECT_EQ(mended(to_a_ball, "piriformis_r")->why, "a closed piece lies in another");
  EXPECT_FALSE(mended(to_a_ball, "piriformis_r")->refused);
  ASSERT_TRUE(mended(to_a_ball, "gracilis_r"));
  EXPECT_THAT(mended(to_a_ball, "gracilis_r")->why, testing::HasSubstr("triangles cut others"));
  EXPECT_FALSE(mended(to_a_ball, "gluteus_maximus_r")) << "nothing is wrong with it";
  EXPECT_FALSE(mended(to_nothing_better, "piriformis_r"));
  EXPECT_FALSE(mended({}, "piriformis_r"));
}

TEST(SurfacesTaken, united_heads_on_bones_that_move_apart_become_muscles_unless_they_are_here_by_themselves) {
  const TestFolder folder;
  write_body(folder.path() / "hip", hip(), hip_names);
  const TriangleMesh left = shapes::sphere(Vec3::Zero(), 0.02, 3), right = shapes::sphere(Vec3(0.03, 0, 0), 0.02, 3),
                     away = shapes::sphere(Vec3(0.05, 0, 0), 0.02, 3);
  const auto put = [&](const std::string& name, const TriangleMesh& mesh) {
    write_surface(folder.path() / "hip" / "muscles" / name, mesh.vertices, mesh.faces);
  };
  put("biceps femoris.R.vtp", shapes::both(left, right));
  put("gastrocnemius.R.vtp", shapes::both(left, right));
  const MendFunction mend = [&](const std::string&, const TriangleMesh&) {
    return MendedSurface{shapes::both(left, away), {"united"}, {left, right}};
  };
  const auto names = [&] {
    std::vector<std::string> all;
    for (const FoundMuscle& muscle : find_surfaces(list_folder(folder.path() / "hip"), "", "", mend).muscles)
      if (muscle.name.starts_with("biceps") || muscle.name.starts_with("gastrocnemius")) all.push_back(muscle.name);
    return all;
  };
  EXPECT_THAT(names(), testing::UnorderedElementsAre("biceps_femoris_1_r", "biceps_femoris_2_r", "gastrocnemius_r"));
  put("biceps femoris long.R.vtp", left);
  put("biceps femoris short.R.vtp", away);
  EXPECT_THAT(names(),
              testing::UnorderedElementsAre("biceps_femoris_long_r", "biceps_femoris_short_r", "gastrocnemius_r"));
}

TEST(SurfacesTaken, files_named_like_those_of_a_scene_are_taken_unless_a_drafted_scene_wrote_them) {
  const TestFolder folder;
  write_body(folder.path() / "hip", hip(), hip_names);
  const TriangleMesh ball = shapes::sphere(Vec3::Zero(), 0.02, 3);
  std::filesystem::create_directory(folder.path() / "hip" / "leg_mended");
  write_surface(folder.path() / "hip" / "leg_mended" / "piriformis.R.vtp", ball.vertices, ball.faces);
  folder.write("hip/leg_landmarks.csv", "HJC;1;2;3\n");
  const auto files = [&] { return list_folder(folder.path() / "hip"); };
  const std::size_t surfaces = files().surfaces.size();
  folder.write("hip/leg.toml", "# By hand.\nschema = 1\n");
  EXPECT_EQ(files().surfaces.size(), surfaces);
  EXPECT_EQ(files().tables.size(), 1u);
  folder.write("hip/leg.toml", std::string(drafted_scene_mark) + " More.\nschema = 1\n");
  EXPECT_EQ(files().surfaces.size(), surfaces - 1);
  EXPECT_EQ(files().tables.size(), 0u);
}

TEST(SurfacesTaken, folders_behind_links_are_looked_into_once_also_where_links_lead_in_a_circle) {
  const TestFolder folder;
  write_body(folder.path() / "hip", hip(), hip_names);
  const std::size_t surfaces = list_folder(folder.path() / "hip").surfaces.size();
  std::filesystem::create_directory(folder.path() / "linked");
  std::filesystem::create_directory_symlink(folder.path() / "hip", folder.path() / "linked" / "hip");
  std::filesystem::create_directory_symlink(folder.path() / "linked", folder.path() / "linked" / "again");
  EXPECT_GT(surfaces, 0u);
  EXPECT_EQ(list_folder(folder.path() / "linked").surfaces.size(), surfaces);
}

/// What is found of a hip with one muscle in two folders.
static FoundFolder found_of_two(const TriangleMesh& as_scanned, const TriangleMesh& mended) {
  const TestFolder folder;
  write_body(folder.path() / "hip", hip(), hip_names);
  const auto write = [&](const char* name, const TriangleMesh& surface) {
    std::filesystem::create_directory(folder.path() / "hip" / name);
    write_surface(folder.path() / "hip" / name / "piriformis.R.vtp", surface.vertices, surface.faces);
  };
  write("as_scanned", as_scanned);
  write("mended", mended);
  return find_surfaces(folder.path() / "hip");
}

static void expect_mended_is_taken(const FoundFolder& found) {
  const auto taken = std::find_if(found.muscles.begin(), found.muscles.end(),
                                  [](const FoundMuscle& each) { return each.name == "piriformis_r"; });
  ASSERT_NE(taken, found.muscles.end());
  EXPECT_EQ(taken->file.parent_path().filename(), "mended");
}

TEST(SurfacesTaken, of_two_surfaces_of_one_name_that_is_taken_which_a_run_takes) {
  TriangleMesh ball = shapes::sphere(Vec3::Zero(), 0.02, 3), open = ball;
  open.faces.conservativeResize(3, open.faces.cols() - 10);
  const FoundFolder found = found_of_two(open, ball);
  expect_mended_is_taken(found);
  EXPECT_THAT(found.left_out, testing::ElementsAre(testing::HasSubstr("piriformis_r is there already, from")));
}

TEST(SurfacesTaken, of_two_surfaces_of_one_name_that_a_run_takes_the_sound_one_is_taken) {
  const TriangleMesh ball = shapes::sphere(Vec3::Zero(), 0.02, 3);
  expect_mended_is_taken(found_of_two(shapes::both(ball, shapes::sphere(Vec3::Zero(), 0.015, 3)), ball));
}

TEST(SurfacesTaken, a_muscle_whose_heads_are_here_is_left_out_and_one_that_only_is_called_like_them_is_not) {
  const TestFolder folder;
  write_body(folder.path() / "hip", hip(), hip_names);
  const auto put = [&](const std::string& name, const TriangleMesh& mesh) {
    write_surface(folder.path() / "hip" / "muscles" / name, mesh.vertices, mesh.faces);
  };
  const TriangleMesh medial = shapes::sphere(Vec3::Zero(), 0.02, 3), away = shapes::sphere(Vec3(0, 0, 0.3), 0.02, 3),
                     lateral = shapes::sphere(Vec3(0.05, 0, 0), 0.02, 3);
  put("gastrocnemius medial.R.vtp", medial);
  put("gastrocnemius lateral.R.vtp", lateral);
  put("gastrocnemius.R.vtp", shapes::both(medial, lateral));
  put("extensor digitorum longus.R.vtp", medial);
  put("extensor digitorum brevis.R.vtp", lateral);
  put("extensor digitorum.R.vtp", away);
  const FoundFolder found = find_surfaces(folder.path() / "hip");
  EXPECT_THAT(found.left_out, testing::ElementsAre(testing::HasSubstr(
                                  "its heads are here, too: gastrocnemius_lateral_r, gastrocnemius_medial_r")));
  const auto has = [&](const std::string& name) {
    return std::any_of(found.muscles.begin(), found.muscles.end(), [&](auto& each) { return each.name == name; });
  };
  EXPECT_FALSE(has("gastrocnemius_r"));
  EXPECT_TRUE(has("gastrocnemius_medial_r"));
  EXPECT_TRUE(has("extensor_digitorum_r"));
}

}  // namespace gracilis
