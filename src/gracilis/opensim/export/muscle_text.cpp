#include <gracilis/opensim/export/muscle_text.hpp>

#include <gracilis/opensim/export/run_lengths.hpp>
#include <gracilis/opensim/export/xml_text.hpp>
#include <gracilis/opensim/reader/xml.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gracilis::opensim {

/// The coordinate that a component which stays is written with: OpenSim wants one for each.
static Index any_coordinate(const PathPoint& point) {
  for (const Index with : point.moves_with)
    if (with >= 0) return with;
  return 0;
}

static std::string moved_component_text(const Function& function) {
  if (function.kind == Function::Kind::constant)
    return fmt::format("<Constant><value>{}</value></Constant>", function.scale * function.coefficients[0]);
  std::vector<Real> y;
  for (const Real knot : function.knots) y.push_back(value(function, {knot}));
  return fmt::format("<SimmSpline><x>{}</x><y>{}</y></SimmSpline>", fmt::join(function.knots, " "), fmt::join(y, " "));
}

/// What an element is linked to: 4.x has sockets with components' paths, 3.x elements with their names.
static std::string link_text(const Model& model, const std::string& socket, const std::string& old_name,
                             const std::string& path) {
  const bool old = model.version < 40000;
  return fmt::format("            <{0}>{1}</{0}>\n", old ? old_name : "socket_" + socket,
                     xml_text(old ? last_name(path) : path));
}

static std::string moving_text(const Model& model, const PathPoint& point) {
  std::string text;
  const char* names[3] = {"x", "y", "z"};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string link = std::string(names[i]) + "_coordinate";
    const Index with = point.moves_with[i] < 0 ? any_coordinate(point) : point.moves_with[i];
    text += link_text(model, link, link, coordinate_path(model, with)) +
            fmt::format("            <{0}_location>{1}</{0}_location>\n", names[i],
                        moved_component_text(point.moves_to[i]));
  }
  return text;
}

static std::string point_text(const Model& model, const PathPoint& point) {
  const std::string& body = model.bodies[static_cast<std::size_t>(point.body)].name;
  const std::string frame = point.body == 0 ? "/ground" : "/bodyset/" + body;
  const char* kind = point.moving ? "MovingPathPoint" : point.condition >= 0 ? "ConditionalPathPoint" : "PathPoint";
  std::string text = fmt::format("          <{} name=\"{}\">\n", kind, xml_text(point.name)) +
                     link_text(model, "parent_frame", "body", frame);
  text += point.moving ? moving_text(model, point)
                       : fmt::format("            <location>{} {} {}</location>\n", point.location.x(),
                                     point.location.y(), point.location.z());
  if (!point.moving && point.condition >= 0)
    text += link_text(model, "coordinate", "coordinate", coordinate_path(model, point.condition)) +
            fmt::format("            <range>{} {}</range>\n", point.range_min, point.range_max);
  return text + fmt::format("          </{}>\n", kind);
}

static std::string path_wrap_text(const Model& model, const PathWrap& wrap, std::size_t number) {
  const std::string& object = model.wrap_objects[static_cast<std::size_t>(wrap.object)].name;
  if (object.ends_with("/V")) return "";  // the second cylinder of the object before it
  const char* plane = wrap.plane == WrapSurface::Plane::hybrid     ? "hybrid"
                      : wrap.plane == WrapSurface::Plane::midpoint ? "midpoint"
                                                                   : "axial";
  return fmt::format(
      "          <PathWrap name=\"wrap{}\"><wrap_object>{}</wrap_object><method>{}</method><range>{} "
      "{}</range></PathWrap>\n",
      number, xml_text(object), plane, wrap.first_point, wrap.last_point);
}

std::string point_set_text(const Model& model, const Path& path) {
  std::string text = "          <PathPointSet><objects>\n";
  for (const PathPoint& point : path.points) text += point_text(model, point);
  return text + "          </objects></PathPointSet>\n";
}

std::string muscle_text(const Model& model, const Muscle& muscle) {
  const std::string type = muscle.type.empty() ? "Thelen2003Muscle" : muscle.type;
  std::string text = fmt::format(
      "      <{} name=\"{}\">\n        <max_isometric_force>{}</max_isometric_force>\n"
      "        <optimal_fiber_length>{}</optimal_fiber_length>\n"
      "        <tendon_slack_length>{}</tendon_slack_length>\n"
      "        <pennation_angle_at_optimal>{}</pennation_angle_at_optimal>\n"
      "        <max_contraction_velocity>{}</max_contraction_velocity>\n        <GeometryPath name=\"path\">\n",
      type, xml_text(muscle.name), muscle.max_isometric_force, muscle.optimal_fiber_length, muscle.tendon_slack_length,
      muscle.pennation_angle_at_optimal, muscle.max_contraction_velocity);
  text += point_set_text(model, muscle.path);
  if (!muscle.path.wraps.empty()) {
    text += "          <PathWrapSet><objects>\n";
    for (std::size_t i = 0; i < muscle.path.wraps.size(); ++i)
      text += path_wrap_text(model, muscle.path.wraps[i], i + 1);
    text += "          </objects></PathWrapSet>\n";
  }
  return text + fmt::format("        </GeometryPath>\n      </{}>\n", type);
}

}  // namespace gracilis::opensim
