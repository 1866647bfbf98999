#include <gracilis/methods/registry.hpp>
#include <gracilis/methods/xpbd/settings.hpp>

#include <member_count.hpp>
#include <scenes_for_tests.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

namespace gracilis {
namespace {

using testing::Contains;
using testing::HasSubstr;

template <class Change>
std::vector<std::string> problems_after(Change change) {
  Scene scene = tube_scene();
  change(scene);
  std::vector<std::string> lines;
  for (const Problem& problem : validate_method(scene)) lines.push_back(to_string(problem));
  return lines;
}

#define EXPECT_PROBLEM(change, message) \
  EXPECT_THAT(problems_after([](Scene& s) { change; }), Contains(HasSubstr(message)))

template <class Settings>
std::vector<std::string> keys_of() {
  std::vector<std::string> keys;
  for (const Setting<Settings>& setting : setting_table<Settings>()) keys.emplace_back(setting.key);
  return keys;
}

}  // namespace

TEST(Registry, methods_have_names_of_their_own_and_can_be_made) {
  std::set<std::string_view> names;
  for (const MethodEntry& method : methods()) {
    EXPECT_TRUE(names.insert(method.name).second) << method.name;
    EXPECT_FALSE(method.meaning.empty()) << method.name;
    EXPECT_TRUE(method.make) << method.name;
    EXPECT_EQ(find_method(method.name), &method);
  }
  EXPECT_EQ(find_method("finite-elements"), nullptr);
  EXPECT_EQ(methods().front().name, Scene{}.method.name) << "the default of scenes and of readers";
}

TEST(Registry, every_setting_has_a_key_of_its_own_a_meaning_and_a_default_that_it_accepts) {
  for (const MethodEntry& method : methods())
    for (const auto* table : {&method.settings, &method.contact}) {
      std::set<std::string_view> keys;
      for (const DescribedSetting& setting : *table) {
        EXPECT_TRUE(keys.insert(setting.key).second) << setting.key;
        EXPECT_TRUE(setting.meaning.ends_with('.')) << setting.key;
        EXPECT_TRUE(accepted(setting, setting.default_value)) << setting.key;
      }
    }
}

TEST(Registry, no_setting_of_xpbd_is_forgotten) {
  EXPECT_EQ(setting_table<XpbdSettings>().size(),
            member_count<SolverSettings>() + member_count<DetailSettings>() + member_count<MaterialSettings>() +
                member_count<BoneContactSettings>() + member_count<PredictorSettings>());
  EXPECT_EQ(setting_table<ContactSettings>().size(), member_count<ContactSettings>());
  EXPECT_EQ(setting_table<VirtualEdgeSettings>().size(), member_count<VirtualEdgeSettings>());
  EXPECT_EQ(keys_of<SurfaceContactSettings>(), (std::vector<std::string>{"friction", "cohesion", "update_period"}))
      << "most_motion is the reach";
}

TEST(ValidateMethod, a_good_scene_has_no_problem) {
  EXPECT_THAT(problems_after([](Scene&) {}), testing::IsEmpty());
}

TEST(ValidateMethod, a_method_must_exist) {
  EXPECT_PROBLEM(s.method.name = "finite-elements", "there is no method 'finite-elements'");
}

TEST(ValidateMethod, settings_must_be_the_methods_and_lie_within_their_ranges) {
  EXPECT_PROBLEM(s.muscles[0].settings["iterations"] = 0, "'iterations' must be an integer from 1 to 100000");
  EXPECT_PROBLEM(s.method.settings["gravity"] = 1.0, "'gravity' must be three numbers");
  EXPECT_PROBLEM(s.method.contact["reach"] = 2.0, "contact: 'reach' must be a number from 0 to 0.1 m");
  EXPECT_PROBLEM((s.method.name = "skinning", s.method.settings["iterations"] = 5), "has no setting 'iterations'");
  EXPECT_PROBLEM(s.method.contact["grip"] = 5, "has no setting 'grip'");
}

TEST(ValidateMethod, what_muscles_share_none_has_of_its_own) {
  EXPECT_PROBLEM(s.muscles[0].settings["substeps"] = 2, "'substeps' holds for all muscles together");
}

TEST(ValidateMethod, a_bone_to_slide_on_must_be_there) {
  EXPECT_PROBLEM(s.muscles[0].settings["slide_on_bone"] = "tibia",
                 "muscle 'tube': 'slide_on_bone' names 'tibia', but the scene has no such bone");
}

TEST(ValidateMethod, virtual_edges_must_find_muscles_before_these_touch) {
  EXPECT_PROBLEM((s.method.contact["muscle"] = "virtual-edges", s.method.contact["seed_reach"] = 0.001),
                 "'seed_reach'");
  const auto reaching = [](Scene& s) { s.method.contact["muscle"] = "virtual-edges"; };
  EXPECT_THAT(problems_after(reaching), testing::IsEmpty());
}

TEST(Presets, the_default_preset_changes_nothing) {
  EXPECT_EQ(presets().front().name, "physical");
  EXPECT_TRUE(presets().front().method.settings.empty());
  EXPECT_TRUE(presets().front().method.contact.empty());
}

TEST(Presets, the_published_preset_switches_off_what_this_project_added) {
  const std::optional<Preset> preset = find_preset("thesis-2024");
  ASSERT_TRUE(preset);
  const XpbdSettings settings = with_values(XpbdSettings{}, preset->method.settings);
  EXPECT_EQ(settings.iterations, 70);
  EXPECT_EQ(settings.constraint_time_step, 1);
  EXPECT_EQ(settings.dihedral_stiffness, 1e8);
  EXPECT_TRUE(settings.unit_masses);
  EXPECT_EQ(settings.predictor, Predictor::none);
  EXPECT_FALSE(settings.edge_contact || settings.slack_uptake);
  EXPECT_EQ(settings.dihedral_limit, 0);
  EXPECT_EQ(preset->distance_fields.resolution, 128);
  EXPECT_EQ(with_values(ContactSettings{}, preset->method.contact).muscle, MuscleContact::virtual_edges);
  const VirtualEdgeSettings edges = with_values(VirtualEdgeSettings{}, preset->method.contact);
  EXPECT_EQ(edges.distance, 0.002f);
  EXPECT_EQ(edges.reach, 0.02f);
  EXPECT_EQ(edges.update_period, 5);
  EXPECT_EQ(settings.fiber_direction, FiberDirection::nearest_fiber);
  const ContractionSettings& contraction = preset->contraction;
  EXPECT_FALSE(contraction.spread || contraction.area_scaling || contraction.ramp || contraction.reject_across);
  EXPECT_TRUE(contraction.two_sided);
  EXPECT_EQ(contraction.threshold, 0);
}

TEST(Presets, every_preset_is_of_a_method_that_accepts_it) {
  for (const Preset& preset : presets()) {
    Scene scene = tube_scene();
    scene.method = preset.method;
    EXPECT_THAT(validate_method(scene), testing::IsEmpty()) << preset.name;
  }
}

TEST(Presets, an_unknown_preset_is_none) { EXPECT_FALSE(find_preset("faster")); }

}  // namespace gracilis
