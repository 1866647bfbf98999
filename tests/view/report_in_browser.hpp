#pragma once

#include <gracilis/view/report/report.hpp>

#include "view/browser.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <io/test_files.hpp>

#include <string>
#include <vector>

namespace gracilis {

/// The page in a browser, as people use it.
class ReportInBrowser : public testing::Test {
 protected:
  void SetUp() override {
    if (!Browser::is_there()) GTEST_SKIP() << "there is no /usr/bin/chromium";
    browser = &Browser::fresh();
  }

  void open(const std::vector<RecordedRun>& runs) {
    write_report(folder.path() / "report.html", runs);
    browser->open(folder.path() / "report.html");
    ASSERT_EQ(js("document.getElementById('canvas').getContext('webgl') !== null"), true) << "no WebGL";
  }

  nlohmann::json js(const std::string& expression) { return browser->evaluate(expression); }
  void expect_peace() {
    EXPECT_THAT(browser->complaints, testing::IsEmpty());
    EXPECT_THAT(browser->requests, testing::IsEmpty());
  }
  /// The middle of an element on the screen.
  Eigen::Vector2d middle(const std::string& selector) {
    const auto box = js("(b => [b.x + b.width / 2, b.y + b.height / 2])(document.querySelector('" + selector +
                        "').getBoundingClientRect())");
    return {box[0].get<double>(), box[1].get<double>()};
  }
  void click(const std::string& selector) {
    js("document.querySelector('" + selector + "').scrollIntoView({block: 'center'})");
    const Eigen::Vector2d at = middle(selector);
    browser->click(at.x(), at.y());
  }
  /// What the view shows, as one number per picture.
  std::string picture() { return js("document.getElementById('canvas').toDataURL()"); }

  TestFolder folder;
  Browser* browser = nullptr;
};

}  // namespace gracilis
