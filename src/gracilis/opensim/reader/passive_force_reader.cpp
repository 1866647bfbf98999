#include <gracilis/opensim/reader/passive_force_reader.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/opensim/functions/expression.hpp>
#include <gracilis/opensim/reader/constraint_reader.hpp>
#include <gracilis/opensim/reader/function_reader.hpp>
#include <gracilis/opensim/reader/muscle_reader.hpp>
#include <gracilis/opensim/reader/path_reader.hpp>

#include <fmt/format.h>

#include <map>
#include <string_view>

namespace gracilis::opensim {

static const std::map<std::string_view, PassiveForce::Kind>& passive_kinds() {
  using Kind = PassiveForce::Kind;
  static const std::map<std::string_view, Kind> kinds = {{"CoordinateLimitForce", Kind::limit},
                                                         {"SpringGeneralizedForce", Kind::coordinate_spring},
                                                         {"PathSpring", Kind::path_spring},
                                                         {"Ligament", Kind::ligament},
                                                         {"PointToPointSpring", Kind::point_spring},
                                                         {"BushingForce", Kind::bushing},
                                                         {"Blankevoort1991Ligament", Kind::toe_ligament},
                                                         {"ExpressionBasedBushingForce", Kind::formula_bushing},
                                                         {"ExpressionBasedCoordinateForce", Kind::formula_coordinate},
                                                         {"ExpressionBasedPointToPointForce", Kind::formula_points}};
  return kinds;
}

bool is_passive_force(const pugi::xml_node& node) { return passive_kinds().count(node.name()) > 0; }

/// Limits are in degrees where the coordinate is an angle, and so is what stiffness and damping are per.
static void read_limit(const ModelReading& reading, const pugi::xml_node& node, PassiveForce& force) {
  const XmlContext& context = reading.context;
  const Real unit = reading.model.coordinates[static_cast<std::size_t>(force.coordinate)].rotation ? radians(1) : 1;
  force.upper_limit = unit * context.number(node, "upper_limit", 0);
  force.lower_limit = unit * context.number(node, "lower_limit", 0);
  force.upper_stiffness = context.number(node, "upper_stiffness", 1) / unit;
  force.lower_stiffness = context.number(node, "lower_stiffness", 1) / unit;
  force.damping = context.number(node, "damping", 0.001) / unit;
  force.transition = unit * context.number(node, "transition", 0.1);
}

/// OpenSim's curve of a ligament that gives none.
static Function ligament_curve() {
  return simm_spline({-5, 0.998, 0.999, 1, 1.1, 1.2, 1.3, 1.4, 1.5, 1.6, 1.601, 1.602, 5},
                     {0, 0, 0, 0, 0.035, 0.12, 0.26, 0.55, 1.17, 2, 2, 2, 2});
}

/// A formula that must be understood; `trial` says which variables it may use.
static std::string formula(const XmlContext& context, const pugi::xml_node& node, const char* name,
                           const Variables& trial) {
  std::string text = context.text(node, name);
  if (text.empty()) return "0";
  try {
    value(text, trial);
  } catch (const InputError& error) {
    context.fail(node, error.problems().front().what, "");
  }
  return text;
}

static void read_bushing(ModelReading& reading, const pugi::xml_node& node, PassiveForce& force) {
  const XmlContext& context = reading.context;
  const auto [first, second] = two_frames(reading, node);
  force.body = first.body;
  force.frame = first.in_body;
  force.other_body = second.body;
  force.other_frame = second.in_body;
  if (force.kind == PassiveForce::Kind::formula_bushing)
    for (const char* name : {"Mx", "My", "Mz", "Fx", "Fy", "Fz"})
      force.formulas.push_back(formula(context, node, (std::string(name) + "_expression").c_str(),
                                       {{"theta_x", 0.1},
                                        {"theta_y", 0.1},
                                        {"theta_z", 0.1},
                                        {"delta_x", 0.1},
                                        {"delta_y", 0.1},
                                        {"delta_z", 0.1}}));
  else
    force.stiffnesses << context.vector(node, "rotational_stiffness", Vec3::Zero()),
        context.vector(node, "translational_stiffness", Vec3::Zero());
  force.dampings << context.vector(node, "rotational_damping", Vec3::Zero()),
      context.vector(node, "translational_damping", Vec3::Zero());
}

static void read_two_points(const ModelReading& reading, const pugi::xml_node& node, PassiveForce& force) {
  for (const int side : {1, 2}) {
    const std::string number = std::to_string(side);
    const PlacedFrame placed =
        reading.frame(node, reading.context.socket(node, "body" + number, ("body" + number).c_str()), "");
    const Vec3 point = reading.context.vector(node, ("point" + number).c_str(), Vec3::Zero());
    (side == 1 ? force.body : force.other_body) = placed.body;
    (side == 1 ? force.frame : force.other_frame) = placed.in_body * Eigen::Translation3d(point);
  }
}

/// A force on one coordinate.
static void read_coordinate_force(const ModelReading& reading, const pugi::xml_node& node, PassiveForce& force) {
  const XmlContext& context = reading.context;
  force.coordinate = reading.coordinate(node, context.socket(node, "coordinate", "coordinate"));
  if (force.kind == PassiveForce::Kind::limit) {
    read_limit(reading, node, force);
  } else if (force.kind == PassiveForce::Kind::formula_coordinate) {
    force.formulas = {formula(context, node, "expression", {{"q", 0.1}, {"qdot", 0.1}})};
  } else {
    force.stiffness = context.number(node, "stiffness", 0);
    force.rest_length = context.number(node, "rest_length", 0);
    force.damping = context.number(node, "viscosity", 0);
  }
}

/// A force along a path.
static void read_path_force(ModelReading& reading, const pugi::xml_node& node, PassiveForce& force) {
  const XmlContext& context = reading.context;
  const bool toe = force.kind == PassiveForce::Kind::toe_ligament;
  const char* length = toe ? "slack_length" : "resting_length";
  force.path = read_path(reading, node);
  force.rest_length = context.number(node, length, 0);
  if (!(force.rest_length > 0)) context.fail(node, fmt::format("has no <{}> above zero", length), "give it");
  force.stiffness = context.number(node, toe ? "linear_stiffness" : "stiffness", toe ? 1 : 0);
  force.damping = toe ? context.number(node, "damping_coefficient", 0.003) : context.number(node, "dissipation", 0);
  force.transition_strain = context.number(node, "transition_strain", 0.06);
  force.pcsa_force = context.number(node, "pcsa_force", 0);
  force.curve = ligament_curve();
  if (const pugi::xml_node curve = function_of(node, "force_length_curve"))
    force.curve = read_function(context, curve, 1, reading.model.unsupported);
}

PassiveForce read_passive_force(ModelReading& reading, const pugi::xml_node& node) {
  const XmlContext& context = reading.context;
  PassiveForce force;
  force.name = name_of(node);
  force.kind = passive_kinds().at(node.name());
  force.applies_force = applies_force(context, node);
  switch (force.kind) {
    case PassiveForce::Kind::limit:
    case PassiveForce::Kind::coordinate_spring:
    case PassiveForce::Kind::formula_coordinate:
      read_coordinate_force(reading, node, force);
      break;
    case PassiveForce::Kind::path_spring:
    case PassiveForce::Kind::ligament:
    case PassiveForce::Kind::toe_ligament:
      read_path_force(reading, node, force);
      break;
    case PassiveForce::Kind::point_spring:
      read_two_points(reading, node, force);
      force.stiffness = context.number(node, "stiffness", 1);
      force.rest_length = context.number(node, "rest_length", 0);
      break;
    case PassiveForce::Kind::formula_points:
      read_two_points(reading, node, force);
      force.formulas = {formula(context, node, "expression", {{"d", 0.1}, {"ddot", 0.1}})};
      break;
    case PassiveForce::Kind::bushing:
    case PassiveForce::Kind::formula_bushing:
      read_bushing(reading, node, force);
      break;
  }
  return force;
}

}  // namespace gracilis::opensim
