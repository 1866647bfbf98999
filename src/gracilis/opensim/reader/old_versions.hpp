#pragma once

#include <pugixml.hpp>

namespace gracilis::opensim {

/// Brings a document of a version below 30000 (OpenSim 1 and 2) into the form of 3.0, as OpenSim does when it reads
/// one: muscles' own point and wrap sets become a GeometryPath (10901), MusclePoint and its kin PathPoint,
/// natCubicSpline SimmSpline; a custom joint's TransformAxisSet becomes a SpatialTransform (before 10901),
/// pennation_angle pennation_angle_at_optimal (up to 20301); what a DynamicsEngine holds belongs to the model.
void bring_to_version_3(const pugi::xml_node& document, int version);

}  // namespace gracilis::opensim
