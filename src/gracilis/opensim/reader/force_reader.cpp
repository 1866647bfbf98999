#include <gracilis/opensim/reader/force_reader.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/opensim/reader/muscle_reader.hpp>
#include <gracilis/opensim/reader/passive_force_reader.hpp>

#include <fmt/format.h>

namespace gracilis::opensim {

static Index body_of(const ModelReading& reading, const pugi::xml_node& node, const char* name) {
  const std::string body = reading.context.text(node, name);
  return body.empty() ? 0 : reading.frame(node, body, "").body;
}

static Actuator read_actuator(ModelReading& reading, const pugi::xml_node& node) {
  const XmlContext& context = reading.context;
  const std::string_view kind = node.name();
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
  if (applies_force(reading.context, node))
    reading.model.missing_forces.push_back(name_of(node).empty() ? node.name() : name_of(node));
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

/// One that lacks what it needs is left out.
static void add_passive_force(ModelReading& reading, const pugi::xml_node& node) {
  try {
    reading.model.passive_forces.push_back(read_passive_force(reading, node));
  } catch (const InputError& error) {
    leave_force_out(reading, node, fmt::format("left out: {}", error.problems().front().what));
  }
}

void read_forces(ModelReading& reading, const pugi::xml_node& holder, const char* set) {
  for (const pugi::xml_node& node : objects_of(holder, set)) {
    const std::string_view kind = node.name();
    const std::string name = name_of(node);
    const bool muscle = kind.find("Muscle") != std::string_view::npos || node.child("max_isometric_force");
    const bool passive = !muscle && is_passive_force(node);
    if (!muscle && !passive && kind != "CoordinateActuator" && kind != "PointActuator" && kind != "TorqueActuator") {
      leave_force_out(reading, node, "kind of force not known; left out");
      continue;
    }
    if (name.empty() && !passive) reading.context.fail(node, "has no name", "give every force its own name");
    if (!name.empty() && forget(reading.model, name))
      reading.leave_out(node, "replaces the force of this name that was there before");
    if (const std::string body = muscle || passive ? missing_body(reading, node) : ""; !body.empty())
      leave_force_out(reading, node, fmt::format("has a point on '{}', which does not exist; left out", body));
    else if (muscle)
      reading.model.muscles.push_back(read_muscle(reading, node));
    else if (passive)
      add_passive_force(reading, node);
    else
      reading.model.actuators.push_back(read_actuator(reading, node));
  }
}

}  // namespace gracilis::opensim
