#include <gracilis/core/errors.hpp>
#include <gracilis/methods/registry.hpp>
#include <gracilis/simulate/run.hpp>

#include <gracilis/core/state_hash.hpp>
#include <scenes_for_tests.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace gracilis {
namespace {

/// Moves the muscle by 1 mm per frame, and breaks when told to.
class Stepping final : public DeformationMethod {
 public:
  explicit Stepping(const Scene& scene, int breaks_at = -1)
      : rest_(scene.muscles[0].surface.vertices), breaks_at_(breaks_at) {}

  void reset() override { ++resets, steps_ = 0; }
  StepReport advance(const Pose&, Real time_step) override {
    time_steps.push_back(time_step);
    if (steps_ + 1 == breaks_at_) throw QualityError("muscle tube: a vertex position is not finite");
    ++steps_;
    return {{MuscleReport{}}};
  }
  void write(Frame& frame) const override { frame.muscles = {{rest_.colwise() + Vec3(0.001 * steps_, 0, 0)}}; }
  void restore(const std::vector<Pose>&, const Frame&, const Frame& last) override { steps_ = last.number; }

  std::vector<FiberActions> fiber_actions(const std::vector<std::vector<Twist>>& coordinates) const override {
    FiberActions actions;
    actions.arms.resize(1, static_cast<Index>(coordinates.size()));
    for (std::size_t c = 0; c < coordinates.size(); ++c)
      actions.arms(0, static_cast<Index>(c)) = coordinates[c].at(1).turning.y() * steps_;
    return {actions};
  }

  int resets = 0;
  std::vector<Real> time_steps;

 private:
  Points rest_;
  int breaks_at_, steps_ = 0;
};

std::vector<Pose> poses_of(const Scene& scene, int count) {
  std::vector<Pose> poses;
  for (int i = 0; i < count; ++i) poses.push_back(flexed(scene, radians(2 * i)));
  return poses;
}

struct Recorder {
  std::vector<FrameRecord> records;
  std::function<void(const FrameRecord&)> function() {
    return [this](const FrameRecord& record) { records.push_back(record); };
  }
  std::vector<int> numbers() const {
    std::vector<int> all;
    for (const FrameRecord& record : records) all.push_back(record.frame.number);
    return all;
  }
};

const std::atomic<bool> never = false;

}  // namespace

TEST(RunScene, frame_0_is_the_input_bit_by_bit) {
  const Scene scene = tube_scene();
  const auto method = xpbd_on_tube(scene);
  Recorder recorder;
  EXPECT_EQ(run_scene(scene, poses_of(scene, 2), *method, nullptr, never, recorder.function()), RunEnd::complete);
  ASSERT_EQ(recorder.numbers(), (std::vector<int>{0, 1}));
  EXPECT_EQ(hash_of(recorder.records[0].frame.muscles[0].points), hash_of(scene.muscles[0].surface.vertices));
  EXPECT_EQ(recorder.records[0].measures.at(0).volume_ratio, 1);
  ASSERT_EQ(recorder.records[0].report.muscles.size(), 1u);
  EXPECT_EQ(metric(recorder.records[0].report.muscles[0].metrics, "iterations"), 0);
}

TEST(RunScene, hands_over_every_frame_with_its_pose_and_measures) {
  const Scene scene = tube_scene();
  Stepping method(scene);
  Recorder recorder;
  const std::vector<Pose> poses = poses_of(scene, 5);
  run_scene(scene, poses, method, nullptr, never, recorder.function());
  ASSERT_EQ(recorder.numbers(), (std::vector<int>{0, 1, 2, 3, 4}));
  for (std::size_t i = 0; i < 5; ++i) {
    const FrameRecord& record = recorder.records[i];
    EXPECT_TRUE(record.frame.pose.bodies[1].isApprox(poses[i].bodies[1], 0));
    EXPECT_NEAR(record.frame.muscles[0].points(0, 0) - scene.muscles[0].surface.vertices(0, 0),
                0.001 * static_cast<Real>(i), 1e-15);
    ASSERT_EQ(record.measures.size(), 1u);
    EXPECT_NEAR(record.measures[0].volume_ratio, 1, 1e-12);
  }
}

