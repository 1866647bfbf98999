#include <gracilis/opensim/reader/path_reader.hpp>

#include <gracilis/opensim/reader/function_reader.hpp>

#include <gracilis/io/text_cells.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace gracilis::opensim {

/// The name of a double obstacle's second cylinder goes on so.
static const char* const second_cylinder = "/V";

/// "+x", "-y" ...: the side a path stays on; "all" is both.
static void read_quadrant(const XmlContext& context, const pugi::xml_node& node, WrapSurface& surface) {
  const std::string quadrant = lower_case(context.text(node, "quadrant"));
  if (quadrant.empty() || quadrant == "all" || quadrant == "unassigned") return;
  const char axis = quadrant.back();
  if (quadrant.size() > 2 || axis < 'x' || axis > 'z')
    context.fail(node, fmt::format("<quadrant> is '{}'", quadrant), "use all, +x, -x, +y, -y, +z or -z");
  surface.side_axis = axis - 'x';
  surface.side_sign = quadrant[0] == '-' ? -1 : 1;
}

static constexpr Real largest_size = 1e6;  // m

static Real size_of(const XmlContext& context, const pugi::xml_node& node, const char* name, Real otherwise) {
  const Real size = context.number(node, name, otherwise);
  if (!(size > 0 && size < largest_size))
    context.fail(node, fmt::format("<{}> is {}", name, size), "it must be above zero and below 1,000,000 m");
  return size;
}

/// Obstacles are passed in the sense of a right or a left hand about z.
static int read_hand(const XmlContext& context, const pugi::xml_node& node, const char* name) {
  const std::string hand = context.text(node, name);
  const bool left = hand.starts_with("left") || hand.starts_with("Left");
  if (!left && !hand.empty() && hand != "Unassigned" && !hand.starts_with("right") && !hand.starts_with("Right"))
    context.fail(node, fmt::format("<{}> is '{}'", name, hand), "use righthand or lefthand");
  return left ? -1 : 1;
}

/// OpenSim wraps around obstacles of 0.8 times the radius that they are given.
static constexpr Real obstacle_share = 0.8;

/// Radius and hand of an obstacle: "radius" and "wrapDirection", of the two of a double one "radiusUcyl" and so on.
static void make_obstacle(const XmlContext& context, const pugi::xml_node& node, const std::string& radius,
                          const std::string& hand, WrapSurface& surface) {
  surface.kind = WrapSurface::Kind::cylinder;
  surface.radius = obstacle_share * size_of(context, node, radius.c_str(), 1);
  surface.hand = read_hand(context, node, hand.c_str());
  surface.length = 1e6;  // they are cylinders without end
}

/// What an element of this kind is; false for a kind that is not known.
static bool read_shape(const XmlContext& context, const pugi::xml_node& node, WrapSurface& surface) {
  const std::string_view kind = node.name();
  if (kind == "WrapCylinder") {
    surface.radius = size_of(context, node, "radius", 1);
    surface.length = context.number(node, "length", 1);
    if (!(surface.length >= 0)) context.fail(node, fmt::format("has the length {}", surface.length), "give 0 or more");
  } else if (kind == "WrapSphere" || kind == "WrapSphereObst") {
    surface.kind = WrapSurface::Kind::sphere;
    surface.radius = (kind == "WrapSphere" ? 1 : obstacle_share) * size_of(context, node, "radius", 1);
  } else if (kind == "WrapEllipsoid") {
    surface.kind = WrapSurface::Kind::ellipsoid;
    surface.radii = context.vector(node, "dimensions", Vec3::Constant(-1));
    if (!(surface.radii.minCoeff() > 0 && surface.radii.maxCoeff() < largest_size))
      context.fail(node, "needs <dimensions> of three radii above zero", "give them, below 1,000,000 m");
  } else if (kind == "WrapTorus") {
    surface.kind = WrapSurface::Kind::torus;
    surface.radius = size_of(context, node, "inner_radius", -1);
    surface.ring_radius = size_of(context, node, "outer_radius", -1);
    if (surface.ring_radius <= surface.radius)
      context.fail(node, fmt::format("has the radii {} and {}", surface.radius, surface.ring_radius),
                   "the outer one must be larger");
  } else if (kind == "WrapCylinderObst") {
    make_obstacle(context, node, "radius", "wrapDirection", surface);
  } else if (kind == "WrapDoubleCylinderObst") {
    make_obstacle(context, node, "radiusUcyl", "wrapUcylDirection", surface);
  } else {
    return false;
  }
  return true;
}

