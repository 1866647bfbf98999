#include <gracilis/opensim/reader/joint_reader.hpp>

#include <gracilis/opensim/reader/body_reader.hpp>
#include <gracilis/opensim/reader/curved_joints.hpp>
#include <gracilis/opensim/reader/function_reader.hpp>
#include <gracilis/opensim/reader/joint_tree.hpp>

#include <gracilis/io/text_cells.hpp>
#include <gracilis/io/value_reader.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace gracilis::opensim {

/// The axes of joints that have a name of their own, by the coordinates in their order: 0 to 2 are rotations about x, y
/// and z, 3 to 5 translations. Of joints on an ellipsoid, whose axes are made elsewhere, only their number counts.
static const std::map<std::string, std::vector<int>> plain_joints = {{"PinJoint", {2}},
                                                                     {"SliderJoint", {3}},
                                                                     {"UniversalJoint", {0, 1}},
                                                                     {"BallJoint", {0, 1, 2}},
                                                                     {"GimbalJoint", {0, 1, 2}},
                                                                     {"FreeJoint", {0, 1, 2, 3, 4, 5}},
                                                                     {"PlanarJoint", {2, 3, 4}},
                                                                     {"WeldJoint", {}},
                                                                     {"EllipsoidJoint", {0, 1, 2}},
                                                                     {"ScapulothoracicJoint", {0, 1, 2, 2}}};

static void add_coordinate(ModelReading& reading, const pugi::xml_node& node, Coordinate coordinate, Joint& joint) {
  if (coordinate.name.empty() || index_of(reading.model.coordinates, coordinate.name) >= 0)
    reading.context.fail(node, "occurs twice or has no name", "give every coordinate its own name");
  coordinate.joint = static_cast<Index>(reading.model.joints.size());
  joint.coordinates.push_back(static_cast<Index>(reading.model.coordinates.size()));
  reading.model.coordinates.push_back(std::move(coordinate));
}

/// The coordinates that a CustomJoint's axes name and nothing else in the file does. Those of other joints are none:
/// who reads the axes refuses them.
static std::vector<std::string> named_by_axes_alone(const ModelReading& reading, const pugi::xml_node& node) {
  std::vector<std::string> names;
  for (const pugi::xml_node& axis : node.child("SpatialTransform").children("TransformAxis")) {
    const std::string coordinates = reading.context.text(axis, "coordinates");
    for (const std::string_view name : words_of(coordinates))
      if (index_of(reading.model.coordinates, std::string(name)) < 0 &&
          std::find(names.begin(), names.end(), name) == names.end())
        names.emplace_back(name);
  }
  return names;
}

/// Coordinates that a joint of this kind has and the file leaves out get the names that OpenSim gives them, which are
/// returned: numbers, or of a CustomJoint those that its axes have.
static std::vector<std::string> add_missing_coordinates(ModelReading& reading, const pugi::xml_node& node,
                                                        Joint& joint) {
  std::vector<std::string> names;
  if (joint.type == "CustomJoint") {
    names = named_by_axes_alone(reading, node);
    for (const std::string& name : names) {
      Coordinate coordinate;
      coordinate.name = name;
      add_coordinate(reading, node, std::move(coordinate), joint);
    }
    return names;
  }
  const auto plain = plain_joints.find(joint.type);
  if (plain == plain_joints.end()) return names;
  for (std::size_t i = joint.coordinates.size(); i < plain->second.size(); ++i) {
    Coordinate coordinate;
    coordinate.name = fmt::format("{}_coord_{}", joint.name, i);
    coordinate.rotation = plain->second[i] < 3;
    names.push_back(coordinate.name);
    add_coordinate(reading, node, std::move(coordinate), joint);
  }
  return names;
}

