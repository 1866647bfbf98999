#include "opensim_model.hpp"

#include <gracilis/core/errors.hpp>
#include <gracilis/opensim/kinematics/loop_closer.hpp>
#include <gracilis/opensim/reader/model_notes.hpp>
#include <gracilis/opensim/reader/model_reader.hpp>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

namespace gracilis {

opensim::Model read_opensim_model(const std::filesystem::path& path, bool strict) {
  opensim::Model model = opensim::read_model(path);
  for (const std::string& note : opensim::approximate_path_notes(model)) spdlog::warn("{}", note);
  report_unsupported(model, 0, strict);
  close_default_pose(model);
  return model;
}

void close_default_pose(opensim::Model& model, const std::vector<bool>& held) {
  const std::string note = opensim::open_loops_note(model, opensim::assemble_defaults(model, held));
  if (!note.empty()) spdlog::warn("{}", note);
}

void report_unsupported(const opensim::Model& model, std::size_t first, bool strict) {
  for (const std::string& note : opensim::unsupported_notes(model, first)) spdlog::warn("{}", note);
  if (strict && model.unsupported.size() > first)
    throw Error(ExitCode::unsupported, fmt::format("{} of the model's elements are not supported (--strict)",
                                                   model.unsupported.size() - first));
}

}  // namespace gracilis
