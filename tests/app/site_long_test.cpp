#include "app/program.hpp"
#include "io/test_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gracilis {

/// docs/site.sh follows every link of what it built, and counts Doxygen's warnings.
TEST(Site, is_built_without_a_warning_and_every_link_leads_somewhere) {
  if (!said_by("dpkg-query -W mkdocs mkdocs-material doxygen libjs-mathjax mandoc >/dev/null || echo missing").empty())
    GTEST_SKIP() << "mkdocs, mkdocs-material, doxygen, libjs-mathjax or mandoc are not installed";
  const TestFolder folder;
  const std::string said = said_by("OUT='" + folder.path().string() + "' GRACILIS='" + build_paths::program + "' '" +
                                   build_paths::source_folder + "/docs/site.sh'\necho \"exit $?\"");
  EXPECT_THAT(said, testing::HasSubstr("exit 0\n"));
  EXPECT_THAT(said, testing::HasSubstr(" 0 warnings"));
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "site/commands/gracilis-run.html"));
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "site/api/index.html"));
}

}  // namespace gracilis
