#include "io/test_files.hpp"

#include <gracilis/core/errors.hpp>
#include <gracilis/study/study_reader.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>

namespace gracilis {

namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Study study_in(const std::string& toml) {
  const TestFolder folder;
  return read_study(folder.write("study.toml", toml));
}

/// What is wrong with a description: its messages.
std::vector<std::string> problems_of(const std::string& text, const std::string& ending = ".toml") {
  const TestFolder folder;
  const std::filesystem::path file = folder.write("study" + ending, text);
  std::vector<std::string> messages;
  try {
    read_study(file);
  } catch (const ConfigurationError& error) {
    for (const Problem& problem : error.problems()) messages.push_back(problem.where + " " + problem.what);
  } catch (const InputError& error) {
    for (const Problem& problem : error.problems()) messages.push_back(problem.where + " " + problem.what);
  }
  return messages;
}

const std::string latin =
    "scene = \"demo\"\n[sampling]\nkind = \"latin\"\nsamples = 4\n[[parameters]]\nkey = \"iterations\"\n";

}  // namespace

TEST(StudyReader, every_combination_of_a_grid_is_a_run) {
  const Study study = study_in(
      "scene = \"demo elbow\"\nset = [\"preset=fast\"]\n[sampling]\nkind = \"grid\"\n[[parameters]]\nkey = \"method\"\n"
      "values = [\"pbd\", \"arap\"]\n[[parameters]]\nkey = \"flexion\"\nrange = [10, 30]\nsteps = 3\n");
  ASSERT_EQ(study.runs.size(), 6u);
  EXPECT_EQ(study.runs[4].name, "0005");
  EXPECT_EQ(study.runs[4].scene, "demo-elbow");
  EXPECT_THAT(study.runs[4].set, ElementsAre("preset=fast", "method=arap"));
  EXPECT_EQ(study.runs[4].flexion_deg, 20);
  EXPECT_THAT(study.runs[4].values, ElementsAre("arap", "20"));
  EXPECT_EQ(command_alone(study, study.runs[4]),
            "gracilis demo elbow --flexion 20 --set preset=fast --set method=arap --layout compact --out 0005");
}

TEST(StudyReader, values_of_a_range_are_spread_evenly_by_its_logarithm_or_whole) {
  const Study study = study_in(latin +
                               "range = [1, 8]\nwhole = true\n[[parameters]]\nkey = \"pressure\"\n"
                               "range = [1e-4, 1]\nscale = \"log\"\n");
  std::vector<int> decades(4, 0), wholes(9, 0);
  for (const StudyRun& run : study.runs) {
    ++wholes.at(static_cast<std::size_t>(std::stoi(run.values[0])));
    ++decades.at(static_cast<std::size_t>(std::floor(-std::log10(std::stod(run.values[1])))));
  }
  EXPECT_THAT(decades, ElementsAre(1, 1, 1, 1));
  EXPECT_THAT(wholes, ElementsAre(0, 0, 1, 0, 1, 0, 1, 0, 1));
}

TEST(StudyReader, a_table_is_a_run_per_row_and_empty_cells_leave_keys_as_they_are) {
  const TestFolder folder;
  const Study study = read_study(
      folder.write("study.csv", "run,scene,preset,psoas_r.pressure\nfirst,demo,fast,\nsecond,legs/a.toml,,1.1\n"));
  ASSERT_EQ(study.runs.size(), 2u);
  EXPECT_EQ(study.runs[0].name, "first");
  EXPECT_THAT(study.runs[0].set, ElementsAre("preset=fast"));
  EXPECT_THAT(study.runs[1].set, ElementsAre("psoas_r.pressure=1.1"));
  EXPECT_EQ(scene_file(study, study.runs[1]), folder.path() / "legs/a.toml");
}

