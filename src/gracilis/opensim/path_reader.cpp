#include <gracilis/opensim/function_reader.hpp>
#include <gracilis/opensim/model_parts.hpp>

#include <gracilis/io/text_cells.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace gracilis::opensim {

/// "+x", "-y" ...: the side a path stays on; "all" is both.
static void read_quadrant(const XmlContext& context, const pugi::xml_node& node, WrapObject& object) {
  const std::string quadrant = context.text(node, "quadrant");
  if (quadrant.empty() || quadrant == "all" || quadrant == "Unassigned") return;
  const char axis = quadrant.back();
  if (quadrant.size() > 2 || axis < 'x' || axis > 'z')
    context.fail(node, fmt::format("<quadrant> is '{}'", quadrant), "use all, +x, -x, +y, -y, +z or -z");
  object.side_axis = axis - 'x';
  object.side_sign = quadrant[0] == '-' ? -1 : 1;
}

void read_wrap_objects(ModelReading& reading, const pugi::xml_node& holder, const PlacedFrame& frame) {
  const XmlContext& context = reading.context;
  for (const pugi::xml_node& node : objects_of(holder, "WrapObjectSet")) {
    const std::string_view kind = node.name();
    const bool sphere = kind == "WrapSphere";
    if (!sphere && kind != "WrapCylinder") {
      reading.leave_out(node, "kind of wrap object not known; paths pass through it");
      continue;
    }
    if (!context.boolean(node, "active", true)) continue;
    WrapObject object;
    object.name = name_of(node);
    object.kind = sphere ? WrapObject::Kind::sphere : WrapObject::Kind::cylinder;
    object.body = frame.body;
    object.frame = frame.in_body * body_fixed_xyz(context.vector(node, "xyz_body_rotation", Vec3::Zero()),
                                                  context.vector(node, "translation", Vec3::Zero()));
    object.radius = context.number(node, "radius", 1);
    object.length = context.number(node, "length", 1);
    if (!(object.radius > 0) || !(object.length >= 0))
      context.fail(node, fmt::format("has the radius {} and the length {}", object.radius, object.length),
                   "both must be larger than zero");
    read_quadrant(context, node, object);
    if (index_of(reading.model.wrap_objects, object.name) >= 0)
      context.fail(node, "occurs twice", "give every wrap object its own name");
    reading.model.wrap_objects.push_back(std::move(object));
  }
}

static void read_range(ModelReading& reading, const pugi::xml_node& node, PathPoint& point) {
  const std::vector<Real> range = reading.context.numbers(node, "range");
  if (range.size() != 2) reading.context.fail(node, "needs a <range> of two values", "give them");
  point.condition = reading.coordinate(node, reading.context.socket(node, "coordinate", "coordinate"));
  point.range_min = range[0];
  point.range_max = range[1];
}

static void read_motion(ModelReading& reading, const pugi::xml_node& node, PathPoint& point) {
  point.moving = true;
  const char* names[3] = {"x", "y", "z"};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string name = names[i];
    const std::string coordinate = reading.context.socket(node, name + "_coordinate", (name + "_coordinate").c_str());
    const pugi::xml_node function = function_below(node.child((name + "_location").c_str()));
    if (!function) continue;
    point.moves_to[i] = read_function(reading.context, function, coordinate.empty() ? 0 : 1, reading.model.unsupported);
    if (!coordinate.empty() && point.moves_to[i].kind != Function::Kind::constant)
      point.moves_with[i] = reading.coordinate(node, coordinate);
  }
}

static PathPoint read_point(ModelReading& reading, const pugi::xml_node& node) {
  const XmlContext& context = reading.context;
  PathPoint point;
  point.name = name_of(node);
  const PlacedFrame frame = reading.frame(node, context.socket(node, "parent_frame", "body"), "");
  point.body = frame.body;
  point.location = frame.in_body * context.vector(node, "location", Vec3::Zero());
  const std::string_view kind = node.name();
  if (kind == "ConditionalPathPoint") read_range(reading, node, point);
  if (kind == "MovingPathPoint") {
    if (!frame.in_body.isApprox(RigidTransform::Identity(), 0))
      context.fail(node, "moves in a frame that is no body's own", "express it in the body's frame");
    read_motion(reading, node, point);
  }
  return point;
}

static void read_wraps(ModelReading& reading, const pugi::xml_node& node, Path& path) {
  for (const pugi::xml_node& each : objects_of(node, "PathWrapSet")) {
    const std::string name = last_name(reading.context.text(each, "wrap_object"));
    PathWrap wrap;
    wrap.object = index_of(reading.model.wrap_objects, name);
    if (wrap.object < 0) {
      reading.leave_out(each, fmt::format("wraps around '{}', which is left out", name));
      path.approximate = true;
      continue;
    }
    const std::vector<Real> range = reading.context.numbers(each, "range");
    if (range.size() == 2) {
      const auto number = [&](Real place) { return static_cast<int>(std::clamp(place, -1.0, 1e6)); };
      wrap.first_point = number(range[0]);
      wrap.last_point = number(range[1]);
    }
    const auto& object = reading.model.wrap_objects[static_cast<std::size_t>(wrap.object)];
    path.approximate = path.approximate || object.kind != WrapObject::Kind::cylinder;
    path.wraps.push_back(wrap);
  }
}

static Path read_function_path(ModelReading& reading, const pugi::xml_node& node) {
  Path path;
  const std::string coordinates = reading.context.text(node, "coordinate_paths");
  for (const std::string_view name : words_of(coordinates))
    path.function_coordinates.push_back(reading.coordinate(node, std::string(name)));
  const pugi::xml_node function = function_below(node.child("length_function"));
  if (!function || path.function_coordinates.empty())
    reading.context.fail(node, "needs <coordinate_paths> and a <length_function>", "give both");
  path.length_function =
      read_function(reading.context, function, path.function_coordinates.size(), reading.model.unsupported);
  return path;
}

Path read_path(ModelReading& reading, const pugi::xml_node& force) {
  for (const pugi::xml_node& holder : {force, force.child("path")}) {
    if (const pugi::xml_node node = holder.child("FunctionBasedPath")) return read_function_path(reading, node);
    const pugi::xml_node node = holder.child("GeometryPath");
    if (!node) continue;
    Path path;
    for (const pugi::xml_node& point : objects_of(node, "PathPointSet"))
      path.points.push_back(read_point(reading, point));
    if (path.points.size() < 2) reading.context.fail(force, "has a path with less than two points", "add points");
    read_wraps(reading, node, path);
    return path;
  }
  reading.context.fail(force, "has no path", "give it a GeometryPath");
}

}  // namespace gracilis::opensim
