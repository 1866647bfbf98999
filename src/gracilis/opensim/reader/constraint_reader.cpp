#include <gracilis/opensim/reader/constraint_reader.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/io/text_cells.hpp>
#include <gracilis/opensim/reader/body_reader.hpp>
#include <gracilis/opensim/reader/function_reader.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace gracilis::opensim {

static void read_coupler(ModelReading& reading, const pugi::xml_node& node) {
  Coupler coupler;
  coupler.name = name_of(node);
  const std::string independent = reading.context.text(node, "independent_coordinate_names");
  for (const std::string_view name : words_of(independent))
    coupler.independent.push_back(reading.coordinate(node, std::string(name)));
  coupler.dependent = reading.coordinate(node, reading.context.text(node, "dependent_coordinate_name"));
  const pugi::xml_node function = function_of(node, "coupled_coordinates_function");
  if (!function || coupler.independent.empty())
    reading.context.fail(node, "needs a function and a coordinate that it depends on", "give both");
  if (std::find(coupler.independent.begin(), coupler.independent.end(), coupler.dependent) != coupler.independent.end())
    reading.context.fail(node, "makes a coordinate depend on itself", "name another coordinate");
  coupler.function = read_function(reading.context, function, coupler.independent.size(), reading.model.unsupported);
  coupler.function.scale *= reading.context.number(node, "scale_factor", 1);
  reading.model.couplers.push_back(std::move(coupler));
}

std::pair<PlacedFrame, PlacedFrame> two_frames(ModelReading& reading, const pugi::xml_node& node) {
  const XmlContext& context = reading.context;
  read_frames(reading, node, "frames", name_of(node));
  PlacedFrame frames[2];
  for (const int side : {0, 1}) {
    const std::string number = std::to_string(side + 1), body = "body_" + number;
    std::string reference = context.socket(node, "frame" + number, body.c_str());
    if (reference.empty()) reference = context.socket(node, body, body.c_str());
    const PlacedFrame placed = reading.frame(node, reference, name_of(node));
    const RigidTransform within =
        body_fixed_xyz(context.vector(node, ("orientation_body_" + number).c_str(), Vec3::Zero()),
                       context.vector(node, ("location_body_" + number).c_str(), Vec3::Zero()));
    frames[side] = {placed.body, placed.in_body * within};
  }
  return {frames[0], frames[1]};
}

static LoopConstraint loop_from(ModelReading& reading, const pugi::xml_node& node, LoopConstraint::Kind kind) {
  LoopConstraint loop;
  loop.name = name_of(node);
  loop.kind = kind;
  const auto [first, second] = two_frames(reading, node);
  loop.body = first.body;
  loop.frame = first.in_body;
  loop.other_body = second.body;
  loop.other_frame = second.in_body;
  loop.distance = reading.context.number(node, "constant_distance", 0);
  if (loop.body == loop.other_body) reading.context.fail(node, "holds a body to itself", "name two bodies");
  if (kind == LoopConstraint::Kind::distance && !(loop.distance > 0))
    reading.context.fail(node, fmt::format("<constant_distance> is {}", loop.distance), "give a distance above zero");
  return loop;
}

/// One that lacks what it needs is left out.
static void read_loop(ModelReading& reading, const pugi::xml_node& node, LoopConstraint::Kind kind) {
  try {
    reading.model.loops.push_back(loop_from(reading, node, kind));
  } catch (const InputError& error) {
    reading.leave_out(node, fmt::format("constraint left out: {}", error.problems().front().what));
  }
}

/// Couplers after those that set what they depend on. A circle of them stays as it is written, and is told.
static void sort_couplers(ModelReading& reading, const pugi::xml_node& model) {
  std::vector<Coupler>& couplers = reading.model.couplers;
  std::vector<Coupler> sorted;
  while (!couplers.empty()) {
    const auto waits = [&](const Coupler& coupler) {
      return std::any_of(couplers.begin(), couplers.end(), [&](const Coupler& other) {
        return std::find(coupler.independent.begin(), coupler.independent.end(), other.dependent) !=
               coupler.independent.end();
      });
    };
    auto next = std::find_if_not(couplers.begin(), couplers.end(), waits);
    if (next == couplers.end()) {
      next = couplers.begin();
      reading.leave_out(model, fmt::format("the coupler '{}' is part of a circle; it is not kept exactly", next->name));
    }
    sorted.push_back(std::move(*next));
    couplers.erase(next);
  }
  couplers = std::move(sorted);
}

void read_constraints(ModelReading& reading, const pugi::xml_node& model) {
  for (const pugi::xml_node& node : objects_of(model, "ConstraintSet")) {
    const std::string_view kind = node.name();
    const bool off =
        reading.context.boolean(node, "isDisabled", false) || !reading.context.boolean(node, "isEnforced", true);
    if (off) continue;
    if (kind == "CoordinateCouplerConstraint")
      read_coupler(reading, node);
    else if (kind == "PointConstraint")
      read_loop(reading, node, LoopConstraint::Kind::point);
    else if (kind == "ConstantDistanceConstraint")
      read_loop(reading, node, LoopConstraint::Kind::distance);
    else if (kind == "WeldConstraint")
      read_loop(reading, node, LoopConstraint::Kind::weld);
    else
      reading.leave_out(node, "constraint left out");
  }
  sort_couplers(reading, model);
}

}  // namespace gracilis::opensim
