#include "opensim_model.hpp"

#include <gracilis/core/errors.hpp>
#include <gracilis/opensim/kinematics/loop_closer.hpp>
#include <gracilis/opensim/reader/model_reader.hpp>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

namespace gracilis {

opensim::Model read_opensim_model(const std::filesystem::path& path, bool strict) {
  opensim::Model model = opensim::read_model(path);
  report_unsupported(model, 0, strict);
  close_default_pose(model);
  return model;
}

void close_default_pose(opensim::Model& model, const std::vector<bool>& held) {
  if (const opensim::LoopClosure closure = opensim::assemble_defaults(model, held); closure.open > 1e-5)
    spdlog::warn("{}: its loops stay open by {:.3g} (m or rad) in its default pose", model.name, closure.open);
}

void report_unsupported(const opensim::Model& model, std::size_t first, bool strict) {
  for (std::size_t i = first; i < model.unsupported.size(); ++i)
    spdlog::warn("{}: not supported: {}", model.name, model.unsupported[i]);
  for (const opensim::Muscle& muscle : model.muscles)
    if (first == 0 && muscle.path.approximate)
      spdlog::warn(
          "{}: the path of {} wraps around several objects or one that is no cylinder: its length is approximate",
          model.name, muscle.name);
  if (strict && model.unsupported.size() > first)
    throw Error(ExitCode::unsupported, fmt::format("{} of the model's elements are not supported (--strict)",
                                                   model.unsupported.size() - first));
}

}  // namespace gracilis
