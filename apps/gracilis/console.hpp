#pragma once

#include <chrono>
#include <string>

namespace gracilis {

/// Log lines go to stderr, as "warning: ...", in color only on a terminal and only where NO_COLOR is not set.
/// Control characters of texts from files, as those that move a terminal's cursor, become '?'.
void set_up_logging();

/// How far a run has come: one line that redraws itself on a terminal, a log line for every tenth of the run elsewhere.
class Progress {
 public:
  Progress(int first, int last);
  ~Progress() { clear(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void show(int done);
  /// Takes the line away, so that a log line can stand in its place.
  void clear();

 private:
  std::string time_left(int done) const;

  int first_, last_;
  int tenth_ = 0;
  bool terminal_, drawn_ = false;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace gracilis
