#include <gracilis/opensim/import/muscle_heads.hpp>

#include <gracilis/opensim/import/muscle_names.hpp>

#include <algorithm>
#include <map>

namespace gracilis::opensim {

static Index origin_body(const Muscle* muscle) { return muscle->path.points.front().body; }
static Index insertion_body(const Muscle* muscle) { return muscle->path.points.back().body; }

static bool lie_together(const std::vector<const Muscle*>& heads) {
  const auto inserts_beside = [&](const Muscle* head) { return insertion_body(head) == insertion_body(heads[0]); };
  if (heads.size() < 2 || !std::all_of(heads.begin(), heads.end(), inserts_beside)) return false;
  std::map<Index, std::size_t> origins;
  for (const Muscle* head : heads) ++origins[origin_body(head)];
  return std::any_of(origins.begin(), origins.end(), [&](const auto& each) { return 2 * each.second > heads.size(); });
}

std::vector<MuscleHeads> heads_among(const std::vector<const Muscle*>& muscles) {
  std::vector<MuscleHeads> groups;
  for (const Muscle* muscle : muscles) {
    const std::string name = muscle_of_head(muscle->name);
    if (name.empty() || muscle->path.points.empty()) continue;
    auto group = std::find_if(groups.begin(), groups.end(), [&](const MuscleHeads& each) { return each.name == name; });
    if (group == groups.end()) group = groups.insert(groups.end(), {name, {}});
    group->heads.push_back(muscle);
  }
  std::erase_if(groups, [](const MuscleHeads& group) { return !lie_together(group.heads); });
  return groups;
}

std::vector<std::string> heads_in_model(const Model& model, const std::string& muscle) {
  std::vector<std::string> heads;
  for (const Muscle& each : model.muscles)
    if (muscle_of_head(each.name) == muscle) heads.push_back(each.name);
  return heads;
}

std::string part_of_sheet(const std::string& head, const std::string& sheet) {
  return head + ": the run has it as a part of " + sheet;
}

}  // namespace gracilis::opensim