TEST(StudyReader, data_named_from_the_folder_that_one_stands_in_are_found_from_every_other) {
  const TestFolder folder;
  const std::filesystem::path file = folder.write("study.toml", "scene = \"demo\"\ndata = \"data\"\n");
  EXPECT_EQ(read_study(std::filesystem::relative(file)).data, file.parent_path() / "data");

  const char* variable = std::getenv("GRACILIS_DATA");
  const std::string before = variable ? variable : "";
  setenv("GRACILIS_DATA", ".", 1);
  const std::filesystem::path data = study_in("scene = \"demo\"\n").data;
  setenv("GRACILIS_DATA", "/", 1);
  EXPECT_EQ(study_in("scene = \"demo\"\n").data, "") << "scenes find it by themselves";
  if (variable)
    setenv("GRACILIS_DATA", before.c_str(), 1);
  else
    unsetenv("GRACILIS_DATA");
  EXPECT_TRUE(data.is_absolute()) << data;
  EXPECT_TRUE(std::filesystem::equivalent(data, std::filesystem::current_path())) << data;
}

TEST(StudyReader, what_is_wrong_is_told_once_with_its_place) {
  EXPECT_THAT(problems_of("scene = \"demo\"\nsceen = 3\n"), ElementsAre("2:1 unknown key 'sceen' in the study"));
  EXPECT_THAT(problems_of("scene = demo\n"), ElementsAre(HasSubstr("1:9 ")));
  EXPECT_THAT(problems_of("metrics = \"light\"\n"), ElementsAre(HasSubstr("a study needs a 'scene'")));
  EXPECT_THAT(problems_of("scene = \"demo\"\n[sampling]\nkind = \"latine\"\n"),
              ElementsAre("3:8 there is no sampling 'latine'"));
  EXPECT_THAT(problems_of("scene = \"demo\"\n[sampling]\nkind = \"sobol\"\n"),
              ElementsAre("3:8 a sampling 'sobol' needs 'samples'"));
  for (const std::string kind : {"latin", "halton", "sobol", "morris", "indices"})
    EXPECT_THAT(problems_of("scene = \"demo\"\n[sampling]\nkind = \"" + kind + "\"\nsamples = 2\n"),
                ElementsAre("2:1 this sampling has no parameters to spread"));
  EXPECT_THAT(problems_of(latin), ElementsAre(HasSubstr("a parameter needs 'values' or a 'range'")));
  EXPECT_THAT(problems_of(latin + "range = [3, 1]\n"), ElementsAre("7:9 'range' must begin below its end"));
  EXPECT_THAT(problems_of(latin + "range = [0, 1]\nscale = \"log\"\n"),
              ElementsAre("7:9 a range by its logarithm must begin above 0"));
  EXPECT_THAT(problems_of(latin + "range = [1, 2]\n[[parameters]]\nkey = \"iterations\"\nvalues = [1]\n"),
              ElementsAre(HasSubstr("there are two parameters 'iterations'")));
  EXPECT_THAT(problems_of("scene = \"demo\"\n[[parameters]]\nkey = \"a\"\nvalues = [1]\n[[parameters]]\nkey = \"b\"\n"
                          "values = [1, 2]\n"),
              ElementsAre(HasSubstr("as many values as each other")));
  EXPECT_THAT(problems_of("scene = \"demo\"\n[sampling]\nkind = \"grid\"\n[[parameters]]\nkey = \"a\"\nrange = [0, 1]\n"
                          "steps = 1000000\n[[parameters]]\nkey = \"b\"\nrange = [0, 1]\nsteps = 1000000\n"),
              ElementsAre(HasSubstr("more than 1000000 runs")));
  EXPECT_THAT(problems_of("scene = \"hip.toml\"\nflexion = 20\n"), ElementsAre(HasSubstr("only built-in scenes")));
  EXPECT_THAT(problems_of("[[outcomes]]\nmetric = \"spike\"\nstatistic = \"most\"\n", ".txt"),
              ElementsAre(HasSubstr("is no study")));
  EXPECT_THAT(problems_of("run,scene\na,demo\na,demo\n", ".csv"), ElementsAre("3 there are two runs 'a'"));
  EXPECT_THAT(problems_of("run,scene\n../a,demo\n", ".csv"), ElementsAre("2 '../a' cannot name a run"));
  EXPECT_THAT(problems_of("run,iterations\na,4\n", ".csv"), ElementsAre("2 names no scene"));
  EXPECT_THAT(problems_of("run,scene\n", ".csv"), ElementsAre(HasSubstr("has no runs")));
  EXPECT_THAT(problems_of("\n", ".csv"), ElementsAre(HasSubstr("nothing but blank lines")));
}

}  // namespace gracilis
