#pragma once

#include <gracilis/io/run/run_layout.hpp>
#include <gracilis/simulate/gates.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace gracilis {

/// How a scene is run into a folder: what `run` and `demo` share on the command line, and gracilis.run has as keywords.
struct SessionOptions {
  std::filesystem::path out;    ///< the run folder; empty: runs/NAME of the scene
  int threads = 0;              ///< 0: all of the machine's
  bool resume = false;          ///< go on where the run in `out` was interrupted
  bool force = false;           ///< replace the run in `out`
  bool strict = false;          ///< exit with code 5 when a frame misses a quality gate
  bool yes = false;             ///< run also where it takes much room on the disk, without asking
  bool verbose = false;         ///< also say what is of interest to few
  int every = 1;                ///< record every which frame
  bool without_ramps = false;   ///< do not record the frames that lead from and to the capture pose
  bool without_fibers = false;  ///< do not follow fibers
  MeasureLevel measures = MeasureLevel::full;
  std::optional<RunLayout> layout;  ///< none: compact where surfaces took more than asking_bytes (run_plan.hpp)
  bool fiber_actions = false;       ///< also write moment arms and lines of action, where the method knows them
  bool corrections = false;         ///< frames also tell what each kind of constraint moved, where the method has these
  bool tables_only = false;         ///< record_tables (table_session.hpp) instead of a run
  bool pictures = true;             ///< charts and a preview at the end
  bool print_folder = true;         ///< its path to stdout, once the run is complete
  bool json = false;                ///< its summary to stdout instead, as JSON
  std::vector<std::string> command;  ///< the command line, for the manifest
};

}  // namespace gracilis
