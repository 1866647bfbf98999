#pragma once

#include <gracilis/anatomy/attachments/attachments.hpp>
#include <gracilis/core/errors.hpp>
#include <gracilis/io/scene/line_path_reader.hpp>
#include <gracilis/io/tables/activation_samples.hpp>
#include <gracilis/scene/motion.hpp>
#include <gracilis/scene/scene.hpp>

#include <toml++/toml.h>

#include <array>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

/// What a scene file says, as plain values in SI units, before any other file is read. `place` is where in the scene
/// file an element stands, for messages about it.
namespace gracilis {

/// A file that the scene names, as written there, with the length of its unit in m.
struct NamedFile {
  std::string path;
  Real unit = 1;
  Problem place;
  bool mirror = false;    ///< the surface is taken into the body's other half
  std::string part = {};  ///< of the file, where it holds several
};

/// A box instead of a file: surfaces for tests and demonstrations that need no data.
struct BoxDescription {
  Vec3 low, high;
  std::array<int, 3> cells{1, 1, 1};
};

/// Where the surface of an element comes from: a file, a box of its own making, or a program that made the scene.
struct SurfaceDescription {
  NamedFile file;
  std::optional<BoxDescription> box;
  std::optional<Index> given;  ///< number among the surfaces that came with the description
  bool largest_piece = false;  ///< of a muscle's closed pieces only that which encloses most
};

struct BoneDescription {
  std::string name, body;
  SurfaceDescription surface;
  Problem place;
};

struct AttachmentDescription {
  Attachment attachment;               ///< its body is not set, its vertices are those that the scene file lists
  std::string body;                    ///< empty: that of the bones
  std::vector<std::string> bones;      ///< surfaces to measure the distance from
  std::string muscle;                  ///< that it lies on, in a bone's place; empty: none
  std::vector<std::string> clouds;     ///< names in the landmark file
  std::vector<Points> points;          ///< landmarks written in the scene file itself
  NamedFile patch;                     ///< an open surface on the bones; empty path: none
  std::vector<NamedFile> aponeuroses;  ///< sheets that the fibers of this end begin or end on
  LineKind line = LineKind::cloud;
  Real bone_distance = 0;  ///< m, from the bones or from the muscle
  Real landmark_distance = 0;
  Problem place;
};

/// What of an action line is said by names.
struct LineDescription {
  std::vector<std::string> bodies;  ///< of each point
  LinePathDescription path;
};

struct MuscleDescription {
  Muscle muscle;  ///< without surface, attachments and given fibers; its action line without bodies and path
  SurfaceDescription surface;
  NamedFile fiber_file;          ///< empty path: none
  NamedFile tract_file;          ///< empty path: none
  NamedFile surface_fiber_file;  ///< along which it contracts; empty path: none
  std::vector<AttachmentDescription> attachments;
  LineDescription line;                ///< of the action line
  std::vector<LineDescription> heads;  ///< of those of a sheet's heads
  Problem place;
};

struct JointDescription {
  Joint joint;  ///< its bodies are not set
  std::string parent, child;
  Problem place;
};

/// Either a table file or key poses with equal steps between them.
struct MotionDescription {
  NamedFile file;
  std::vector<std::string> coordinates;
  Eigen::MatrixXd key_poses;  ///< rows × coordinates, rad
  Real step = 0;              ///< rad, largest change of a coordinate per frame
  Real time_step = 0;         ///< s; of a file: least time between rows that are kept
  Real begin = -std::numeric_limits<Real>::infinity(), end = std::numeric_limits<Real>::infinity();  ///< s, of a file
  Problem place;
  bool translations = false;  ///< key poses are of translations
  int max_frames = default_max_frames;
};

/// One muscle's activation: a constant, a column of a table, or a function of a coordinate.
struct ActivationDescription {
  std::vector<std::string> muscles;
  std::optional<Real> value;
  NamedFile file;
  std::string column;
  std::string coordinate;
  Eigen::MatrixXd points;  ///< rows: rad, activation
  Problem place;
};

/// A joint control unit whose samples stand in a file.
struct ControlUnitDescription {
  JointControlUnit unit;                     ///< without samples; no coordinates: the joint's, no muscles: all known
  NamedFile samples;                         ///< or the files that `gracilis activations join` would make them from:
  NamedFile motion, results;                 ///< empty paths where samples are given
  NamedFile names;                           ///< which columns are which muscle; empty path: numbered parts join
  CombineParts combine = CombineParts::sum;  ///< how parts of a muscle become one
  NamedFile forces;                          ///< that weigh the parts, for the weighted mean
  Problem place;
};

struct TransversalDescription {
  Transversal transversal;  ///< its indices of muscles and bones are not set
  std::string muscle, other;
  std::vector<std::string> bones;
  Problem place;
};

struct SceneDescription {
  Scene scene;  ///< what needs no other file: name, axes, sequence, distance fields, method
  std::string preset;
  std::vector<BoneDescription> bones;
  std::vector<JointDescription> joints;
  std::vector<MuscleDescription> muscles;
  MotionDescription motion;
  std::vector<ActivationDescription> activations;
  std::vector<ControlUnitDescription> control_units;
  std::vector<TransversalDescription> transversals;
  SurfaceSettings surfaces;
  std::optional<PrepareSettings> prepare;  ///< where the scene has a table [prepare]
  std::vector<std::string> apart = {};     ///< of [prepare]: what only is pulled apart (scene/preparation.hpp)
  NamedFile landmarks;
  std::vector<std::filesystem::path> files;  ///< the scene file and all that it includes
  std::vector<std::string> guessed;          ///< what nobody measured, in words
  std::vector<std::string> notes;
};

/// Reads a scene file, all that it includes, and the command line's settings (see scene_layers.hpp); keeps only the
/// muscles in `only`, or all when it is empty. Throws ConfigurationError with every problem found: unknown keys, wrong
/// types, values out of range, duplicates, references to bones and bodies that are not there.
SceneDescription read_scene_description(const std::filesystem::path& path, const std::vector<std::string>& set,
                                        const std::vector<std::string>& only);

/// The same of tables that a program made, with the keys of a scene file; bones and muscles may have the key `given`,
/// one of `surfaces` by its number, in the place of `file`.
SceneDescription read_given_description(const toml::table& tables, Index surfaces);

}  // namespace gracilis
