#include "scenario_runs.hpp"

#include <gracilis/anatomy/joints/joint_pose.hpp>
#include <gracilis/anatomy/joints/joint_twists.hpp>
#include <gracilis/geometry/polylines.hpp>
#include <gracilis/io/scene/field_cache.hpp>
#include <gracilis/strings/string_arms.hpp>

#include <algorithm>
#include <numeric>

/// Moment arms that strings know, on the real hip, beside differences of strings at rest.
namespace gracilis {
namespace {

std::vector<Real> lengths_of(const strings::MuscleStrings& muscle, const Points& places) {
  std::vector<Real> lengths;
  for (Index s = 0; s < muscle.strings; ++s)
    lengths.push_back(polyline_length(places.middleCols(muscle.node(s, 0), muscle.nodes)));
  return lengths;
}

}  // namespace

TEST(StringArmsOfTheHip, are_those_of_differences) {
  SKIP_WITHOUT_DATA();
  const Scene scene = cadaver_scene("flexion_60", {}, {"method=strings"});
  const std::vector<DistanceField> fields = cached_bone_fields(scene, strings::far_field_settings());
  const strings::BoneDistances bones = strings::bone_distances(scene, fields);
  constexpr Real step = radians(0.1);
  // Where the differences to both sides are further apart than an arm changes over a step, a string nearby snapped or
  // touched a bone in between: the middle of both is then off either by half as much, and tells no derivative.
  constexpr Real close = 1e-4, same = 2 * close;
  for (const Muscle& muscle : scene.muscles) {
    const auto made = strings::muscle_strings(scene, muscle, bones, {});
    ASSERT_TRUE(made) << muscle.name;
    strings::StringState state = strings::capture_state(*made, scene.bodies.size());
    Index strings = 0, doubtful = 0, compared = 0, near = 0;
    for (const Real angle : {8.0, 32.0, 56.0}) {
      std::vector<Real> at = capture_coordinates(scene);
      at[0] = radians(angle);
      follow(*made, bones, pose_at(scene, at), state);
      const FiberActions actions = string_actions(*made, bones, state, joint_twists(scene, at));
      strings::StringState settled = state;
      settle(*made, bones, settled);
      const std::vector<Real> here = lengths_of(*made, settled.places);
      std::vector<Real> ends[2];
      for (int side : {0, 1}) {
        std::vector<Real> beside = at;
        beside[0] += side == 0 ? -step : step;
        strings::StringState moved = settled;
        follow(*made, bones, pose_at(scene, beside), moved);
        settle(*made, bones, moved);
        ends[side] = lengths_of(*made, moved.places);
      }
      Real sum = 0, kept = 0;
      for (std::size_t s = 0; s < ends[0].size(); ++s) {
        ++strings, doubtful += actions.doubtful[s];
        const bool smooth = std::abs(ends[0][s] + ends[1][s] - 2 * here[s]) < same * step;
        if (actions.doubtful[s] || !smooth) continue;
        ++compared;
        const Real off = actions.arms(static_cast<Index>(s), 0) + (ends[1][s] - ends[0][s]) / (2 * step);
        near += std::abs(off) < close;
        sum += off, ++kept;
      }
      EXPECT_LT(std::abs(sum) / kept, close) << muscle.name << " at " << angle;
    }
    EXPECT_LT(doubtful, strings / 8) << muscle.name;
    EXPECT_GT(compared, 2 * strings / 3) << muscle.name;
    EXPECT_GT(near, 95 * compared / 100) << muscle.name;
  }
}

namespace {

/// The leg's gluteus maximus from extension to 60 degrees of flexion.
struct Flexed {
  std::vector<Real> lengths, arms;  ///< means, every 3 degrees
  std::ptrdiff_t doubtful = 0;      ///< strings, at most
};

constexpr Real flexion_step = radians(3);

Flexed flexed_gluteus(const std::filesystem::path& file, const strings::StringSettings& settings) {
  SceneOptions options;
  options.data = file.parent_path();
  options.set = {"method=strings"};
  options.only = {"gluteus_maximus_r"};
  const Scene scene = read_scene(file, options).scene;
  const std::vector<DistanceField> fields = cached_bone_fields(scene, strings::far_field_settings());
  const strings::BoneDistances bones = strings::bone_distances(scene, fields);
  const strings::MuscleStrings made = strings::muscle_strings(scene, scene.muscles[0], bones, settings).value();
  strings::StringState state = strings::capture_state(made, scene.bodies.size());
  Flexed result;
  for (int i = 0; i <= 20; ++i) {
    std::vector<Real> at = capture_coordinates(scene);
    at[0] = flexion_step * i;
    follow(made, bones, pose_at(scene, at), state);
    const std::vector<Real> fibers = lengths_of(made, state.places);
    result.lengths.push_back(std::accumulate(fibers.begin(), fibers.end(), Real{0}) / static_cast<Real>(fibers.size()));
    const FiberActions actions = string_actions(made, bones, state, joint_twists(scene, at));
    result.arms.push_back(actions.mean_arms[0]);
    result.doubtful = std::max(result.doubtful, std::count(actions.doubtful.begin(), actions.doubtful.end(), 1));
  }
  return result;
}

void expect_arms_follow_lengths(const Flexed& flexed) {
  for (std::size_t i = 1; i + 1 < flexed.arms.size(); ++i)
    EXPECT_NEAR(flexed.arms[i], (flexed.lengths[i - 1] - flexed.lengths[i + 1]) / (2 * flexion_step), 1.5e-3)
        << 3 * i << " degrees";
}

}  // namespace

TEST(StringArmsOfTheLeg, of_a_muscle_far_from_bones_come_to_rest_but_for_single_ones) {
  const std::filesystem::path file = data_folder() / "leg/leg.toml";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "there is no " << file;
  const Flexed flexed = flexed_gluteus(file, {});
  EXPECT_LE(flexed.doubtful, 1) << "of 48";
  expect_arms_follow_lengths(flexed);
}

TEST(StringArmsOfTheLeg, have_a_mean_that_follows_mean_lengths_where_many_fibers_are_doubtful_too) {
  const std::filesystem::path file = data_folder() / "leg/leg.toml";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "there is no " << file;
  strings::StringSettings settings;
  settings.support_reach = 10;  // strings 50 mm off then go to and fro where the nearest point of their bone jumps
  const Flexed flexed = flexed_gluteus(file, settings);
  EXPECT_GT(flexed.doubtful, 5) << "else this shows nothing";
  expect_arms_follow_lengths(flexed);
}

}  // namespace gracilis
