#include "charts.hpp"
#include "errors.hpp"
#include "moment_arms.hpp"
#include "opensim_models.hpp"
#include "preparing.hpp"
#include "run_handle.hpp"
#include "running.hpp"
#include "scene_handle.hpp"
#include "simulation_handle.hpp"
#include "tables.hpp"

#include <pybind11/pybind11.h>

#include <gracilis/core/parallel.hpp>

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <optional>

/// Warnings of the library go to stderr; what it only mentions is not said.
static void set_up_logging() {
  const auto logger = spdlog::stderr_color_mt("gracilis");
  logger->set_pattern("gracilis: %v");
  logger->set_level(spdlog::level::warn);
  spdlog::set_default_logger(logger);
}

/// For the rest of the process.
static void limit_threads(int threads) {
  static std::optional<gracilis::ThreadLimit> limit;
  limit.reset();
  limit.emplace(threads);
}

PYBIND11_MODULE(_core, module) {
  using namespace gracilis::python;
  module.attr("__version__") = GRACILIS_VERSION;
  set_up_logging();
  translate_errors();
  module.def("limit_threads", &limit_threads, pybind11::arg("threads"),
             "How many threads this process uses at most; 0: all of the machine's. Results do not depend on it.");
  bind_charts(module);
  bind_scene(module);
  bind_simulation(module);
  bind_moment_arms(module);
  bind_tables(module);
  bind_opensim(module);
  bind_preparing(module);
  bind_run(module);
  bind_running(module);
}
