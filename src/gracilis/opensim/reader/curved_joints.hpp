#pragma once

#include <gracilis/opensim/reader/model_parts.hpp>

namespace gracilis::opensim {

/// A joint whose child's origin glides on an ellipsoid that is fixed to the parent, its z axis turned with it
/// (EllipsoidJoint). The joint's coordinates are read already.
void read_ellipsoid_joint(ModelReading& reading, const pugi::xml_node& node, Joint& joint);
/// A scapula that glides on the thorax and turns about an axis in its own plane (ScapulothoracicJoint; Seth et al.
/// 2016): becomes an ellipsoid joint of a body without mass and the hinge returned, which moves the child beside it.
Joint read_scapulothoracic_joint(ModelReading& reading, const pugi::xml_node& node, Joint& joint);

}  // namespace gracilis::opensim
