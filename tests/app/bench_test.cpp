#include "app/program.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <map>
#include <set>

namespace gracilis {
namespace {

nlohmann::json bench(const std::string& arguments) {
  const ProgramResult result = run_program("bench --json --repeats 1 " + arguments);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  return nlohmann::json::parse(result.out);
}

}  // namespace

TEST(Bench, times_every_phase_of_every_muscle_and_whole_frames) {
  const nlohmann::json answer = bench("--frame 4 --threads 1,2");
  std::map<std::string, std::set<std::string>> phases;
  for (const auto& entry : answer.at("benchmarks")) {
    phases[entry.at("muscle")].insert(entry.at("phase").get<std::string>());
    EXPECT_GT(entry.at("ms").get<double>(), 0);
    EXPECT_GT(entry.at("triangles").get<int>(), 0);
  }
  EXPECT_EQ(phases.size(), 7u) << "six muscles and all of them";
  EXPECT_EQ(phases.at("all"), (std::set<std::string>{"first_frame", "frame"}));
  EXPECT_EQ(phases.at("iliacus_r"),
            (std::set<std::string>{"iteration", "distance", "dihedral", "volume", "stretch_limit", "bone_contact"}));
}

TEST(Bench, gives_the_same_hash_again_and_with_any_number_of_threads) {
  std::map<std::pair<std::string, std::string>, std::set<std::string>> hashes;
  for (int run = 0; run < 2; ++run) {
    const nlohmann::json answer = bench("--frame 3 --threads 1,2,5");
    for (const auto& entry : answer.at("benchmarks"))
      hashes[{entry.at("muscle"), entry.at("phase")}].insert(entry.at("hash").get<std::string>());
  }
  for (const auto& [what, found] : hashes) EXPECT_EQ(found.size(), 1u) << what.first << " " << what.second;
}

TEST(Bench, of_coarser_and_finer_copies_times_iterations_alone) {
  const auto triangles = [](const std::string& options) {
    const nlohmann::json answer = bench("--frame 1 --threads 1 " + options);
    int sum = 0;
    for (const auto& entry : answer.at("benchmarks")) {
      EXPECT_NE(entry.at("muscle"), "all");
      if (entry.at("phase") == "iteration") sum += entry.at("triangles").get<int>();
    }
    return sum;
  };
  const int coarse = triangles("--coarsen 0.02");
  EXPECT_GT(coarse, 100);
  EXPECT_EQ(triangles("--coarsen 0.02 --subdivide 1"), 4 * coarse);
  EXPECT_LT(coarse, triangles("--coarsen 0.01"));
}

TEST(Bench, settings_of_the_solver_reach_what_is_timed) {
  const auto hash = [](const std::string& options) {
    const nlohmann::json answer = bench("--frame 2 --threads 1 --only iliacus_r " + options);
    EXPECT_EQ(answer.at("benchmarks").at(0).at("phase"), "iteration");
    return answer.at("benchmarks").at(0).at("hash").get<std::string>();
  };
  const std::string unchanged = hash("");
  for (const std::string setting : {"pressure=1.05", "rayleigh_beta=0.01", "constraint_time_step=0.1"})
    EXPECT_NE(hash("--set " + setting), unchanged) << setting;
}

TEST(Bench, of_a_method_that_does_not_iterate_times_frames_alone) {
  for (const auto& entry : bench("--frame 2 --threads 1 --set method=skinning").at("benchmarks"))
    EXPECT_EQ(entry.at("muscle"), "all");
}

TEST(Bench, a_frame_beyond_the_motion_is_a_configuration_error) {
  const ProgramResult result = run_program("bench --frame 5000");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("the motion has frames 0 to"), std::string::npos) << result.err;
}

}  // namespace gracilis
