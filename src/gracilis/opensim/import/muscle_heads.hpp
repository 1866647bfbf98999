#pragma once

#include <gracilis/opensim/reader/model.hpp>

#include <string>
#include <vector>

namespace gracilis::opensim {

/// Muscles of a model that are heads of one.
struct MuscleHeads {
  std::string name;                  ///< of the muscle, by muscle_of_head
  std::vector<const Muscle*> heads;  ///< two or more, in the model's order
};

/// Which of these muscles are heads of one: called so, with their insertions on one body and the origins of more than
/// half of them on one, too.
std::vector<MuscleHeads> heads_among(const std::vector<const Muscle*>& muscles);

/// The model's muscles that are called heads of this one, which the model does not have itself.
std::vector<std::string> heads_in_model(const Model& model, const std::string& muscle);

/// Why a head of the model is not written from a run that has it in a sheet.
std::string part_of_sheet(const std::string& head, const std::string& sheet);

}  // namespace gracilis::opensim
