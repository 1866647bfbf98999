#include <gracilis/core/errors.hpp>
#include <gracilis/io/scene/preparation_report.hpp>
#include <gracilis/io/scene/prepared_cache.hpp>

#include <io/test_files.hpp>
#include <shapes.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

namespace gracilis {
namespace {

/// Counts how often it works; what it makes is twice as large as the input.
struct CountingPreparation {
  int calls = 0;
  PrepareFunction function() {
    return [this](const std::vector<NamedSurface>& muscles, const std::vector<NamedSurface>&, const PrepareSettings&,
                  const std::function<void(const std::string&)>&) {
      ++calls;
      PreparedSurfaces prepared;
      for (const NamedSurface& muscle : muscles) {
        prepared.muscles.push_back({2 * muscle.mesh.vertices, muscle.mesh.faces});
        prepared.report.muscles.push_back({.name = muscle.name, .volume_before = 1e-4, .volume_after = 8e-4});
      }
      return prepared;
    };
  }
};

class PreparedCache : public testing::Test {
 protected:
  std::vector<TriangleMesh> prepare(const PrepareSettings& settings = {}) {
    return cached_preparation(
        muscles, bones, settings, work.function(), [](const std::string&) {}, folder.path());
  }
  TestFolder folder;
  CountingPreparation work;
  std::vector<NamedSurface> muscles = {{"psoas", shapes::sphere(Vec3::Zero(), 0.02, 2)}};
  std::vector<NamedSurface> bones = {{"femur", shapes::box(Vec3(1, 0, 0), Vec3(2, 1, 1))}};
};

TEST_F(PreparedCache, gives_the_same_bits_without_working_again) {
  const std::vector<TriangleMesh> first = prepare(), second = prepare();
  EXPECT_EQ(work.calls, 1);
  ASSERT_EQ(second.size(), 1u);
  EXPECT_EQ(second[0].vertices, first[0].vertices);
  EXPECT_EQ(second[0].faces, first[0].faces);
}

TEST_F(PreparedCache, other_settings_muscles_or_bones_are_prepared_anew) {
  prepare();
  PrepareSettings coarser;
  coarser.edge_length *= 2;
  prepare(coarser);
  EXPECT_EQ(work.calls, 2);
  muscles[0].mesh.vertices(0, 0) += 1e-9;
  prepare();
  EXPECT_EQ(work.calls, 3);
  bones[0].mesh.vertices(0, 0) += 1e-9;
  prepare();
  EXPECT_EQ(work.calls, 4);
}

TEST_F(PreparedCache, a_damaged_file_is_made_again) {
  prepare();
  for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
    if (entry.path().extension() == ".muscles") std::filesystem::resize_file(entry.path(), 100);
  EXPECT_EQ(prepare().size(), 1u);
  EXPECT_EQ(work.calls, 2);
}

TEST_F(PreparedCache, a_changed_bit_is_seen_and_told_of) {
  const std::vector<TriangleMesh> first = prepare();
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
    if (entry.path().extension() != ".muscles") continue;
    std::fstream stream(entry.path(), std::ios::in | std::ios::out | std::ios::binary);
    stream.seekp(1000);
    stream.put('x');
  }
  std::vector<std::string> warnings;
  const std::vector<TriangleMesh> again = cached_preparation(
      muscles, bones, {}, work.function(), [](const std::string&) {}, folder.path(),
      [&](const std::string& warning) { warnings.push_back(warning); });
  EXPECT_EQ(work.calls, 2);
  EXPECT_EQ(again[0].vertices, first[0].vertices);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_THAT(warnings[0], testing::HasSubstr("is damaged; made anew"));
}

TEST_F(PreparedCache, what_is_kept_needs_nobody_to_prepare_it) {
  const std::vector<TriangleMesh> first = prepare();
  const auto silent = [](const std::string&) {};
  const std::vector<TriangleMesh> kept = cached_preparation(muscles, bones, {}, {}, silent, folder.path());
  EXPECT_EQ(kept[0].vertices, first[0].vertices);
  bones.clear();
  try {
    cached_preparation(muscles, bones, {}, {}, silent, folder.path());
    FAIL() << "nobody could have prepared it";
  } catch (const ConfigurationError& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    EXPECT_THAT(error.what(), testing::HasSubstr("GRACILIS_WITH_PREPARE"));
  }
}

TEST(PreparationReport, tells_people_and_programs_the_same) {
  PreparationReport report;
  report.muscles.push_back({.name = "psoas",
                            .repairs = {"filled 1 hole"},
                            .vertices_moved = 7,
                            .max_displacement = 0.0021,
                            .volume_before = 1e-4,
                            .volume_after = 0.99e-4,
                            .hausdorff = 0.0025});
  report.pairs.push_back({"psoas", "iliacus", 196, 0});
  const std::string text = to_text(report);
  for (const char* part : {"psoas", "filled 1 hole", "2.10 mm at most", "2.50 mm", "-1.00 %", "before 196"})
    EXPECT_THAT(text, testing::HasSubstr(part));
  const nlohmann::ordered_json json = to_json(report);
  EXPECT_EQ(json["muscles"][0]["vertices_moved"], 7);
  EXPECT_NEAR(json["muscles"][0]["hausdorff_mm"].get<double>(), 2.5, 1e-9);
  EXPECT_EQ(json["pairs"][0]["intersections_before"], 196);
}

}  // namespace
}  // namespace gracilis