/// The second cylinder of a double obstacle may be on another body.
static void add_second_cylinder(ModelReading& reading, const pugi::xml_node& node, WrapObject object) {
  const XmlContext& context = reading.context;
  make_obstacle(context, node, "radiusVcyl", "wrapVcylDirection", object.surface);
  object.name += second_cylinder;
  const std::string body = context.text(node, "wrapVcylHomeBodyName");
  if (!body.empty() && body != "Unassigned") object.body = reading.frame(node, body, "").body;
  object.frame = body_fixed_xyz(context.vector(node, "xyz_body_rotationVcyl", Vec3::Zero()),
                                context.vector(node, "translationVcyl", Vec3::Zero()));
  reading.model.wrap_objects.push_back(std::move(object));
}

void read_wrap_objects(ModelReading& reading, const pugi::xml_node& holder, const PlacedFrame& frame) {
  const XmlContext& context = reading.context;
  for (const pugi::xml_node& node : objects_of(holder, "WrapObjectSet")) {
    WrapObject object;
    object.name = name_of(node);
    object.body = frame.body;
    object.frame = frame.in_body * body_fixed_xyz(context.vector(node, "xyz_body_rotation", Vec3::Zero()),
                                                  context.vector(node, "translation", Vec3::Zero()));
    if (!read_shape(context, node, object.surface)) {
      reading.leave_out(node, "kind of wrap object not known; paths pass through it");
      continue;
    }
    object.active = context.boolean(node, "active", true);
    read_quadrant(context, node, object.surface);
    if (index_of(reading.model.wrap_objects, object.name) >= 0) {
      reading.leave_out(node, "has the name of another wrap object; paths run around the first, as in OpenSim");
      continue;
    }
    reading.model.wrap_objects.push_back(object);
    if (std::string_view(node.name()) == "WrapDoubleCylinderObst") add_second_cylinder(reading, node, object);
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
    const pugi::xml_node function = function_of(node, (name + "_location").c_str());
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

static WrapSurface::Plane read_plane(const XmlContext& context, const pugi::xml_node& node) {
  const std::string method = lower_case(context.text(node, "method"));
  if (method.empty() || method == "hybrid" || method == "unassigned") return WrapSurface::Plane::hybrid;
  if (method == "midpoint") return WrapSurface::Plane::midpoint;
  if (method == "axial") return WrapSurface::Plane::axial;
  context.fail(node, fmt::format("<method> is '{}'", method), "use hybrid, midpoint or axial");
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
    if (!reading.model.wrap_objects[static_cast<std::size_t>(wrap.object)].active) continue;
    const std::vector<Real> range = reading.context.numbers(each, "range");
    if (range.size() == 2) {
      const auto number = [&](Real place) { return static_cast<int>(std::clamp(place, -1.0, 1e6)); };
      wrap.first_point = number(range[0]);
      wrap.last_point = number(range[1]);
    }
    wrap.plane = read_plane(reading.context, each);
    const WrapSurface& surface = reading.model.wrap_objects[static_cast<std::size_t>(wrap.object)].surface;
    path.approximate = path.approximate || surface.kind != WrapSurface::Kind::cylinder || surface.hand != 0;
    path.wraps.push_back(wrap);
    wrap.object = index_of(reading.model.wrap_objects, name + second_cylinder);
    if (wrap.object >= 0) path.wraps.push_back(wrap);
  }
  path.approximate = path.approximate || path.wraps.size() > 1;
}

static Path read_function_path(ModelReading& reading, const pugi::xml_node& node) {
  Path path;
  const std::string coordinates = reading.context.text(node, "coordinate_paths");
  for (const std::string_view name : words_of(coordinates))
    path.function_coordinates.push_back(reading.coordinate(node, std::string(name)));
  const pugi::xml_node function = function_of(node, "length_function");
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
