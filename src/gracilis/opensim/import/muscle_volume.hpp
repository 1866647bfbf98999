#pragma once

#include <gracilis/opensim/import/volume_settings.hpp>
#include <gracilis/opensim/reader/model.hpp>
#include <gracilis/scene/scene.hpp>

#include <vector>

namespace gracilis::opensim {

/// Vertices of a muscle's surface that move with a body.
struct HeldVertices {
  AttachmentEnd end = AttachmentEnd::origin;
  Index body = 0;
  std::vector<Index> vertices;  ///< ascending
};

struct MuscleVolume {
  TriangleMesh surface;
  Real volume_share = 1;               ///< of the volume asked for that bones and other muscles left room for
  Real tendon_share = 1;               ///< of the tendon's length that the line left room for
  ActionLine line;                     ///< its bodies are the model's
  std::vector<HeldVertices> held;      ///< origin and insertion; of a sheet, those of each of its heads' bodies
  Index sections_on_surface = 0;       ///< of those brought onto a surface that is known
  Index centers_outside = 0;           ///< of these, whose centers lie outside of it
  std::vector<MatchedPoints> matches;  ///< that centers were found by, before sections of tendons are put in between
};

/// A closed surface around a muscle's path for the bodies at `poses` (Laclé 2014, after the line's own points; radii by
/// spindle_radii, outside of the bones, or from the surface that is known, see enhance). The first section is held by
/// the origin's body and the last by the insertion's; a tendon slides past the points between.
/// Throws InputError for a path by functions, which has no place, and for one without length.
MuscleVolume muscle_volume(const Model& model, const Muscle& muscle, const std::vector<RigidTransform>& poses,
                           const Eigen::VectorXd& coordinates, const VolumeSettings& settings);

/// The muscle as others find it that keep out of it: round sections about its line, their centers outside of the bones.
/// Throws InputError as muscle_volume does.
RoundMuscle round_muscle(const Model& model, const Muscle& muscle, const std::vector<RigidTransform>& poses,
                         const Eigen::VectorXd& coordinates, const VolumeSettings& settings);

}  // namespace gracilis::opensim
