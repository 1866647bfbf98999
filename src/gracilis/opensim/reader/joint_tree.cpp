#include <gracilis/opensim/reader/joint_tree.hpp>

#include <fmt/format.h>

#include <optional>
#include <utility>

namespace gracilis::opensim {

/// Index of a new body without mass at the place of another.
static Index add_copy(Model& model, Index of) {
  Body copy;
  const std::string name = model.bodies[static_cast<std::size_t>(of)].name + "_copy";
  copy.name = name;
  for (int number = 2; index_of(model.bodies, copy.name) >= 0; ++number) copy.name = fmt::format("{}{}", name, number);
  model.bodies.push_back(std::move(copy));
  return static_cast<Index>(model.bodies.size()) - 1;
}

/// Closes a loop with a joint between two bodies that hang on the ground already. What is left of it to be hung there.
static std::optional<Joint> close_loop(ModelReading& reading, const pugi::xml_node& node, Joint joint) {
  Model& model = reading.model;
  const std::string held = model.bodies[static_cast<std::size_t>(joint.child_body)].name;
  LoopConstraint weld;
  weld.name = joint.name;
  weld.kind = LoopConstraint::Kind::weld;
  weld.other_body = joint.child_body;
  if (joint.type == "WeldJoint") {
    reading.leave_out(
        node, fmt::format("joint '{}' holds '{}', which another joint holds; it closes a loop", joint.name, held));
    weld.body = joint.parent_body;
    weld.frame = joint.parent_frame;
    weld.other_frame = joint.child_frame;
    model.loops.push_back(std::move(weld));
    return std::nullopt;
  }
  joint.child_body = weld.body = add_copy(model, joint.child_body);
  reading.leave_out(node,
                    fmt::format("joint '{}' moves '{}', which another joint holds; it closes a loop: it moves '{}', "
                                "which is welded to '{}'",
                                joint.name, held, model.bodies.back().name, held));
  model.loops.push_back(std::move(weld));
  return joint;
}

void sort_joints(ModelReading& reading, const pugi::xml_node& node) {
  Model& model = reading.model;
  std::vector<Joint> waiting = std::move(model.joints), sorted;
  std::vector<bool> reached(model.bodies.size(), false);
  reached[0] = true;
  const auto is_reached = [&](Index body) { return reached[static_cast<std::size_t>(body)]; };
  const auto add = [&](Joint joint) {
    for (const Index i : joint.coordinates)
      model.coordinates[static_cast<std::size_t>(i)].joint = static_cast<Index>(sorted.size());
    sorted.push_back(std::move(joint));
  };
  for (const Joint& joint : waiting)
    if (joint.child_body == 0)
      reading.context.fail(node, fmt::format("joint '{}' moves the ground", joint.name), "swap its parent and child");
  for (bool any = true; any;) {
    any = false;
    std::vector<Joint> later;
    for (Joint& joint : waiting) {
      if (is_reached(joint.child_body) || !is_reached(joint.parent_body)) {
        later.push_back(std::move(joint));
        continue;
      }
      reached[static_cast<std::size_t>(joint.child_body)] = any = true;
      add(std::move(joint));
    }
    waiting = std::move(later);
  }
  for (Joint& joint : waiting) {
    if (!is_reached(joint.parent_body))
      reading.context.fail(node, fmt::format("joint '{}' is part of a circle that never meets the ground", joint.name),
                           "let one of its bodies hang on the ground");
    if (std::optional<Joint> rest = close_loop(reading, node, std::move(joint))) add(std::move(*rest));
  }
  model.joints = std::move(sorted);
}

}  // namespace gracilis::opensim
