#pragma once

#include <gracilis/anatomy/sections/enhancement.hpp>
#include <gracilis/geometry/triangle_mesh.hpp>
#include <gracilis/opensim/import/neighbor_clearance.hpp>
#include <gracilis/opensim/reader/model.hpp>
#include <gracilis/scene/scene.hpp>

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace gracilis::opensim {

/// What of a muscle's line is tendon: what its belly leaves, or parts of the tendon's slack length (Laclé 2014, section
/// 3.4.3).
enum class TendonPlace {
  beyond_belly,       ///< at the insertion, as much as a belly of belly_on_line leaves
  half_at_insertion,  ///< half of its slack length, as Laclé has it
  whole_at_insertion,
  both_ends  ///< half of it at each
};

/// How muscles that are lines become volumes.
struct VolumeSettings {
  int rays = 12;                  ///< corners of a section, even
  Real section_distance = 0.012;  ///< m, at most this far apart on average
  std::optional<int> scaling;     ///< instead: how often each part of the line is halved (Laclé's LSS), 0 to 16
  Real specific_tension = 6.1e5;  ///< N/m²
  TendonPlace tendon = TendonPlace::beyond_belly;
  bool tendon_sections = false;  ///< a section more where each tendon ends, between its neighbors in shape
  /// Surfaces that are known, by the muscles' names, closed, in the ground frame: sections are brought onto them.
  std::map<std::string, TriangleMesh> surfaces;
  std::shared_ptr<const std::vector<SolidBone>> bones;  ///< that the others keep out of; none: they do not
  std::map<std::string, RoundMuscle>
      beside;  ///< muscles by name that the others keep out of, too, where there are bones; sections of a muscle among
               ///< them have these centers before they are brought out of the bones
  EnhancementSettings enhancement = {.more_rays = 6};
};

/// Vertices of a muscle's surface that move with a body.
struct HeldVertices {
  AttachmentEnd end = AttachmentEnd::origin;
  Index body = 0;
  std::vector<Index> vertices;  ///< ascending
};

struct MuscleVolume {
  TriangleMesh surface;
  Real volume_share = 1;             ///< of the volume asked for that bones and other muscles left room for
  Real tendon_share = 1;             ///< of the tendon's length that the line left room for
  ActionLine line;                   ///< its bodies are the model's
  std::array<HeldVertices, 2> held;  ///< origin and insertion
  Index sections_on_surface = 0;     ///< of those brought onto a surface that is known
  Index centers_outside = 0;         ///< of these, whose centers lie outside of it
};

/// A closed surface around a muscle's path for the bodies at `poses` (Laclé 2014, after the line's own points; radii by
/// spindle_radii, outside of the bones, or from the surface that is known, see enhance). The first section is held by
/// the origin's body and the last by the insertion's; a tendon slides past the points between.
/// Throws InputError for a path by functions, which has no place, and for one without length.
MuscleVolume muscle_volume(const Model& model, const Muscle& muscle, const std::vector<RigidTransform>& poses,
                           const Eigen::VectorXd& coordinates, const VolumeSettings& settings);

/// Draws the surfaces of muscles apart (draw_apart), but for those whose surfaces are known; tells in their
/// volume_share what that takes.
void draw_volumes_apart(std::vector<MuscleVolume>& volumes);

/// The muscle as others find it that keep out of it: round sections about its line, their centers outside of the bones.
/// Throws InputError as muscle_volume does.
RoundMuscle round_muscle(const Model& model, const Muscle& muscle, const std::vector<RigidTransform>& poses,
                         const Eigen::VectorXd& coordinates, const VolumeSettings& settings);

/// Muscles by name whose thin parts lie beside the thicker parts of the others, not in them (beside_bellies), and
/// outside of the bones.
std::map<std::string, RoundMuscle> tendons_beside_bellies(const std::map<std::string, RoundMuscle>& muscles,
                                                          const std::vector<SolidBone>& bones);

}  // namespace gracilis::opensim