/// OpenSim counts a coordinate that follows a function of time with the locked ones; a lock goes before the function.
static void read_prescribed(ModelReading& reading, const pugi::xml_node& node, Coordinate& coordinate) {
  const pugi::xml_node given = function_of(node, "prescribed_function");
  if (coordinate.locked || !given || !reading.context.boolean(node, "prescribed", false)) return;
  coordinate.locked = true;
  const std::size_t told = reading.model.unsupported.size();
  const Function function = read_function(reading.context, given, 1, reading.model.unsupported);
  if (reading.model.unsupported.size() > told) return;
  coordinate.default_value = value(function, {0});
  if (function.kind != Function::Kind::constant)
    reading.leave_out(node,
                      "follows a function of time, of which the value at 0 s is taken; give its values by a motion");
}

/// What is so far off stands for no bound.
static Real range_bound(Real given) {
  const Real farthest = 1e6;  // rad or m
  return std::abs(given) < farthest ? given : std::copysign(std::numeric_limits<Real>::infinity(), given);
}

static void read_coordinates(ModelReading& reading, const pugi::xml_node& node, Joint& joint) {
  const XmlContext& context = reading.context;
  std::vector<pugi::xml_node> nodes = objects_of(node, "coordinates");
  if (nodes.empty()) nodes = objects_of(node, "CoordinateSet");
  for (const pugi::xml_node& each : nodes) {
    Coordinate coordinate;
    coordinate.name = name_of(each);
    coordinate.rotation = context.text(each, "motion_type") != "translational";
    coordinate.default_value = context.number(each, "default_value", 0);
    const std::vector<Real> range = context.numbers(each, "range");
    if (range.size() == 2) {
      coordinate.range_min = range_bound(range[0]);
      coordinate.range_max = range_bound(range[1]);
      if (range[1] < range[0]) {
        std::swap(coordinate.range_min, coordinate.range_max);
        reading.leave_out(each, "has a range that ends before it begins, which is read the other way round");
      }
    }
    coordinate.locked = context.boolean(each, "locked", false);
    coordinate.clamped = context.boolean(each, "clamped", false);
    read_prescribed(reading, each, coordinate);
    add_coordinate(reading, each, std::move(coordinate), joint);
  }
  const std::vector<std::string> missing = add_missing_coordinates(reading, node, joint);
  if (!missing.empty())
    reading.leave_out(node, fmt::format("leaves out coordinates, which are called {}", fmt::join(missing, ", ")));
}

static bool moves(const TransformAxis& axis) { return !axis.coordinates.empty(); }
static bool acts(const TransformAxis& axis) {
  return moves(axis) || (axis.function.kind == Function::Kind::constant && value(axis.function, {}) != 0);
}

void complete_axes(const ModelReading& reading, const pugi::xml_node& joint, TransformAxis* axes) {
  std::vector<Vec3> used;
  for (int i = 0; i < 3; ++i) {
    if (!acts(axes[i])) continue;
    const Real length = axes[i].axis.norm();
    if (!(length > 1e-9)) reading.context.fail(joint, "has an axis without length", "give it a direction");
    axes[i].axis /= length;
    for (const Vec3& other : used)
      if (other.cross(axes[i].axis).norm() < 1e-6)
        reading.context.fail(joint, "has the same axis twice", "give the second another direction");
    used.push_back(axes[i].axis);
  }
  if (used.size() == 3 && std::abs(used[0].dot(used[1].cross(used[2]))) < 1e-6)
    reading.context.fail(joint, "has three axes in one plane", "give one of them another direction");
  for (int i = 0; i < 3; ++i) {
    if (acts(axes[i])) continue;
    if (used.empty())
      used.push_back(axes[i].axis = Vec3::Unit(i));
    else if (used.size() == 1)
      used.push_back(axes[i].axis = used[0].unitOrthogonal());
    else
      used.push_back(axes[i].axis = used[0].cross(used[1]).normalized());
  }
}