TEST(RunScene, asks_in_every_frame_what_fibers_do_where_it_is_told_to) {
  const Scene scene = tube_scene();
  Stepping method(scene);
  Recorder asked, not_asked;
  const std::vector<Pose> poses = poses_of(scene, 3);
  run_scene(scene, poses, method, nullptr, never, asked.function(), nullptr, {.fiber_actions = true});
  ASSERT_EQ(asked.records.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(asked.records[i].actions.at(0).arms(0, 0), static_cast<Real>(i));
  run_scene(scene, poses, method, nullptr, never, not_asked.function());
  EXPECT_TRUE(not_asked.records.at(2).actions.empty());
}

TEST(RunScene, tells_the_method_how_much_time_passes) {
  const Scene scene = tube_scene();
  Stepping method(scene);
  Recorder recorder;
  std::vector<Pose> poses = poses_of(scene, 4);
  poses[1].time = 0.01, poses[2].time = 0.03, poses[3].time = 0.03;
  run_scene(scene, poses, method, nullptr, never, recorder.function());
  ASSERT_EQ(method.time_steps.size(), 3u);
  EXPECT_NEAR(method.time_steps[0], 0.01, 1e-15);
  EXPECT_NEAR(method.time_steps[1], 0.02, 1e-15);
  EXPECT_EQ(method.time_steps[2], usual_time_step) << "no time passes between these";
}

TEST(RunScene, starts_over_from_the_capture_pose_each_time) {
  const Scene scene = tube_scene();
  Stepping method(scene);
  Recorder first, second;
  run_scene(scene, poses_of(scene, 3), method, nullptr, never, first.function());
  run_scene(scene, poses_of(scene, 3), method, nullptr, never, second.function());
  EXPECT_EQ(method.resets, 2);
  EXPECT_EQ(hash_of(first.records[2].frame.muscles[0].points), hash_of(second.records[2].frame.muscles[0].points));
}

TEST(RunScene, stops_between_frames_when_asked_to) {
  const Scene scene = tube_scene();
  Stepping method(scene);
  std::atomic<bool> stop = false;
  int frames = 0;
  const RunEnd end = run_scene(scene, poses_of(scene, 9), method, nullptr, stop, [&](const FrameRecord&) {
    if (++frames == 3) stop = true;
  });
  EXPECT_EQ(end, RunEnd::interrupted);
  EXPECT_EQ(frames, 3);
}

TEST(RunScene, stops_within_a_second_in_the_middle_of_a_frame) {
  XpbdSettings endless;
  endless.iterations = 100000;
  const Scene scene = tube_scene(endless);
  std::atomic<bool> stop = false, captured = false;
  std::chrono::steady_clock::time_point asked;
  std::thread user([&] {
    captured.wait(false);
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    asked = std::chrono::steady_clock::now();
    stop = true;
  });
  Recorder recorder;
  const auto record = [&, add = recorder.function()](const FrameRecord& now) {
    add(now);
    captured = true;
    captured.notify_all();
  };
  const RunEnd end = run_scene(scene, poses_of(scene, 3), *xpbd_on_tube(scene), nullptr, stop, record);
  const auto ended = std::chrono::steady_clock::now();
  user.join();
  EXPECT_EQ(end, RunEnd::interrupted);
  EXPECT_EQ(recorder.records.size(), 1u) << "the capture pose; the frame under way is dropped";
  EXPECT_LT(ended - asked, std::chrono::seconds(1));
}

TEST(RunScene, resumed_gives_the_frames_an_uninterrupted_run_gives) {
  const Scene scene = tube_scene();
  const std::vector<Pose> poses = poses_of(scene, 8);
  Recorder whole, rest;
  run_scene(scene, poses, *xpbd_on_tube(scene), nullptr, never, whole.function());
  const ResumePoint resume{whole.records[3].frame, whole.records[4].frame};
  run_scene(scene, poses, *xpbd_on_tube(scene), &resume, never, rest.function());
  ASSERT_EQ(rest.numbers(), (std::vector<int>{5, 6, 7}));
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_EQ(hash_of(rest.records[i].frame.muscles[0].points), hash_of(whole.records[5 + i].frame.muscles[0].points));
}

TEST(RunScene, records_chosen_frames_of_all_that_are_computed_and_resumes_them_by_going_through_all) {
  const Scene scene = tube_scene();
  const std::vector<Pose> poses = poses_of(scene, 8);
  Recorder whole, some, rest;
  run_scene(scene, poses, *xpbd_on_tube(scene), nullptr, never, whole.function());
  const RunChoices choices = {.recorded = {0, 3, 6, 7}};
  run_scene(scene, poses, *xpbd_on_tube(scene), nullptr, never, some.function(), nullptr, choices);
  ASSERT_EQ(some.numbers(), (std::vector<int>{0, 1, 2, 3}));
  const ResumePoint resume{some.records[0].frame, some.records[1].frame};
  run_scene(scene, poses, *xpbd_on_tube(scene), &resume, never, rest.function(), nullptr, choices);
  ASSERT_EQ(rest.numbers(), (std::vector<int>{2, 3}));
  for (const auto& [frame, of] : {std::pair{1, 3}, {2, 6}, {3, 7}}) {
    const auto hash = hash_of(whole.records[static_cast<std::size_t>(of)].frame.muscles[0].points);
    EXPECT_EQ(hash_of(some.records[static_cast<std::size_t>(frame)].frame.muscles[0].points), hash);
    if (frame < 2) continue;
    EXPECT_EQ(hash_of(rest.records[static_cast<std::size_t>(frame) - 2].frame.muscles[0].points), hash);
  }
}

/// What each kind moved, all kinds together.
Points all_of(const Corrections& corrections) {
  Points sum;
  for (const auto& [kind, moved] : corrections) sum = sum.size() == 0 ? moved : Points(sum + moved);
  return sum;
}

TEST(RunScene, corrections_are_all_that_moves_a_muscle_at_rest_that_nothing_carries) {
  Scene scene = tube_scene();
  scene.method = find_preset("thesis-2024")->method;
  Recorder recorder;
  run_scene(scene, poses_of(scene, 2), *xpbd_on_tube(scene), nullptr, never, recorder.function(), nullptr,
            {.corrections = true});
  ASSERT_EQ(recorder.records.size(), 2u);
  EXPECT_TRUE(recorder.records[0].corrections.at(0).empty());
  const Corrections& told = recorder.records[1].corrections.at(0);
  for (const char* kind : {"distance", "dihedral", "volume", "bone contact"}) {
    ASSERT_TRUE(told.contains(kind)) << kind;
    EXPECT_GT(told.at(kind).norm(), 0) << kind;
  }
  Points moved = recorder.records[1].frame.muscles[0].points - recorder.records[0].frame.muscles[0].points;
  Points corrected = all_of(told);
  for (const Attachment& end : scene.muscles[0].attachments)
    for (const Index v : end.vertices) moved.col(v).setZero(), corrected.col(v).setZero();
  EXPECT_GT(moved.norm(), 1e-4);
  EXPECT_NEAR((moved - corrected).norm(), 0, 1e-3 * moved.norm());
}

TEST(RunScene, corrections_of_a_recorded_frame_are_of_all_poses_since_the_one_before) {
  const Scene scene = tube_scene();
  const std::vector<Pose> poses = poses_of(scene, 6);
  Recorder whole, some, rest;
  run_scene(scene, poses, *xpbd_on_tube(scene), nullptr, never, whole.function(), nullptr, {.corrections = true});
  const RunChoices choices = {.recorded = {0, 2, 5}, .corrections = true};
  run_scene(scene, poses, *xpbd_on_tube(scene), nullptr, never, some.function(), nullptr, choices);
  ASSERT_EQ(some.numbers(), (std::vector<int>{0, 1, 2}));
  const ResumePoint resume{some.records[0].frame, some.records[1].frame};
  run_scene(scene, poses, *xpbd_on_tube(scene), &resume, never, rest.function(), nullptr, choices);
  Points sum = Points::Zero(3, scene.muscles[0].surface.vertex_count());
  for (const std::size_t i : {3U, 4U, 5U}) sum += all_of(whole.records[i].corrections[0]);
  EXPECT_GT(sum.norm(), 0);
  EXPECT_NEAR((all_of(some.records[2].corrections[0]) - sum).norm(), 0, 1e-9);
  EXPECT_EQ(all_of(rest.records[0].corrections[0]), all_of(some.records[2].corrections[0]));
}

TEST(RunScene, corrections_of_a_method_without_passes_are_refused) {
  const Scene scene = tube_scene();
  Stepping method(scene);
  Recorder recorder;
  EXPECT_THROW(
      run_scene(scene, poses_of(scene, 2), method, nullptr, never, recorder.function(), nullptr, {.corrections = true}),
      ConfigurationError);
}

TEST(RunScene, resumed_after_the_last_frame_has_nothing_to_do) {
  const Scene scene = tube_scene();
  const std::vector<Pose> poses = poses_of(scene, 3);
  Recorder whole, rest;
  Stepping method(scene);
  run_scene(scene, poses, method, nullptr, never, whole.function());
  const ResumePoint resume{whole.records[1].frame, whole.records[2].frame};
  EXPECT_EQ(run_scene(scene, poses, method, &resume, never, rest.function()), RunEnd::complete);
  EXPECT_TRUE(rest.records.empty());
}

TEST(RunScene, an_error_names_the_frame_and_comes_after_all_good_frames) {
  const Scene scene = tube_scene();
  Stepping method(scene, 3);
  Recorder recorder;
  try {
    run_scene(scene, poses_of(scene, 6), method, nullptr, never, recorder.function());
    FAIL() << "no error";
  } catch (const QualityError& error) {
    EXPECT_THAT(error.what(), testing::StartsWith("frame 3: muscle tube"));
  }
  EXPECT_EQ(recorder.numbers(), (std::vector<int>{0, 1, 2}));
}

TEST(RunScene, without_poses_does_nothing) {
  const Scene scene = tube_scene();
  Stepping method(scene);
  Recorder recorder;
  EXPECT_EQ(run_scene(scene, {}, method, nullptr, never, recorder.function()), RunEnd::complete);
  EXPECT_TRUE(recorder.records.empty());
}

}  // namespace gracilis
