#include <gracilis/anatomy/bone_field.hpp>
#include <gracilis/io/field_cache.hpp>

#include "shapes.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

namespace gracilis {
namespace {

namespace fs = std::filesystem;

class FieldCache : public testing::Test {
 protected:
  FieldCache() : folder(fs::temp_directory_path() / ("gracilis_cache_" + std::to_string(getpid()))) {
    fs::remove_all(folder);
  }
  ~FieldCache() override { fs::remove_all(folder); }

  std::vector<fs::path> files() const {
    if (!fs::exists(folder)) return {};
    return {fs::directory_iterator(folder), fs::directory_iterator()};
  }
  DistanceField field() const { return cached_bone_field(bone, settings, folder); }

  const fs::path folder;
  Bone bone{"ball", 0, shapes::sphere(Vec3(0.1, 0, 0), 0.02, 2)};
  DistanceFieldSettings settings;
};

void expect_same(const DistanceField& a, const DistanceField& b) {
  EXPECT_EQ(a.origin, b.origin);
  EXPECT_EQ(a.cell_size, b.cell_size);
  EXPECT_EQ(a.nodes, b.nodes);
  EXPECT_TRUE(a.values == b.values);
}

}  // namespace

TEST_F(FieldCache, a_field_reads_back_with_every_bit) {
  const DistanceField built = build_bone_field(bone, settings);
  expect_same(field(), built);
  ASSERT_EQ(files().size(), 1u);
  const auto written = fs::last_write_time(files()[0]);
  expect_same(field(), built);
  EXPECT_EQ(fs::last_write_time(files()[0]), written) << "the second call only reads";
}

TEST_F(FieldCache, another_surface_or_setting_is_another_field) {
  field();
  bone.surface.vertices(0, 3) += 1e-9;
  field();
  EXPECT_EQ(files().size(), 2u);
  settings.cell_size = 0.002;
  EXPECT_EQ(field().cell_size, build_bone_field(bone, settings).cell_size);
  EXPECT_EQ(files().size(), 3u);
}

TEST_F(FieldCache, a_damaged_file_is_built_anew) {
  const DistanceField built = field();
  ASSERT_EQ(files().size(), 1u);
  fs::resize_file(files()[0], fs::file_size(files()[0]) - 1);
  expect_same(field(), built);
  std::ofstream(files()[0]) << "not a field";
  expect_same(field(), built);
  expect_same(field(), built);
}

TEST_F(FieldCache, a_folder_that_cannot_be_made_costs_only_the_time_to_build) {
  std::ofstream(folder.string()) << "a file where the folder should be";
  expect_same(field(), build_bone_field(bone, settings));
  expect_same(cached_bone_field(bone, settings, {}), build_bone_field(bone, settings));
}

}  // namespace gracilis
