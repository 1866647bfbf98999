#pragma once

#include <gracilis/geometry/wrapping.hpp>
#include <gracilis/opensim/functions/function.hpp>
#include <gracilis/opensim/functions/millard_curves.hpp>

#include <array>
#include <limits>
#include <map>
#include <string>
#include <vector>

/// An OpenSim model as plain values in SI units and radians. Indices point into the vectors of Model; -1 is nothing.
namespace gracilis::opensim {

/// A surface shown with a body: a file, where it lies in the body, and how much larger it is shown.
struct Geometry {
  std::string file;
  Vec3 scale = Vec3::Ones();
  RigidTransform frame = RigidTransform::Identity();
};

struct Body {
  std::string name;
  Real mass = 0;
  Vec3 mass_center = Vec3::Zero();
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< about the center of mass, in the body's axes
  std::vector<Geometry> geometry;
};

struct Coordinate {
  std::string name;
  Index joint = 0;
  bool rotation = true;  ///< an angle: tables that say inDegrees hold it in degrees
  Real default_value = 0, range_min = -pi, range_max = pi;
  bool locked = false, clamped = false;  ///< locked: or prescribed by a function, the value of which is the default one
};

/// Three rotations about axes that turn with those before, then three translations along axes of the parent frame.
struct TransformAxis {
  Vec3 axis = Vec3::UnitX();
  std::vector<Index> coordinates;  ///< the function's arguments
  Function function;
};

struct Joint {
  std::string name, type;
  Index parent_body = 0, child_body = 0;
  RigidTransform parent_frame = RigidTransform::Identity(), child_frame = RigidTransform::Identity();
  std::array<TransformAxis, 6> axes;
  std::vector<Index> coordinates;
};

/// One coordinate is a function of others (CoordinateCouplerConstraint).
struct Coupler {
  std::string name;
  std::vector<Index> independent;
  Index dependent = 0;
  Function function;
};

/// A frame fixed to a body.
struct PlacedFrame {
  Index body = 0;
  RigidTransform in_body = RigidTransform::Identity();
};

/// Closes a loop of bodies.
struct LoopConstraint {
  enum class Kind {
    point,     ///< points of two bodies coincide (PointConstraint)
    distance,  ///< they keep a distance (ConstantDistanceConstraint)
    weld       ///< frames of two bodies coincide (WeldConstraint)
  };
  std::string name;
  Kind kind = Kind::point;
  Index body = 0, other_body = 0;
  RigidTransform frame = RigidTransform::Identity(), other_frame = RigidTransform::Identity();  ///< in their bodies
  Real distance = 0;                                                                            ///< m
};

struct WrapObject {
  std::string name;
  Index body = 0;
  RigidTransform frame = RigidTransform::Identity();
  WrapSurface surface;
  bool active = true;  ///< no path runs around one that is not, though a path names it
};

/// A point that a path goes through: always, within a range of a coordinate, or moving with coordinates.
struct PathPoint {
  std::string name;
  Index body = 0;
  Vec3 location = Vec3::Zero();
  Index condition = -1;  ///< coordinate; active while it is within the range
  Real range_min = 0, range_max = 0;
  bool moving = false;
  std::array<Index, 3> moves_with = {-1, -1, -1};  ///< coordinate of each component; -1: it stays
  std::array<Function, 3> moves_to;
};

struct PathWrap {
  Index object = 0;
  int first_point = -1, last_point = -1;  ///< counted from 1; below 1: the path's own ends
  WrapSurface::Plane plane = WrapSurface::Plane::hybrid;
};

/// A muscle's way, through points and around wrap objects, or as a polynomial of coordinates.
struct Path {
  std::vector<PathPoint> points;
  std::vector<PathWrap> wraps;
  std::vector<Index> function_coordinates;  ///< not empty: the length is `length_function` of these
  Function length_function;
  bool approximate = false;  ///< its length may differ from OpenSim's by more than 1e-6 m
};

struct Muscle {
  std::string name, type;
  Path path;
  bool applies_force = true;
  Real max_isometric_force = 1000, optimal_fiber_length = 0.1, tendon_slack_length = 0.2;  ///< N, m, m
  Real pennation_angle_at_optimal = 0, max_contraction_velocity = 10;                      ///< rad, fiber lengths/s
  Real min_control = 0.01, max_control = 1;
  bool ignore_tendon_compliance = false, ignore_passive_force = false;
  Real max_pennation_angle = 1.4706289056333368;  ///< rad, acos(0.1)
  Real fiber_damping = 0;                         ///< over the largest force, by speed over the largest speed
  /// Curves of Thelen2003Muscle (KshapeActive, Af, Flen, KshapePassive).
  Real active_shape = 0.45, velocity_shape = 0.25, eccentric_force = 1.4, passive_shape = 5;
  /// Of Thelen2003Muscle and DeGrooteFregly2016Muscle: strains at which fibers' passive and tendons' force are the
  /// largest isometric one; how much wider the latter's active force is.
  Real fiber_strain = 0.6, tendon_strain = 0.04, active_width = 1;
  MillardCurves millard = MillardCurves();  ///< of Millard2012EquilibriumMuscle
};

/// Which curves a muscle has, by its type: all that are neither Thelen's nor Millard's have De Groote's.
enum class MuscleCurves { thelen, millard, de_groote };
/// By its type's name.
MuscleCurves curves_of(const Muscle& muscle);

/// A force that is not a muscle's: on one coordinate, at a point, or about an axis.
struct Actuator {
  enum class Kind { coordinate, point, torque };
  std::string name;
  Kind kind = Kind::coordinate;
  bool applies_force = true;
  Real optimal_force = 1;
  Real min_control = -std::numeric_limits<Real>::infinity(), max_control = std::numeric_limits<Real>::infinity();
  Index coordinate = -1;
  Index body = 0, other_body = 0;  ///< a torque acts against the other body
  Vec3 point = Vec3::Zero(), direction = Vec3::UnitX();
  bool point_is_global = false, direction_is_global = true;
};

/// A force that follows from the pose and its speed alone.
struct PassiveForce {
  enum class Kind {
    limit,               ///< of a coordinate beyond two values (CoordinateLimitForce)
    coordinate_spring,   ///< of a coordinate (SpringGeneralizedForce)
    path_spring,         ///< along a path longer than at rest (PathSpring)
    ligament,            ///< the same by a curve of the relative length (Ligament)
    toe_ligament,        ///< along a path, curved up to a strain and straight beyond it (Blankevoort1991Ligament)
    point_spring,        ///< between two points (PointToPointSpring)
    bushing,             ///< between two frames (BushingForce)
    formula_bushing,     ///< the same by formulas (ExpressionBasedBushingForce)
    formula_coordinate,  ///< on a coordinate by a formula of it (ExpressionBasedCoordinateForce)
    formula_points       ///< between two points by a formula (ExpressionBasedPointToPointForce)
  };
  std::string name;
  Kind kind = Kind::limit;
  bool applies_force = true;
  Index coordinate = -1;
  Real upper_limit = 0, lower_limit = 0, upper_stiffness = 0, lower_stiffness = 0;  ///< rad (m), N·m/rad (N/m)
  Real transition = 0;  ///< rad (m), over which a limit's stiffness grows
  Path path;
  Real rest_length = 0;             ///< m; of a coordinate's spring its value at rest
  Real stiffness = 0, damping = 0;  ///< N/m (N·m/rad); N·m·s/rad, of path springs s/m
  Real pcsa_force = 0;              ///< N
  Real transition_strain = 0;       ///< up to which a toe ligament is curved; its stiffness is N per strain
  Function curve;                   ///< force over pcsa_force by length over rest length
  Index body = 0, other_body = 0;
  RigidTransform frame = RigidTransform::Identity(), other_frame = RigidTransform::Identity();  ///< in their bodies
  Eigen::Matrix<Real, 6, 1> stiffnesses = Eigen::Matrix<Real, 6, 1>::Zero();  ///< of a bushing: rotations, translations
  Eigen::Matrix<Real, 6, 1> dampings = Eigen::Matrix<Real, 6, 1>::Zero();
  std::vector<std::string> formulas;  ///< six of a bushing (Mx ... Fz), one of others
};

struct Model {
  std::string name;
  int version = 0;  ///< of the document: 30000, 40000 ...
  Vec3 gravity = {0, -9.80665, 0};
  std::vector<Body> bodies;  ///< bodies[0] is the ground
  /// By "owner/name", where the owner is the joint or body that holds them: what points of force sets may name, too.
  std::map<std::string, PlacedFrame> frames;
  std::vector<Joint> joints;  ///< parents before children; every body but the ground is a child once
  std::vector<Coordinate> coordinates;
  std::vector<Coupler> couplers;  ///< behind those that set what they depend on
  std::vector<LoopConstraint> loops;
  std::vector<WrapObject> wrap_objects;
  std::vector<Muscle> muscles;
  std::vector<Actuator> actuators;
  std::vector<PassiveForce> passive_forces;
  std::vector<std::string> missing_forces;  ///< names of the file's forces that act there and not here
  std::vector<std::string> unsupported;     ///< what the file holds and this model leaves out, a sentence each
};

/// Index of what is called `name`; -1 when nothing is.
template <class T>
Index index_of(const std::vector<T>& things, const std::string& name) {
  for (std::size_t i = 0; i < things.size(); ++i)
    if (things[i].name == name) return static_cast<Index>(i);
  return -1;
}

/// What things are called, in their order.
template <class T>
std::vector<std::string> names_of(const std::vector<T>& things) {
  std::vector<std::string> names;
  for (const T& thing : things) names.push_back(thing.name);
  return names;
}

/// The coordinates' default values, with dependent ones set from the couplers; loops may be open (assembled_defaults).
Eigen::VectorXd default_coordinates(const Model& model);

/// Sets dependent coordinates from the couplers.
void apply_couplers(const Model& model, Eigen::VectorXd& coordinates);
/// Whether a coupler sets the coordinate.
bool is_dependent(const Model& model, Index coordinate);

/// A rotation about x, then about the new y, then about the new z, as OpenSim gives orientations; then the translation.
RigidTransform body_fixed_xyz(const Vec3& angles, const Vec3& translation);

}  // namespace gracilis::opensim
