#include <gracilis/opensim/reader/crossed_coordinates.hpp>

#include <gracilis/core/sort_unique.hpp>

#include <algorithm>
#include <set>

namespace gracilis::opensim {

/// The joints from a body to the ground.
static std::set<std::size_t> chain_of(const Model& model, Index body) {
  std::set<std::size_t> chain;
  for (std::size_t i = model.joints.size(); i-- > 0;) {  // parents stand before children
    if (model.joints[i].child_body != body) continue;
    chain.insert(i);
    body = model.joints[i].parent_body;
  }
  return chain;
}

/// The joints that some of the chains hold, but not all.
static std::vector<std::size_t> crossed_joints(const Model& model, const std::vector<std::set<std::size_t>>& chains) {
  std::vector<std::size_t> crossed;
  for (std::size_t joint = 0; joint < model.joints.size(); ++joint) {
    const auto holds = [&](const std::set<std::size_t>& chain) { return chain.count(joint) > 0; };
    const auto count = static_cast<std::size_t>(std::count_if(chains.begin(), chains.end(), holds));
    if (count > 0 && count < chains.size()) crossed.push_back(joint);
  }
  return crossed;
}

std::vector<Index> crossed_coordinates(const Model& model, const Path& path) {
  std::vector<Index> result = path.function_coordinates;
  std::vector<std::set<std::size_t>> chains;
  for (const PathPoint& point : path.points) chains.push_back(chain_of(model, point.body));
  for (const PathWrap& wrap : path.wraps)
    chains.push_back(chain_of(model, model.wrap_objects[static_cast<std::size_t>(wrap.object)].body));
  for (const std::size_t joint : crossed_joints(model, chains))
    result.insert(result.end(), model.joints[joint].coordinates.begin(), model.joints[joint].coordinates.end());
  sort_unique(result);
  return result;
}

std::vector<Index> bodies_between(const Model& model, const Path& path, const std::vector<Index>& more) {
  std::set<Index> bodies(more.begin(), more.end());
  for (const PathPoint& point : path.points) bodies.insert(point.body);
  std::vector<std::set<std::size_t>> chains;
  for (const Index body : bodies) chains.push_back(chain_of(model, body));
  for (const std::size_t joint : crossed_joints(model, chains))
    bodies.insert({model.joints[joint].parent_body, model.joints[joint].child_body});
  return {bodies.begin(), bodies.end()};
}

}  // namespace gracilis::opensim
