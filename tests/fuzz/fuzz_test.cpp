#include <build_paths.hpp>

#include "targets.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

namespace gracilis::fuzz {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> files_of(const std::string& part, const std::string& target) {
  std::vector<fs::path> files;
  const fs::path folder = fs::path(build_paths::source_folder) / "tests" / "fuzz" / part / target;
  if (fs::exists(folder))
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

std::string bytes_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

/// A few small changes, as damage and mischief make them: bits, bytes, numbers, parts that are missing or doubled.
std::string mutant(std::string bytes, std::mt19937& random) {
  static const std::string numbers[] = {"-1", "0", "1e308", "nan", "2147483648", "4294967297", "99999999999999999999"};
  const auto below = [&](std::size_t limit) { return random() % std::max<std::size_t>(1, limit); };
  for (std::size_t changes = 1 + below(4); changes > 0; --changes) {
    const std::size_t at = below(bytes.size()), length = below(std::min<std::size_t>(64, bytes.size() - at) + 1);
    switch (below(6)) {
      case 0:
        if (at < bytes.size()) bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
        break;
      case 1:
        bytes.erase(at, length);
        break;
      case 2:
        bytes.insert(at, bytes.substr(at, length));
        break;
      case 3:
        bytes.insert(at, 1, static_cast<char>(below(256)));
        break;
      case 4:
        if (const std::size_t digit = bytes.find_first_of("0123456789", at); digit != std::string::npos)
          bytes.replace(digit, std::min(bytes.find_first_not_of("0123456789.", digit), bytes.size()) - digit,
                        numbers[below(std::size(numbers))]);
        break;
      default:
        bytes.resize(at);
    }
  }
  return bytes;
}

class Fuzz : public testing::TestWithParam<std::size_t> {
 protected:
  const Target& target() const { return targets()[GetParam()]; }
};

/// Enough to see that a reader still minds what it reads; tools/fuzz.sh looks for more.
constexpr int mutants_per_seed = 150;

TEST_P(Fuzz, seeds_are_read_as_they_are) {
  const std::vector<fs::path> seeds = files_of("seeds", target().name);
  ASSERT_FALSE(seeds.empty());
  for (const fs::path& seed : seeds) EXPECT_NO_THROW(target().read(bytes_of(seed))) << seed;
}

TEST_P(Fuzz, nothing_that_was_found_once_is_found_again) {
  for (const fs::path& found : files_of("regressions", target().name)) run(target(), bytes_of(found));
}

TEST_P(Fuzz, mutants_are_read_or_refused) {
  std::mt19937 random(20260801);
  for (const fs::path& seed : files_of("seeds", target().name)) {
    const std::string bytes = bytes_of(seed);
    for (int i = 0; i < mutants_per_seed; ++i) run(target(), mutant(bytes, random));
  }
  run(target(), "");
}

INSTANTIATE_TEST_SUITE_P(Readers, Fuzz, testing::Range<std::size_t>(0, targets().size()),
                         [](const auto& parameter) { return targets()[parameter.param].name; });

}  // namespace
}  // namespace gracilis::fuzz
