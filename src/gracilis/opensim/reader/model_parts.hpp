#pragma once

#include <gracilis/opensim/reader/model.hpp>
#include <gracilis/opensim/reader/xml.hpp>

#include <map>

/// The parts that read_model puts together.
namespace gracilis::opensim {

/// A frame fixed to a body.
struct PlacedFrame {
  Index body = 0;
  RigidTransform in_body = RigidTransform::Identity();
};

/// Frames by "owner/name", where the owner is the joint or body that holds them.
using Frames = std::map<std::string, PlacedFrame>;

/// A file being read into a model.
struct ModelReading {
  XmlContext context;
  Model& model;
  Frames frames = {};

  /// What a path such as "/bodyset/femur_r" or "femur_r_offset" names, seen from inside `owner`.
  PlacedFrame frame(const pugi::xml_node& node, const std::string& reference, const std::string& owner) const;
  bool knows_frame(const pugi::xml_node& node, const std::string& reference) const;
  /// Index of the coordinate that a name or path names.
  Index coordinate(const pugi::xml_node& node, const std::string& reference) const;
  void leave_out(const pugi::xml_node& node, const std::string& what);
};

/// Bodies with their geometry, wrap objects and offset frames; the ground first.
void read_bodies(ModelReading& reading, const pugi::xml_node& model);
void read_geometry(ModelReading& reading, const pugi::xml_node& node, const PlacedFrame& frame);
void read_frames(ModelReading& reading, const pugi::xml_node& holder, const char* set, const std::string& owner);

/// Joints and their coordinates, parents before children.
void read_joints(ModelReading& reading, const pugi::xml_node& model);
/// The three rotation axes, or the three translation axes, made of unit length and independent: those that nothing
/// moves along are chosen to suit. Throws InputError where a moving axis has no length or repeats another.
void complete_axes(const ModelReading& reading, const pugi::xml_node& joint, TransformAxis* axes);

/// A joint whose child's origin glides on an ellipsoid that is fixed to the parent, its z axis turned with it
/// (EllipsoidJoint). The joint's coordinates are read already.
void read_ellipsoid_joint(ModelReading& reading, const pugi::xml_node& node, Joint& joint);
/// A scapula that glides on the thorax and turns about an axis in its own plane (ScapulothoracicJoint; Seth et al.
/// 2016): becomes an ellipsoid joint of a body without mass and the hinge returned, which moves the child beside it.
Joint read_scapulothoracic_joint(ModelReading& reading, const pugi::xml_node& node, Joint& joint);

/// CoordinateCouplerConstraints.
void read_constraints(ModelReading& reading, const pugi::xml_node& model);

void read_wrap_objects(ModelReading& reading, const pugi::xml_node& holder, const PlacedFrame& frame);
Path read_path(ModelReading& reading, const pugi::xml_node& force);

/// Whether a force of this kind is a passive one that is known, and what it is.
bool is_passive_force(const pugi::xml_node& node);
PassiveForce read_passive_force(ModelReading& reading, const pugi::xml_node& node);

/// Muscles, actuators and passive forces below <set><objects>.
void read_forces(ModelReading& reading, const pugi::xml_node& holder, const char* set);

}  // namespace gracilis::opensim
