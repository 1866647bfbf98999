#include <gracilis/opensim/reader/model_notes.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gracilis::opensim {

std::vector<std::string> unsupported_notes(const Model& model, std::size_t first) {
  std::vector<std::string> notes;
  for (std::size_t i = first; i < model.unsupported.size(); ++i)
    notes.push_back(fmt::format("{}: not supported: {}", model.name, model.unsupported[i]));
  return notes;
}

std::vector<std::string> approximate_path_notes(const Model& model) {
  std::vector<std::string> notes;
  for (const Muscle& muscle : model.muscles)
    if (muscle.path.approximate)
      notes.push_back(
          fmt::format("{}: the path of {} wraps around several objects or one that is no cylinder: its length is "
                      "approximate",
                      model.name, muscle.name));
  return notes;
}

std::string missing_forces_note(const Model& model) {
  if (model.missing_forces.empty()) return {};
  return fmt::format("{} of the model's forces took no part, so results are not those of the whole model: {}",
                     model.missing_forces.size(), fmt::join(model.missing_forces, ", "));
}

}  // namespace gracilis::opensim
