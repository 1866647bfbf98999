#include <gracilis/opensim/reader/muscle_reader.hpp>

#include <gracilis/opensim/reader/path_reader.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gracilis::opensim {

bool applies_force(const XmlContext& context, const pugi::xml_node& node) {
  return context.boolean(node, "appliesForce", !context.boolean(node, "isDisabled", false));
}

static Real positive(const XmlContext& context, const pugi::xml_node& node, const char* name, Real otherwise) {
  const Real value = context.number(node, name, otherwise);
  if (!(value > 0)) context.fail(node, fmt::format("<{}> is {}", name, value), "it must be larger than zero");
  return value;
}

/// Numbers of a curve's own element; those that it leaves out stay.
static void read_numbers(const XmlContext& context, const pugi::xml_node& curve,
                         const std::vector<std::pair<const char*, Real*>>& numbers) {
  if (!curve) return;
  for (const auto& [name, number] : numbers) *number = context.number(curve, name, *number);
}

/// The curves of a Millard2012EquilibriumMuscle. OpenSim takes minimum and end slopes of zero, unless fibers without
/// damping pull on an elastic tendon: then they must be above zero.
static MillardCurves read_millard(ModelReading& reading, const pugi::xml_node& node, const Muscle& muscle) {
  const XmlContext& context = reading.context;
  MillardShape s;
  const bool singular = muscle.fiber_damping == 0 && !muscle.ignore_tendon_compliance;
  const Real least = singular ? 0.1 : 0;
  s.minimum_value = 0.1;
  read_numbers(context, context.property(node, "ActiveForceLengthCurve"),
               {{"min_norm_active_fiber_length", &s.min_norm_active_fiber_length},
                {"transition_norm_fiber_length", &s.transition_norm_fiber_length},
                {"max_norm_active_fiber_length", &s.max_norm_active_fiber_length},
                {"shallow_ascending_slope", &s.shallow_ascending_slope},
                {"minimum_value", &s.minimum_value}});
  read_numbers(context, context.property(node, "ForceVelocityCurve"),
               {{"concentric_slope_at_vmax", &s.concentric_slope_at_vmax},
                {"concentric_slope_near_vmax", &s.concentric_slope_near_vmax},
                {"isometric_slope", &s.isometric_slope},
                {"eccentric_slope_at_vmax", &s.eccentric_slope_at_vmax},
                {"eccentric_slope_near_vmax", &s.eccentric_slope_near_vmax},
                {"max_eccentric_velocity_force_multiplier", &s.max_eccentric_velocity_force_multiplier},
                {"concentric_curviness", &s.concentric_curviness},
                {"eccentric_curviness", &s.eccentric_curviness}});
  s.minimum_value = singular ? std::max(s.minimum_value, least) : 0;
  if (!singular || std::min(s.concentric_slope_at_vmax, s.eccentric_slope_at_vmax) < least)
    s.concentric_slope_at_vmax = s.eccentric_slope_at_vmax = least;
  const pugi::xml_node fiber = context.property(node, "FiberForceLengthCurve");
  const pugi::xml_node tendon = context.property(node, "TendonForceLengthCurve");
  read_numbers(context, fiber,
               {{"strain_at_zero_force", &s.fiber_strain_at_zero_force},
                {"strain_at_one_norm_force", &s.fiber_strain_at_one_norm_force}});
  s.fiber_stiffness_at_one_norm_force = 2 / (s.fiber_strain_at_one_norm_force - s.fiber_strain_at_zero_force);
  read_numbers(context, fiber,
               {{"stiffness_at_low_force", &s.fiber_stiffness_at_low_force},
                {"stiffness_at_one_norm_force", &s.fiber_stiffness_at_one_norm_force},
                {"curviness", &s.fiber_curviness}});
  read_numbers(context, tendon, {{"strain_at_one_norm_force", &s.tendon_strain_at_one_norm_force}});
  s.tendon_stiffness_at_one_norm_force = 1.375 / s.tendon_strain_at_one_norm_force;
  read_numbers(context, tendon,
               {{"stiffness_at_one_norm_force", &s.tendon_stiffness_at_one_norm_force},
                {"norm_force_at_toe_end", &s.norm_force_at_toe_end},
                {"curviness", &s.tendon_curviness}});
  if (const std::string amiss = objection(s); !amiss.empty()) {
    reading.leave_out(node, amiss + "; the usual curves are taken");
    return MillardCurves();
  }
  return MillardCurves(s);
}

