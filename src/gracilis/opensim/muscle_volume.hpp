#pragma once

#include <gracilis/geometry/triangle_mesh.hpp>
#include <gracilis/opensim/model.hpp>
#include <gracilis/scene/scene.hpp>

namespace gracilis::opensim {

/// How muscles that are lines become volumes.
struct VolumeSettings {
  int rays = 12;                  ///< corners of a section
  Real section_distance = 0.012;  ///< m, at most this far apart on average
  Real specific_tension = 6.1e5;  ///< N/m²
};

/// Vertices of a muscle's surface that move with a body.
struct HeldVertices {
  AttachmentEnd end = AttachmentEnd::origin;
  Index body = 0;
  std::vector<Index> vertices;  ///< ascending
};

struct MuscleVolume {
  TriangleMesh surface;
  ActionLine line;  ///< its bodies are the model's
  std::vector<HeldVertices> held;
};

/// A closed surface around a muscle's path for the bodies at `poses` (Laclé 2014, after the line's own points; radii by
/// spindle_radii with half of the tendon's slack length at the insertion). The first sections are held by the origin's
/// body and the last by the insertion's; sections at points between that lie in the tendon, by theirs. Throws
/// InputError for a path by functions, which has no place, and for one without length.
MuscleVolume muscle_volume(const Model& model, const Muscle& muscle, const std::vector<RigidTransform>& poses,
                           const Eigen::VectorXd& coordinates, const VolumeSettings& settings);

}  // namespace gracilis::opensim