static void read_spatial_transform(ModelReading& reading, const pugi::xml_node& node, Joint& joint) {
  if (!node.child("SpatialTransform"))
    reading.leave_out(node, "has no <SpatialTransform>; its bodies are fixed to each other");
  const char* order[6] = {"rotation1", "rotation2", "rotation3", "translation1", "translation2", "translation3"};
  for (int i = 0; i < 6; ++i) joint.axes[static_cast<std::size_t>(i)].axis = Vec3::Unit(i % 3);
  for (const pugi::xml_node& each : node.child("SpatialTransform").children("TransformAxis")) {
    const auto place = std::find(std::begin(order), std::end(order), name_of(each)) - std::begin(order);
    if (place == 6) reading.context.fail(each, "is none of rotation1 ... translation3", "name it so");
    TransformAxis& axis = joint.axes[static_cast<std::size_t>(place)];
    axis.axis = reading.context.vector(each, "axis", axis.axis);
    const std::string coordinates = reading.context.text(each, "coordinates");
    for (const std::string_view name : words_of(coordinates)) {
      const Index index = reading.coordinate(each, std::string(name));
      if (std::find(joint.coordinates.begin(), joint.coordinates.end(), index) == joint.coordinates.end())
        reading.context.fail(each, fmt::format("uses the coordinate '{}' of another joint", name), "couple them");
      axis.coordinates.push_back(index);
    }
    const pugi::xml_node function = function_below(each);
    if (!function && !axis.coordinates.empty())
      axis.function = linear(1, 0);
    else if (function)
      axis.function = read_function(reading.context, function, axis.coordinates.size(), reading.model.unsupported);
    if (axis.function.kind == Function::Kind::constant) axis.coordinates.clear();
  }
}

/// A coordinate is an angle when it turns the joint; one that only shifts it is a length.
static void tell_angles(ModelReading& reading, const Joint& joint) {
  for (const Index index : joint.coordinates) {
    bool turns = false, shifts = false;
    for (std::size_t i = 0; i < 6; ++i) {
      const auto& used = joint.axes[i].coordinates;
      if (std::find(used.begin(), used.end(), index) != used.end()) (i < 3 ? turns : shifts) = true;
    }
    if (turns || shifts) reading.model.coordinates[static_cast<std::size_t>(index)].rotation = turns;
  }
}

static void read_axes(ModelReading& reading, const pugi::xml_node& node, Joint& joint) {
  const auto plain = plain_joints.find(joint.type);
  if (joint.type == "EllipsoidJoint") {
    read_ellipsoid_joint(reading, node, joint);
  } else if (joint.type == "CustomJoint") {
    read_spatial_transform(reading, node, joint);
  } else if (plain != plain_joints.end()) {
    if (joint.coordinates.size() > plain->second.size())
      reading.context.fail(node, fmt::format("has {} coordinates", joint.coordinates.size()), "");
    for (int i = 0; i < 6; ++i) joint.axes[static_cast<std::size_t>(i)].axis = Vec3::Unit(i % 3);
    for (std::size_t i = 0; i < joint.coordinates.size(); ++i) {
      TransformAxis& axis = joint.axes[static_cast<std::size_t>(plain->second[i])];
      axis.coordinates = {joint.coordinates[i]};
      axis.function = linear(1, 0);
    }
  } else {
    reading.leave_out(node, "kind of joint not known; its bodies are fixed to each other");
  }
  complete_axes(reading, node, joint.axes.data());
  complete_axes(reading, node, joint.axes.data() + 3);
  tell_angles(reading, joint);
}

/// A frame of a joint up to version 3.2. OpenSim 4 writes these anew when it reads them, with six digits; so that
/// lengths agree with its own they are taken so.
static RigidTransform old_frame(const XmlContext& context, const pugi::xml_node& node, const char* orientation,
                                const char* location) {
  const auto rounded = [&](const char* name) -> Vec3 {
    return context.vector(node, name, Vec3::Zero()).unaryExpr([](Real x) {
      Real short_x = x;
      parse_number(fmt::format("{:.6g}", x), short_x);
      return short_x;
    });
  };
  return body_fixed_xyz(rounded(orientation), rounded(location));
}

