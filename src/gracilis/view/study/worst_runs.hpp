#pragma once

#include <gracilis/study/run_measures.hpp>
#include <gracilis/study/study.hpp>

#include <functional>
#include <string>
#include <vector>

namespace gracilis {

/// The runs of a study that come nearest to the bars of quality (simulate/gates.hpp) or lie farthest beyond, by what of
/// them measures.csv tells.
class WorstRuns {
 public:
  explicit WorstRuns(std::size_t count) : count_(count) {}  ///< of so many runs

  /// A run by its number in the study; kept where it is among the worst.
  void add(std::size_t run, const RunMeasures& measures);

  /// As HTML: each with what it reaches of which bar, its parameters, and a picture of that frame. Pictures are left
  /// out, and `warn` told, where this machine offers no OpenGL or a run is damaged.
  std::string text(const Study& study, const std::function<void(const std::string&)>& warn) const;

 private:
  struct Worst {
    std::size_t run = 0;
    Real reached = 0;  ///< of the bar: 1 is at it
    int frame = 0;
    std::string muscle, metric, value;
  };
  std::size_t count_;
  std::vector<Worst> worst_;  ///< the worst first
};

}  // namespace gracilis
