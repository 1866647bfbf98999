#include "app/program.hpp"
#include "study/study_scenes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

/// What studies/ has for engines that start processes, with a stand-in for gracilis that tells what it was asked for.
namespace gracilis {

namespace {

using testing::HasSubstr;

struct EngineFolder : SceneFolder {
  EngineFolder() {
    write("bin/gracilis", "#!/bin/sh\nfor word in \"$@\"; do printf '[%s]' \"$word\"; done\necho\n");
    std::filesystem::permissions(path("bin/gracilis"), std::filesystem::perms::owner_all);
  }

  /// What a command of a shell says with the stand-in on its way, and a last line with its exit code.
  std::string said(const std::string& command) const {
    return said_by("export PATH=" + path("bin").string() + ":$PATH; unset GRACILIS SHARDS; cd " + path("").string() +
                   "; " + command + "; echo \"code $?\"");
  }

  static std::string script(const std::string& name) {
    return std::string(build_paths::source_folder) + "/studies/" + name;
  }

  /// A task of an array from `first` to `last` of which `count` tasks were asked for.
  std::string task(int id, int first, int last, int count, const std::string& shards = "") const {
    const auto variable = [](const char* name, int value) {
      return " SLURM_ARRAY_TASK_" + std::string(name) + "=" + std::to_string(value);
    };
    return said((shards.empty() ? "" : "SHARDS=" + shards) + variable("ID", id) + variable("MIN", first) +
                variable("MAX", last) + variable("COUNT", count) + " bash " + script("slurm.sh") +
                " 'my study.toml' --folder 'my results'");
  }
};

}  // namespace

TEST(StudyEngines, every_task_of_a_slurm_array_has_a_shard_of_its_own_wherever_the_array_begins) {
  const EngineFolder folder;
  EXPECT_EQ(folder.task(3, 1, 16, 16), "[study][run][my study.toml][--folder][my results][--shard][3/16]\ncode 0\n");
  std::set<std::string> shards;
  for (int id = 0; id < 4; ++id) shards.insert(folder.task(id, 0, 3, 4));
  EXPECT_EQ(shards.size(), 4u);
  for (const std::string shard : {"1/4", "2/4", "3/4", "4/4"})
    EXPECT_TRUE(std::any_of(shards.begin(), shards.end(), [&](const std::string& said) {
      return said.find("[" + shard + "]") != std::string::npos;
    })) << shard;
}

TEST(StudyEngines, a_slurm_task_that_is_submitted_again_has_the_same_shard_as_before) {
  const EngineFolder folder;
  for (const int id : {3, 5}) {
    EXPECT_EQ(folder.task(id, 3, 5, 2, "16"), folder.task(id, 0, 15, 16));
    EXPECT_EQ(folder.task(id, 3, 5, 2, "16"), folder.task(id, 1, 16, 16));
  }
  const std::string alone = folder.task(5, 3, 5, 2);
  EXPECT_THAT(alone, HasSubstr("SHARDS=N"));
  EXPECT_THAT(alone, HasSubstr("code 2"));
}

TEST(StudyEngines, slurm_tells_the_shell_itself_before_the_time_is_over) {
  EXPECT_THAT(read_text(EngineFolder::script("slurm.sh")), HasSubstr("\n#SBATCH --signal=B:TERM@60\n"));
}

TEST(StudyEngines, parallel_keeps_paths_with_spaces) {
  const EngineFolder folder;
  if (std::system("parallel --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "skipped: no parallel";
  const std::string said =
      folder.said("SHARDS=2 HOME=$PWD sh " + EngineFolder::script("parallel.sh") + " 'my study.toml'");
  for (const char* shard : {"1/2", "2/2"})
    EXPECT_THAT(said, HasSubstr("[study][run][my study.toml][--shard][" + std::string(shard) + "]\n"));
}

TEST(StudyEngines, dask_tells_of_a_shard_that_a_signal_ended) {
  const EngineFolder folder;
  folder.write("dask/distributed.py", R"(class Task:
    def __init__(self, code):
        self.code = code
    def result(self):
        return self.code
class Client:
    def __init__(self, *arguments, **keywords):
        pass
    def __enter__(self):
        return self
    def __exit__(self, *what):
        pass
    def submit(self, function, *arguments, pure):
        return Task(function(*arguments))
def as_completed(tasks):
    return list(tasks)
)");
  folder.write("dask/__init__.py", "");
  const std::string run = "PYTHONDONTWRITEBYTECODE=1 PYTHONPATH=. python3 " + EngineFolder::script("dask_study.py");
  EXPECT_THAT(folder.said(run + " study.toml 2"), HasSubstr("shard 2/2: exit code 0\ncode 0\n"));
  folder.write("bin/gracilis", "#!/bin/sh\necho \"$@\" >>asked.txt\nkill -9 $$\n");
  EXPECT_THAT(folder.said(run + " study.toml 2 --folder results"), HasSubstr("code 137\n"));
  EXPECT_THAT(read_text(folder.path("asked.txt")), HasSubstr("study run study.toml --folder results --shard 2/2\n"));
}

}  // namespace gracilis
