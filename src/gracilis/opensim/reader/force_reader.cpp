#include <gracilis/opensim/reader/force_reader.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/opensim/reader/muscle_reader.hpp>
#include <gracilis/opensim/reader/passive_force_reader.hpp>

#include <fmt/format.h>

#include <string_view>

namespace gracilis::opensim {

/// What a force's kind is called now; OpenSim knows the old names in every version.
static std::string_view kind_of(const pugi::xml_node& node) {
  const std::string_view kind = node.name();
  if (kind == "GeneralizedForce") return "CoordinateActuator";
  if (kind == "Force") return "PointActuator";
  return kind == "Torque" ? "TorqueActuator" : kind;
}

static Index body_of(const ModelReading& reading, const pugi::xml_node& node, const char* name) {
  const std::string body = reading.context.text(node, name);
  return body.empty() ? 0 : reading.frame(node, body, "").body;
}

static Actuator read_actuator(ModelReading& reading, const pugi::xml_node& node) {
  const XmlContext& context = reading.context;
  const std::string_view kind = kind_of(node);
  Actuator actuator;
  actuator.name = name_of(node);
  actuator.applies_force = applies_force(context, node);
  actuator.optimal_force = context.number(node, "optimal_force", 1);
  actuator.min_control = context.number(node, "min_control", actuator.min_control);
  actuator.max_control = context.number(node, "max_control", actuator.max_control);
  if (kind == "CoordinateActuator") {
    actuator.coordinate = reading.coordinate(node, context.socket(node, "coordinate", "coordinate"));
    return actuator;
  }
  const bool point = kind == "PointActuator";
  actuator.kind = point ? Actuator::Kind::point : Actuator::Kind::torque;
  actuator.body = body_of(reading, node, point ? "body" : "bodyA");
  if (!point) actuator.other_body = body_of(reading, node, "bodyB");
  actuator.point = context.vector(node, "point", Vec3::Zero());
  actuator.point_is_global = context.boolean(node, "point_is_global", false);
  actuator.direction = context.vector(node, point ? "direction" : "axis", Vec3::UnitX());
  actuator.direction_is_global = context.boolean(node, point ? "force_is_global" : "torque_is_global", true);
  if (!(actuator.direction.norm() > 1e-9)) context.fail(node, "has an axis without length", "give it a direction");
  actuator.direction.normalize();
  return actuator;
}

/// Takes the force of this name away; whether there was one.
static bool forget(Model& model, const std::string& name) {
  const auto is_it = [&](const auto& force) { return force.name == name; };
  return std::erase_if(model.muscles, is_it) + std::erase_if(model.actuators, is_it) +
             std::erase_if(model.passive_forces, is_it) >
         0;
}

/// A force that takes no part.
static void leave_force_out(ModelReading& reading, const pugi::xml_node& node, const std::string& why) {
  reading.leave_out(node, why);
  bool acts = true;
  try {
    acts = applies_force(reading.context, node);
  } catch (const InputError&) {  // what cannot be read may well be why it is left out
  }
  if (acts) reading.model.missing_forces.push_back(name_of(node).empty() ? node.name() : name_of(node));
}

/// The first body that a muscle's points name and the model does not have; empty: it has all.
static std::string missing_body(const ModelReading& reading, const pugi::xml_node& force) {
  for (const pugi::xml_node& holder : {force, force.child("path")})
    for (const pugi::xml_node& point : objects_of(holder.child("GeometryPath"), "PathPointSet"))
      if (const std::string body = reading.context.socket(point, "parent_frame", "body");
          !reading.knows_frame(point, body))
        return body.empty() ? "''" : body;
  return "";
}

static bool is_muscle(const pugi::xml_node& node) {
  return std::string_view(node.name()).find("Muscle") != std::string_view::npos || node.child("max_isometric_force");
}

static bool is_actuator(const pugi::xml_node& node) {
  const std::string_view kind = kind_of(node);
  return kind == "CoordinateActuator" || kind == "PointActuator" || kind == "TorqueActuator";
}

/// Adds it to the forces of its kind. One of its name that was there before goes, once this one is known to be whole.
static void add_whole_force(ModelReading& reading, const pugi::xml_node& node) {
  const auto add = [&](auto force, auto& forces) {
    if (!force.name.empty() && forget(reading.model, force.name))
      reading.leave_out(node, "replaces the force of this name that was there before");
    forces.push_back(std::move(force));
  };
  const bool passive = !is_muscle(node) && is_passive_force(node);
  if (name_of(node).empty() && !passive) reading.context.fail(node, "has no name", "give every force its own name");
  if (is_muscle(node))
    add(read_muscle(reading, node), reading.model.muscles);
  else if (passive)
    add(read_passive_force(reading, node), reading.model.passive_forces);
  else
    add(read_actuator(reading, node), reading.model.actuators);
}

/// One that lacks what it needs is left out, and the others are read.
static void read_force(ModelReading& reading, const pugi::xml_node& node) {
  if (!is_muscle(node) && !is_passive_force(node) && !is_actuator(node))
    return leave_force_out(reading, node, "kind of force not known; left out");
  if (const std::string body = is_actuator(node) ? "" : missing_body(reading, node); !body.empty())
    return leave_force_out(reading, node, fmt::format("has a point on '{}', which does not exist; left out", body));
  try {
    add_whole_force(reading, node);
  } catch (const InputError& error) {
    leave_force_out(reading, node, fmt::format("left out: {}", error.problems().front().what));
  }
}

void read_forces(ModelReading& reading, const pugi::xml_node& holder, const char* set) {
  for (const pugi::xml_node& node : objects_of(holder, set)) read_force(reading, node);
}

}  // namespace gracilis::opensim
