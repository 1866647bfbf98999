#pragma once

#include <gracilis/core/errors.hpp>

#include <build_paths.hpp>

#include <gtest/gtest.h>

#include <sys/resource.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

namespace gracilis {

/// A folder of its own for one test, gone afterwards.
class TestFolder {
 public:
  TestFolder() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    path_ = std::filesystem::path(testing::TempDir()) / (std::string(test->test_suite_name()) + "." + test->name());
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~TestFolder() { std::filesystem::remove_all(path_); }
  TestFolder(const TestFolder&) = delete;
  TestFolder& operator=(const TestFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path write(const std::string& name, const std::string& content) const {
    std::ofstream(path_ / name, std::ios::binary) << content;
    return path_ / name;
  }

 private:
  std::filesystem::path path_;
};

/// Where the real data is: GRACILIS_DATA, else ../shared/data beside the checkout.
inline std::filesystem::path data_root() {
  if (const char* root = std::getenv("GRACILIS_DATA")) return root;
  return std::filesystem::path(build_paths::source_folder) / ".." / "shared" / "data";
}

inline std::string message_of_input_error(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& error) {
    EXPECT_EQ(error.code(), ExitCode::unreadable_input);
    return error.what();
  }
  ADD_FAILURE() << "no InputError";
  return "";
}

/// The same where no file may become larger than 10 kB, which fails like a disk without space.
inline std::string message_on_a_full_disk(const std::function<void()>& action) {
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit small = before;
  small.rlim_cur = 10000;
  setrlimit(RLIMIT_FSIZE, &small);
  std::string text = message_of_input_error(action);
  setrlimit(RLIMIT_FSIZE, &before);
  return text;
}

}  // namespace gracilis

/// Skips the test where the real data is not at hand.
#define GRACILIS_NEEDS_DATA(file) \
  if (!std::filesystem::exists(gracilis::data_root() / (file))) GTEST_SKIP() << "no " << gracilis::data_root() / (file)
