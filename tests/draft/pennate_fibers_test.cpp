#include <gracilis/draft/draft_text.hpp>
#include <gracilis/draft/pennate_fibers.hpp>

#include <pennate_muscles.hpp>

#include <gtest/gtest.h>

#include <algorithm>

namespace gracilis {
namespace {

const KnownMuscle& known_muscle(const std::string& name) {
  const auto& all = dictionary().muscles;
  return *std::find_if(all.begin(), all.end(), [&](const KnownMuscle& each) { return each.name == name; });
}

/// A made muscle whose fibers are 30 mm long, named so.
struct NamedMuscle {
  FoundMuscle found;
  DraftMuscle draft;

  explicit NamedMuscle(const std::string& name) {
    const PennateMuscle made(false, 0);
    found.name = name + "_r", found.file = "muscle.ply", found.known = &known_muscle(name),
    found.mesh = made.muscle().surface;
    draft.found = &found;
    for (const Attachment& each : made.muscle().attachments) {
      draft.attachments.emplace_back();
      draft.attachments.back().name = each.name, draft.attachments.back().end = each.end;
      draft.attachments.back().vertices = each.vertices;
    }
  }
};

}  // namespace

TEST(PennateFibers, are_guessed_as_long_as_published_for_the_size_and_said_in_the_scene) {
  NamedMuscle muscle("semimembranosus");
  guess_pennation(0.030 / muscle.found.known->fiber_length, muscle.draft);
  ASSERT_TRUE(muscle.draft.pennation);
  EXPECT_NEAR(degrees(*muscle.draft.pennation), 30, 4);
  SceneDraft scene;
  scene.muscles.push_back(muscle.draft);
  const std::string text = draft_text(scene, "scene.toml", "");
  EXPECT_NE(text.find("# guessed: between the belly's broad sides"), std::string::npos) << text;
  EXPECT_NE(text.find("[muscles.fibers]"), std::string::npos) << text;
  EXPECT_NE(text.find("\npennation_deg = "), std::string::npos) << text;
}

TEST(PennateFibers, are_not_guessed_of_muscles_whose_fibers_run_from_end_to_end) {
  NamedMuscle muscle("sartorius");
  guess_pennation(1, muscle.draft);
  EXPECT_FALSE(muscle.draft.pennation);
}

}  // namespace gracilis
