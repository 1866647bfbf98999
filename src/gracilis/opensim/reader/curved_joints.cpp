#include <gracilis/opensim/reader/curved_joints.hpp>

#include <gracilis/geometry/rotations.hpp>

#include <fmt/format.h>

namespace gracilis::opensim {

/// Body-fixed x, y, z by the three coordinates, and the origin on the surface: each radius times that component of the
/// turned z axis, (sin q₂, -sin q₁ cos q₂, cos q₁ cos q₂), as Simbody's ellipsoid mobilizer has it (Sherman, Seth, Delp
/// 2011). The translations come first, so they go along the parent's axes.
static void make_ellipsoid(const Vec3& radii, Joint& joint) {
  const Index first = joint.coordinates[0], second = joint.coordinates[1];
  for (std::size_t i = 0; i < 6; ++i) joint.axes[i].axis = Vec3::Unit(static_cast<Eigen::Index>(i % 3));
  for (std::size_t i = 0; i < 3; ++i) {
    joint.axes[i].coordinates = {joint.coordinates[i]};
    joint.axes[i].function = linear(1, 0);
  }
  joint.axes[3].coordinates = {second};
  joint.axes[3].function = product_of_sines(radii.x(), {0});
  joint.axes[4].coordinates = {first, second};
  joint.axes[4].function = product_of_sines(-radii.y(), {0, pi / 2});
  joint.axes[5].coordinates = {first, second};
  joint.axes[5].function = product_of_sines(radii.z(), {pi / 2, pi / 2});
}

static Vec3 read_radii(const XmlContext& context, const pugi::xml_node& node, const char* name) {
  Vec3 radii = context.vector(node, name, Vec3::Constant(-1));
  if (!(radii.minCoeff() >= 0)) context.fail(node, fmt::format("needs <{}> of three radii", name), "give them");
  return radii;
}

static void need_coordinates(const XmlContext& context, const pugi::xml_node& node, const Joint& joint,
                             std::size_t count) {
  if (joint.coordinates.size() != count)
    context.fail(node, fmt::format("has {} coordinates instead of {}", joint.coordinates.size(), count), "");
}

void read_ellipsoid_joint(ModelReading& reading, const pugi::xml_node& node, Joint& joint) {
  need_coordinates(reading.context, node, joint, 3);
  make_ellipsoid(read_radii(reading.context, node, "radii_x_y_z"), joint);
}

Joint read_scapulothoracic_joint(ModelReading& reading, const pugi::xml_node& node, Joint& joint) {
  const XmlContext& context = reading.context;
  need_coordinates(context, node, joint, 4);
  const Vec3 radii = read_radii(context, node, "thoracic_ellipsoid_radii_x_y_z");
  std::vector<Real> origin = context.numbers(node, "scapula_winging_axis_origin");
  if (origin.empty()) origin = {0, 0};
  if (origin.size() != 2) context.fail(node, "needs a <scapula_winging_axis_origin> of two numbers", "give them");
  const Real direction = context.number(node, "scapula_winging_axis_direction", 0);

  Body gliding;
  gliding.name = joint.name + "_gliding";
  if (index_of(reading.model.bodies, gliding.name) >= 0)
    context.fail(node, fmt::format("needs the name '{}', which a body has", gliding.name), "rename that");
  // Turned by a right angle about the normal, so that abduction and elevation are positive; the radii are the thorax's.
  RigidTransform quarter = RigidTransform::Identity();
  quarter.rotate(Eigen::AngleAxisd(pi / 2, Vec3::UnitZ()));
  // The winging axis lies in the scapula's plane; 0 is along y.
  RigidTransform winging = RigidTransform::Identity();
  winging.translation() = Vec3(origin[0], origin[1], 0);
  winging.linear() = turn_from_to(Vec3::UnitZ(), Vec3(-std::sin(direction), std::cos(direction), 0)).toRotationMatrix();

  Joint wing;
  wing.name = joint.name + "_winging";
  wing.type = "PinJoint";
  wing.parent_body = static_cast<Index>(reading.model.bodies.size());
  wing.child_body = joint.child_body;
  wing.parent_frame = winging;
  wing.child_frame = joint.child_frame * winging;
  wing.coordinates = {joint.coordinates[3]};
  for (std::size_t i = 0; i < 6; ++i) wing.axes[i].axis = Vec3::Unit(static_cast<Eigen::Index>(i % 3));
  wing.axes[2].coordinates = wing.coordinates;
  wing.axes[2].function = linear(1, 0);

  joint.child_body = wing.parent_body;
  joint.parent_frame = joint.parent_frame * quarter;
  joint.child_frame = quarter;
  joint.coordinates.pop_back();
  make_ellipsoid({radii.y(), radii.x(), radii.z()}, joint);
  reading.model.bodies.push_back(std::move(gliding));
  return wing;
}

}  // namespace gracilis::opensim