/// Whether a joint, which `child` holds where that is not empty, names two bodies; some files have none where OpenSim
/// never looks.
static bool names_bodies(const XmlContext& context, const pugi::xml_node& node, const std::string& child) {
  for (const pugi::xml_node& frame : objects_of(node, "frames"))
    if (std::string_view(frame.name()) == "PhysicalOffsetFrame" && context.socket(frame, "parent", "parent").empty())
      return false;
  if (!child.empty()) return !context.text(node, "parent_body").empty();
  return !context.socket(node, "parent_frame", "parent_body").empty() &&
         !context.socket(node, "child_frame", "child_body").empty();
}

static void read_joint(ModelReading& reading, const pugi::xml_node& node, const std::string& child) {
  const XmlContext& context = reading.context;
  if (!names_bodies(context, node, child)) return reading.leave_out(node, "names no bodies, or one alone; left out");
  Joint joint;
  joint.name = name_of(node);
  joint.type = node.name();
  read_frames(reading, node, "frames", joint.name);
  if (child.empty()) {
    const PlacedFrame parent = reading.frame(node, context.socket(node, "parent_frame", "parent_body"), joint.name);
    const PlacedFrame own = reading.frame(node, context.socket(node, "child_frame", "child_body"), joint.name);
    joint.parent_body = parent.body;
    joint.parent_frame = parent.in_body;
    joint.child_body = own.body;
    joint.child_frame = own.in_body;
  } else {
    joint.parent_body = reading.frame(node, context.text(node, "parent_body"), "").body;
    joint.child_body = reading.frame(node, child, "").body;
    joint.parent_frame = old_frame(context, node, "orientation_in_parent", "location_in_parent");
    joint.child_frame = old_frame(context, node, "orientation", "location");
  }
  if (context.boolean(node, "reverse", false)) context.fail(node, "is reversed", "swap its parent and child");
  read_coordinates(reading, node, joint);
  if (joint.type == "ScapulothoracicJoint") {
    Joint wing = read_scapulothoracic_joint(reading, node, joint);
    tell_angles(reading, joint);
    reading.model.joints.push_back(std::move(joint));
    reading.model.joints.push_back(std::move(wing));
    return;
  }
  read_axes(reading, node, joint);
  reading.model.joints.push_back(std::move(joint));
}

/// As OpenSim does, a body that no joint moves gets a free one.
static void free_bodies(ModelReading& reading, const pugi::xml_node& node) {
  Model& model = reading.model;
  for (std::size_t i = 1; i < model.bodies.size(); ++i) {
    const auto body = static_cast<Index>(i);
    if (std::any_of(model.joints.begin(), model.joints.end(),
                    [&](const Joint& joint) { return joint.child_body == body; }))
      continue;
    Joint joint;
    joint.name = "free_" + model.bodies[i].name;
    joint.type = "FreeJoint";
    joint.child_body = body;
    reading.leave_out(node, fmt::format("body '{}' hangs on no joint; a FreeJoint to the ground, '{}', is added",
                                        model.bodies[i].name, joint.name));
    add_missing_coordinates(reading, node, joint);
    read_axes(reading, node, joint);
    model.joints.push_back(std::move(joint));
  }
}

void read_joints(ModelReading& reading, const pugi::xml_node& model) {
  for (const pugi::xml_node& joint : objects_of(model, "JointSet")) read_joint(reading, joint, "");
  // Up to version 3.2 a body holds the joint to its parent.
  for (const pugi::xml_node& body : objects_of(model, "BodySet"))
    for (const pugi::xml_node& joint : body.child("Joint").children())
      if (name_of(body) != "ground") read_joint(reading, joint, name_of(body));
  free_bodies(reading, model);
  sort_joints(reading, model);
}

}  // namespace gracilis::opensim
