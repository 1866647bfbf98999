#include <gracilis/anatomy/overlap/bone_field.hpp>
#include <gracilis/io/scene/field_cache.hpp>

#include "shapes.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstring>
#include <fstream>
#include <limits>

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

void flip_bit(const fs::path& file, std::uintmax_t at) {
  std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
  stream.seekg(static_cast<std::streamoff>(at));
  const char byte = static_cast<char>(stream.get() ^ 4);
  stream.seekp(static_cast<std::streamoff>(at));
  stream.put(byte);
}

void expect_same(const DistanceField& a, const DistanceField& b) {
  EXPECT_EQ(a.origin, b.origin);
  EXPECT_EQ(a.cell_size, b.cell_size);
  EXPECT_EQ(a.nodes, b.nodes);
  EXPECT_TRUE(a.values == b.values);
}

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

TEST_F(FieldCache, no_bit_of_a_file_can_change_unseen) {
  const DistanceField built = field();
  const fs::path file = files()[0];
  const std::uintmax_t size = fs::file_size(file);
  for (const std::uintmax_t at :
       {std::uintmax_t{0}, std::uintmax_t{30}, std::uintmax_t{90}, std::uintmax_t{120}, size / 2, size - 1}) {
    flip_bit(file, at);
    std::vector<std::string> warnings;
    expect_same(cached_bone_field(bone, settings, folder, [&](const std::string& w) { warnings.push_back(w); }), built);
    ASSERT_EQ(warnings.size(), 1u) << "byte " << at;
    EXPECT_NE(warnings[0].find(file.string()), std::string::npos);
    expect_same(cached_bone_field(bone, settings, folder, [](const std::string& w) { ADD_FAILURE() << w; }), built);
  }
}

TEST_F(FieldCache, what_is_sealed_and_still_senseless_is_built_anew) {
  const DistanceField built = field();
  const fs::path file = files()[0];
  const std::string content = *read_cache_file(file, "gracilis field 6", {});
  const auto with = [&](std::size_t at, auto value) {
    std::string changed = content;
    std::memcpy(changed.data() + at, &value, sizeof value);
    return changed;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const std::string& changed :
       {with(24, 0.0), with(24, -1.0), with(32, nan), with(0, nan), with(48, 1 << 30), with(48, -5),
        with(content.size() - 4, static_cast<float>(nan)), content + "x", content.substr(0, 20), std::string()}) {
    write_cache_file(file, "gracilis field 6", changed);
    int warnings = 0;
    expect_same(cached_bone_field(bone, settings, folder, [&](const std::string&) { ++warnings; }), built);
    EXPECT_EQ(warnings, 1);
  }
}

TEST_F(FieldCache, a_field_under_the_name_of_another_is_not_believed) {
  const DistanceField built = field();
  const fs::path first = files()[0];
  settings.cell_size = 0.002;
  field();
  for (const fs::path& file : files())
    if (file != first) fs::copy_file(file, first, fs::copy_options::overwrite_existing);
  settings.cell_size = DistanceFieldSettings{}.cell_size;
  expect_same(field(), built);
}

TEST_F(FieldCache, many_processes_may_write_the_same_file_at_once) {
  fs::create_directories(folder);
  std::vector<pid_t> children;
  for (int i = 0; i < 6; ++i) {
    const pid_t child = fork();
    if (child == 0) {
      write_cache_file(folder / "same.field", "format", std::string(1'000'000, 'a'));
      _exit(read_cache_file(folder / "same.field", "format", {}) ? 0 : 1);
    }
    children.push_back(child);
  }
  for (const pid_t child : children) {
    int status = -1;
    waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
  }
  EXPECT_EQ(files().size(), 1u) << "nothing temporary is left";
}

TEST_F(FieldCache, a_folder_that_cannot_be_made_costs_only_the_time_to_build) {
  std::ofstream(folder.string()) << "a file where the folder should be";
  expect_same(field(), build_bone_field(bone, settings));
  expect_same(cached_bone_field(bone, settings, {}), build_bone_field(bone, settings));
}

}  // namespace
}  // namespace gracilis