/// What a muscle's curves are made of.
static void read_curves(ModelReading& reading, const pugi::xml_node& node, Muscle& muscle) {
  const XmlContext& context = reading.context;
  const MuscleCurves kind = curves_of(muscle);
  muscle.ignore_tendon_compliance = context.boolean(node, "ignore_tendon_compliance", false);
  muscle.ignore_passive_force = context.boolean(node, "ignore_passive_fiber_force", false);
  muscle.fiber_damping = context.number(node, "fiber_damping", kind == MuscleCurves::millard ? 0.1 : 0);
  if (kind == MuscleCurves::millard && muscle.fiber_damping < 0.001) muscle.fiber_damping = 0;  // as OpenSim has it
  muscle.max_pennation_angle = context.number(node, "maximum_pennation_angle", muscle.max_pennation_angle);
  muscle.active_shape = positive(context, node, "KshapeActive", muscle.active_shape);
  muscle.velocity_shape = positive(context, node, "Af", muscle.velocity_shape);
  muscle.eccentric_force = positive(context, node, "Flen", muscle.eccentric_force);
  if (kind == MuscleCurves::thelen) {
    muscle.passive_shape = positive(context, node, "KshapePassive", muscle.passive_shape);
    muscle.fiber_strain = positive(context, node, "FmaxMuscleStrain", muscle.fiber_strain);
    muscle.tendon_strain = positive(context, node, "FmaxTendonStrain", muscle.tendon_strain);
  } else if (kind == MuscleCurves::millard) {
    muscle.millard = read_millard(reading, node, muscle);
  } else {
    muscle.passive_shape = 4;
    muscle.fiber_strain = positive(context, node, "passive_fiber_strain_at_one_norm_force", muscle.fiber_strain);
    muscle.tendon_strain = positive(context, node, "tendon_strain_at_one_norm_force", 0.049);
    muscle.active_width = positive(context, node, "active_force_width_scale", muscle.active_width);
  }
}

/// Before 30513 OpenSim wrote 0 where it meant nothing, and takes it so.
static Real read_min_control(const XmlContext& context, const pugi::xml_node& node, Real otherwise) {
  const Real least = context.number(node, "min_control", otherwise);
  return context.version < 30513 && least == 0 ? otherwise : least;
}

Muscle read_muscle(ModelReading& reading, const pugi::xml_node& node) {
  const XmlContext& context = reading.context;
  Muscle muscle;
  muscle.name = name_of(node);
  muscle.type = node.name();
  muscle.applies_force = applies_force(context, node);
  muscle.path = read_path(reading, node);
  muscle.max_isometric_force = context.number(node, "max_isometric_force", muscle.max_isometric_force);
  if (!(muscle.max_isometric_force >= 0))
    context.fail(node, fmt::format("<max_isometric_force> is {}", muscle.max_isometric_force), "give 0 or more");
  muscle.optimal_fiber_length = positive(context, node, "optimal_fiber_length", muscle.optimal_fiber_length);
  muscle.tendon_slack_length = context.number(node, "tendon_slack_length", muscle.tendon_slack_length);
  if (!(muscle.tendon_slack_length >= 0))
    context.fail(node, fmt::format("<tendon_slack_length> is {}", muscle.tendon_slack_length), "give 0 or more");
  muscle.pennation_angle_at_optimal = context.number(node, "pennation_angle_at_optimal", 0);
  if (const Real velocity = context.number(node, "max_contraction_velocity", muscle.max_contraction_velocity);
      velocity > 0)
    muscle.max_contraction_velocity = velocity;
  else
    reading.leave_out(
        node, fmt::format("<max_contraction_velocity> is {}; {} is taken", velocity, muscle.max_contraction_velocity));
  muscle.min_control = read_min_control(context, node, muscle.min_control);
  muscle.max_control = context.number(node, "max_control", muscle.max_control);
  read_curves(reading, node, muscle);
  if (!(std::abs(muscle.pennation_angle_at_optimal) < pi / 2))
    context.fail(node, fmt::format("is pennate by {} rad", muscle.pennation_angle_at_optimal), "give less than pi/2");
  return muscle;
}

}  // namespace gracilis::opensim
