#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace gracilis {

/// Chromium without a window, driven by the DevTools protocol through pipes.
class Browser {
 public:
  /// False where there is no Chromium: tests then say 'skipped'.
  static bool is_there();

  /// The process's only one, with nothing in it: to start one takes longer than most tests. Throws std::runtime_error
  /// when it does not start.
  static Browser& fresh();

  ~Browser();
  Browser(const Browser&) = delete;
  Browser& operator=(const Browser&) = delete;

  /// Opens a file and waits until it has been loaded.
  void open(const std::filesystem::path& file);
  /// Of the page, pixels, smaller than a window may be.
  void set_size(int width, int height);
  /// The value of a JavaScript expression; fails with the exception's text where it throws. Waits for promises.
  nlohmann::json evaluate(const std::string& expression);
  void press(const std::string& key);
  void click(double x, double y);
  void drag(double x, double y, double to_x, double to_y);
  void wheel(double x, double y, double delta);
  void screenshot(const std::filesystem::path& file);
  /// As PDF, as a printer would see it.
  std::string print();

  std::vector<std::string> complaints;  ///< errors and warnings on the console, and exceptions
  std::vector<std::string> requests;    ///< everything that was asked for beside the file itself and data: addresses

 private:
  Browser(int width, int height);
  void load(const std::string& address);
  void forget();  ///< the page, its size, where the mouse was, and what was heard
  nlohmann::json call(const std::string& method, const nlohmann::json& parameters = nlohmann::json::object());
  nlohmann::json read_message();
  void note(const nlohmann::json& event);
  void mouse(const std::string& type, double x, double y, int buttons);

  int process_ = -1, to_ = -1, from_ = -1, calls_ = 0;
  bool loaded_ = false;
  std::string session_, address_, pending_;
  std::filesystem::path profile_;
};

}  // namespace gracilis
