#include <gracilis/opensim/reader/body_reader.hpp>

#include <fmt/format.h>
#include <gracilis/opensim/reader/path_reader.hpp>

#include <algorithm>

namespace gracilis::opensim {

/// Moments and products of inertia: six numbers (4.x) or six elements (3.x).
static Eigen::Matrix3d read_inertia(const XmlContext& context, const pugi::xml_node& node) {
  std::vector<Real> m = context.numbers(node, "inertia");
  if (m.empty())
    for (const char* name : {"inertia_xx", "inertia_yy", "inertia_zz", "inertia_xy", "inertia_xz", "inertia_yz"})
      m.push_back(context.number(node, name, 0));
  if (m.size() != 6) context.fail(node, fmt::format("has {} numbers of inertia instead of 6", m.size()), "");
  Eigen::Matrix3d inertia;
  inertia << m[0], m[3], m[4], m[3], m[1], m[5], m[4], m[5], m[2];
  return inertia;
}

/// "-0 0 -0 0 0 0": three angles, three lengths.
static RigidTransform read_transform(const XmlContext& context, const pugi::xml_node& node) {
  const std::vector<Real> t = context.numbers(node, "transform");
  if (t.empty()) return RigidTransform::Identity();
  if (t.size() != 6) context.fail(node, fmt::format("<transform> holds {} numbers instead of 6", t.size()), "");
  return body_fixed_xyz({t[0], t[1], t[2]}, {t[3], t[4], t[5]});
}

static std::string plain_path(std::string file) {
  std::replace(file.begin(), file.end(), '\\', '/');
  while (file.starts_with("./")) file.erase(0, 2);
  return file;
}

/// 3.x: all of a body's surfaces are scaled by the VisibleObject as well as by their own factors.
static void read_visible_object(ModelReading& reading, const pugi::xml_node& body, const PlacedFrame& frame) {
  const XmlContext& context = reading.context;
  const pugi::xml_node object = body.child("VisibleObject");
  const Vec3 scale = context.vector(object, "scale_factors", Vec3::Ones());
  const RigidTransform placed = frame.in_body * read_transform(context, object);
  auto& geometry = reading.model.bodies[static_cast<std::size_t>(frame.body)].geometry;
  for (const pugi::xml_node& node : objects_of(object, "GeometrySet")) {
    const Vec3 own = context.vector(node, "scale_factors", Vec3::Ones());
    geometry.push_back({plain_path(context.text(node, "geometry_file")), scale.cwiseProduct(own),
                        placed * read_transform(context, node)});
  }
  std::string files = context.text(object, "geometry_files");
  for (std::size_t begin = 0; (begin = files.find_first_not_of(" \t\n", begin)) != std::string::npos;) {
    const std::size_t end = std::min(files.find_first_of(" \t\n", begin), files.size());
    geometry.push_back({plain_path(files.substr(begin, end - begin)), scale, placed});
    begin = end;
  }
}

void read_geometry(ModelReading& reading, const pugi::xml_node& node, const PlacedFrame& frame) {
  read_visible_object(reading, node, frame);
  for (const char* set : {"attached_geometry", "geometry"})
    for (const pugi::xml_node& shape : node.child(set).children()) {
      const std::string_view kind = shape.name();
      if (kind == "FrameGeometry") continue;
      if (kind != "Mesh") {
        reading.leave_out(shape, fmt::format("shape on '{}' left out", name_of(node)));
        continue;
      }
      reading.model.bodies[static_cast<std::size_t>(frame.body)].geometry.push_back(
          {plain_path(reading.context.text(shape, "mesh_file")),
           reading.context.vector(shape, "scale_factors", Vec3::Ones()), frame.in_body});
    }
}

void read_frames(ModelReading& reading, const pugi::xml_node& holder, const char* set, const std::string& owner) {
  for (const pugi::xml_node& node : objects_of(holder, set)) {
    if (std::string_view(node.name()) != "PhysicalOffsetFrame") continue;
    PlacedFrame frame = reading.frame(node, reading.context.socket(node, "parent", "parent"), owner);
    frame.in_body = frame.in_body * body_fixed_xyz(reading.context.vector(node, "orientation", Vec3::Zero()),
                                                   reading.context.vector(node, "translation", Vec3::Zero()));
    reading.model.frames[owner + "/" + name_of(node)] = frame;
    read_geometry(reading, node, frame);
    read_wrap_objects(reading, node, frame);
  }
}

static void read_body(ModelReading& reading, const pugi::xml_node& node) {
  const XmlContext& context = reading.context;
  const std::string name = name_of(node);
  Index index = index_of(reading.model.bodies, name);
  if (index > 0 || name.empty()) context.fail(node, "occurs twice or has no name", "give every body its own name");
  if (index < 0) {
    index = static_cast<Index>(reading.model.bodies.size());
    Body body;
    body.name = name;
    body.mass = context.number(node, "mass", 0);
    body.mass_center = context.vector(node, "mass_center", Vec3::Zero());
    body.inertia = read_inertia(context, node);
    if (!(body.mass >= 0)) context.fail(node, fmt::format("has the mass {}", body.mass), "give 0 or more");
    reading.model.bodies.push_back(std::move(body));
  }
  read_geometry(reading, node, {index, RigidTransform::Identity()});
}

void read_bodies(ModelReading& reading, const pugi::xml_node& model) {
  Body ground;
  ground.name = "ground";
  reading.model.bodies.push_back(ground);
  if (model.child("Ground")) read_body(reading, model.child("Ground"));
  const std::vector<pugi::xml_node> bodies = objects_of(model, "BodySet");
  for (const pugi::xml_node& body : bodies) read_body(reading, body);
  // A wrap object may name any body.
  const auto read_wraps = [&](const pugi::xml_node& body) {
    read_wrap_objects(reading, body, {index_of(reading.model.bodies, name_of(body)), RigidTransform::Identity()});
  };
  if (model.child("Ground")) read_wraps(model.child("Ground"));
  for (const pugi::xml_node& body : bodies) read_wraps(body);
  for (const pugi::xml_node& body : bodies) read_frames(reading, body, "components", name_of(body));
  read_frames(reading, model, "components", "");
}

}  // namespace gracilis::opensim
