#include <gracilis/study/trajectories.hpp>

#include "app/program.hpp"
#include "io/hdf5_reading.hpp"
#include "study/study_scenes.hpp"

#include <gracilis/io/run/recorded_run.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gracilis {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

const std::string two_runs =
    "scene = \"boxes.toml\"\nmetrics = \"light\"\n[[parameters]]\nkey = \"motion.step_deg\"\nvalues = [2, 5]\n";

TEST(StudyTrajectories, have_the_shapes_fibers_poses_and_measures_of_every_run) {
  const StudyFolder folder;
  const fs::path study = folder.study(two_runs);
  ASSERT_EQ(run_program("study run " + study.string()).exit_code, 0);
  const ProgramResult collected = run_program("study collect " + study.string() + " --hdf5");
  ASSERT_EQ(collected.exit_code, 0) << collected.err;
  const fs::path file = folder.path("study/trajectories.h5");
  EXPECT_THAT(collected.out, HasSubstr("trajectories.h5"));

  const RecordedRun run = open_recorded_run(folder.path("study/runs/0002"));
  const std::string group = "/runs/0002", muscle = run.muscles.at(0);
  const auto frames = static_cast<hsize_t>(run.frame_count);
  EXPECT_THAT(hdf5_texts(file, group, "parameters"), ElementsAre("motion.step_deg"));
  EXPECT_THAT(hdf5_texts(file, group, "values"), ElementsAre("5"));
  EXPECT_EQ(hdf5_numbers(file, group + "/time").values, run.times);
  EXPECT_EQ(hdf5_texts(file, group + "/coordinates", "columns"), run.coordinates);

  const Hdf5Numbers vertices = hdf5_numbers(file, group + "/muscles/" + muscle + "/vertices");
  const Points last = recorded_surface(run, muscle, run.frame_count - 1).vertices;
  ASSERT_THAT(vertices.shape, ElementsAre(frames, static_cast<hsize_t>(last.cols()), 3u));
  const Eigen::Map<const Points> read(vertices.values.data() + (frames - 1) * static_cast<hsize_t>(last.size()), 3,
                                      last.cols());
  EXPECT_LT((read - last).cwiseAbs().maxCoeff(), 1e-7);
  const Polylines fibers = recorded_fibers(run, muscle, 0);
  EXPECT_THAT(hdf5_numbers(file, group + "/muscles/" + muscle + "/fiber_points").shape,
              ElementsAre(frames, static_cast<hsize_t>(fibers.points.cols()), 3u));
  EXPECT_EQ(hdf5_numbers(file, group + "/muscles/" + muscle + "/fiber_offsets").values.size(), fibers.offsets.size());
  EXPECT_TRUE(hdf5_has(file, group + "/bones/" + run.bones.at(0) + "/vertices"));

  const Hdf5Numbers volumes = hdf5_numbers(file, group + "/measures/volume_ratio");
  const Eigen::MatrixXd measured = measure_of(run, "volume_ratio");
  ASSERT_THAT(volumes.shape, ElementsAre(frames, static_cast<hsize_t>(measured.cols())));
  EXPECT_EQ(volumes.values.back(), measured(measured.rows() - 1, measured.cols() - 1));
}

TEST(StudyTrajectories, a_run_whose_files_are_damaged_is_left_out_and_named) {
  const StudyFolder folder;
  const fs::path study = folder.study(two_runs);
  ASSERT_EQ(run_program("study run " + study.string()).exit_code, 0);
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder.path("study/runs/0001")))
    if (entry.path().string().find("shapes") != std::string::npos && entry.is_regular_file())
      fs::resize_file(entry.path(), fs::file_size(entry.path()) / 2);
  const ProgramResult collected = run_program("study collect " + study.string() + " --hdf5");
  EXPECT_EQ(collected.exit_code, 0) << collected.err;
  EXPECT_THAT(collected.err, HasSubstr("left out of the trajectories: 0001"));
  EXPECT_FALSE(hdf5_has(folder.path("study/trajectories.h5"), "/runs/0001"));
  EXPECT_TRUE(hdf5_has(folder.path("study/trajectories.h5"), "/runs/0002/time"));
}

}  // namespace
}  // namespace gracilis
