#pragma once

#include <gracilis/core/types.hpp>
#include <gracilis/geometry/hermite_curve.hpp>
#include <gracilis/geometry/polylines.hpp>
#include <gracilis/geometry/triangle_mesh.hpp>
#include <gracilis/geometry/wrapped_path.hpp>
#include <gracilis/scene/activation.hpp>
#include <gracilis/scene/contraction_settings.hpp>
#include <gracilis/scene/fiber_settings.hpp>
#include <gracilis/scene/setting_values.hpp>
#include <gracilis/scene/settings.hpp>

#include <array>
#include <string>
#include <vector>

namespace gracilis {

/// A rigid surface fixed to a body, in the world frame of the capture pose.
struct Bone {
  std::string name;
  Index body = 0;  ///< index into Scene::bodies
  TriangleMesh surface;
};

/// One rotation of a joint about, or one translation along, an axis fixed in the frame left by the axes before it.
struct JointAxis {
  std::string coordinate;     ///< OpenSim's name, e.g. hip_flexion_r
  Vec3 axis = Vec3::UnitZ();  ///< unit, in the joint's frame
  Real capture_value = 0;     ///< rad (m), at which the meshes were captured
  Real range_min = -pi;       ///< rad (m); a motion may leave the range, with a warning
  Real range_max = pi;
  bool translation = false;  ///< then the coordinate is in m
};

/// Moves the child body (and all that hangs on it) about a center fixed in the parent body.
struct Joint {
  std::string name;
  Index parent_body = 0;
  Index child_body = 0;
  RigidTransform frame = RigidTransform::Identity();  ///< joint frame in the parent, world frame of the capture pose
  std::vector<JointAxis> axes;                        ///< applied in this order, body-fixed
};

/// Which end of a muscle an attachment is; the fibers run from origin to insertion.
enum class AttachmentEnd { origin, insertion };

/// Vertices of a muscle that move with a body.
struct Attachment {
  std::string name;
  AttachmentEnd end = AttachmentEnd::origin;
  Index body = 0;
  std::vector<Index> vertices;  ///< of the muscle's surface, ascending
  bool guessed = false;         ///< not measured: marked so in the run's manifest
  bool listed = false;          ///< its vertices were named one by one, so they are held whatever that takes
};

/// A body that a muscle carries: what is attached to it lies on that muscle. It moves as a patch of the muscle's
/// surface does (anatomy/attachments/muscle_bodies.hpp).
struct MuscleBody {
  Index body = 0;            ///< moved by no joint
  Index muscle = 0;          ///< that carries it
  std::vector<Index> patch;  ///< vertices of the muscle's surface, ascending
  /// The bodies that carry the patch, by the muscle's attachments, and their shares (sum 1): where no shape is known
  /// their motions are blended, about `center`.
  std::vector<Index> bodies;
  std::vector<Real> shares;
  Vec3 center = Vec3::Zero();
};

/// A coordinate that a point of a line depends on.
struct LineCoordinate {
  Index index = -1;  ///< in Pose::coordinates; -1: none
  Real capture = 0;  ///< its value in the capture pose, which poses without coordinates are
};

/// A point of a muscle's line: always there, or within a range of a coordinate; fixed to a body, or moving beside it.
struct LinePoint {
  Index body = 0;
  Vec3 place = Vec3::Zero();  ///< world frame of the capture pose
  LineCoordinate condition;   ///< there while it is within the range
  Real range_min = 0, range_max = 0;
  bool moving = false;  ///< then it is where `moves_to` says in `frame`, each component with a coordinate of its own
  RigidTransform frame = RigidTransform::Identity();  ///< moves with the body, world frame of the capture pose
  std::array<LineCoordinate, 3> moves_with;
  std::array<HermiteCurve, 3> moves_to;  ///< m, over rad or m
};

/// How a muscle's line runs in any pose: through points, around surfaces (in the world frame of the capture pose).
struct LinePath {
  std::vector<LinePoint> points;
  std::vector<PlacedWrap> wraps;
};

/// The line that a muscle pulls along, where its surface is made of sections across it (methods/cylinder); or the lines
/// of several heads, whose sections are joined to those of one sheet (anatomy/sections/sheet.hpp).
struct ActionLine {
  Points points = Points(3, 0);  ///< world frame of the capture pose, origin first
  std::vector<Index> bodies;     ///< of each point
  Index rays = 0;                ///< corners of a section; 0: there is no line
  int scaling = 0;               ///< sections: the points, and each part between them halved so many times
  Real tendon = 0;               ///< m, at the insertion
  Real origin_tendon = 0;        ///< m
  bool tendon_sections = false;  ///< there is a section, too, where each tendon ends (section_line.hpp)
  /// Of the sections in the capture pose, where they lie beside the line; none: on it.
  Points centers = Points(3, 0);
  Real optimal_fiber = 0;  ///< m; 0: not known
  Real pennation = 0;      ///< rad, at the optimal fiber length
  /// How the line runs in other poses; without points, `points` move with their bodies.
  LinePath path = {};
  /// Of its sections along the line, from 0 to 1; none: where `scaling` puts them.
  std::vector<Real> shares = {};
  std::vector<ActionLine> heads = {};  ///< of a sheet, from edge to edge; it has no points of its own then
  Index side = 0;                      ///< of a sheet: parts of each side of a section, between its outer heads
  std::string name = {};               ///< of a head, in the model that it is from
  Real max_isometric_force = 0;        ///< N, of a head; weighs it where heads are asked how active they are
};

/// A corner of a muscle's section.
struct SectionCorner {
  Index muscle = -1, section = 0, ray = 0;
};

/// Keeps a section on its side of another muscle's section, or out of bones (Laclé 2014, section 4.1;
/// methods/cylinder).
struct Transversal {
  SectionCorner moved;
  SectionCorner other;       ///< muscle -1: there is none
  std::vector<Index> bones;  ///< that the section keeps out of
};

/// Which method deforms a scene's muscles, by its name in methods/registry, and what is not as it is by default there.
/// Only the method knows what its settings mean.
struct MethodChoice {
  std::string name = "xpbd";
  SettingValues settings = {};  ///< of all muscles
  SettingValues contact = {};   ///< of contact between muscles
};

/// A sheet that fibers end on, in a muscle or on its surface: tendon spread along the belly. It is moved by the muscle.
struct Aponeurosis {
  AttachmentEnd end = AttachmentEnd::origin;
  TriangleMesh surface;  ///< open or closed, either way around
};

struct Muscle {
  std::string name;
  TriangleMesh surface;  ///< closed, oriented outwards
  std::vector<Attachment> attachments;
  SettingValues settings;  ///< of the scene's method, for this muscle alone
  FiberSettings fibers = {};
  Polylines given_fibers;  ///< from outside; where there are any, none are made from the template
  bool given_are_superficial =
      false;  ///< given_fibers lie on the surface and are to be filled in, not used as they are
  std::vector<Aponeurosis> aponeuroses;
  Polylines tracts;  ///< fascicles as measured, noisy and cut short; fibers are made that run like them
  ContractionSettings contraction = {};
  Polylines given_surface_fibers;  ///< picked by hand; where there are any, the muscle contracts along them
  ActionLine action_line = {};     ///< asked for by the method `cylinder`
};

/// Coordinate values over time; a row is a pose. Coordinates not named keep their capture value.
struct Motion {
  std::string name;
  std::vector<std::string> coordinates;
  std::vector<Real> times;  ///< s, one per row
  Eigen::MatrixXd values;   ///< rows × coordinates, rad (m for translations)
};

/// How a run goes from the capture pose (frame 0) into the motion and out of it.
struct Sequence {
  int ramp_frames = 0;    ///< between the capture pose and the motion's first pose; 0: as many as 1 degree each needs
  int settle_frames = 0;  ///< the motion's first pose repeated before it begins
  int hold_frames = 0;    ///< the motion's last pose repeated
  bool return_to_capture = false;  ///< ramp back to the capture pose at the end
};

template <>
std::span<const Setting<Sequence>> setting_table();  ///< a row for each setting

/// How the subject stands in the world frame; pictures look along these. Unit and perpendicular to each other. The
/// defaults are those of OpenSim's models.
struct AnatomicalAxes {
  Vec3 anterior = Vec3::UnitX();
  Vec3 superior = Vec3::UnitY();

  Vec3 right() const { return anterior.cross(superior); }  ///< towards the subject's right
};

/// Everything a run needs, as plain values in SI units. `validate` finds all that is wrong with it.
struct Scene {
  std::string name;
  std::vector<std::string> bodies;  ///< names; bodies[0] is fixed in the world
  std::vector<Bone> bones;
  std::vector<Joint> joints;  ///< parents before children
  std::vector<Muscle> muscles;
  std::vector<MuscleBody> muscle_bodies;  ///< a muscle that lies on another after that one's
  Motion motion;
  Sequence sequence;
  DistanceFieldSettings distance_fields;
  ActivationPlan activation = {};
  AnatomicalAxes axes = {};
  MethodChoice method = {};
  std::vector<Transversal> transversals = {};  ///< of the method `cylinder`
};

/// The muscle body with this number, or null: joints move it, or nothing does.
const MuscleBody* muscle_body(const Scene& scene, Index body);

}  // namespace gracilis
