#pragma once

#include <gracilis/io/tables/table.hpp>
#include <gracilis/opensim/kinematics/coordinate_motion.hpp>

#include <optional>

namespace gracilis::opensim {

/// One axis of a scene's joint. A scene's axes have a coordinate each; where a model's axis is a function of
/// coordinates, its value gets a name of its own, such as knee_r_translation1.
struct SceneAxis {
  std::string coordinate;
  const TransformAxis* axis = nullptr;
  bool translation = false;
  Real range_min = -pi, range_max = pi;  ///< rad (m)
};

/// The axes of a joint that do something, in the order of a scene's joint: translations, then rotations.
std::vector<SceneAxis> scene_axes(const Model& model, const Joint& joint);

/// The axis' value where the model's coordinates are these, rad (m).
Real value_of(const SceneAxis& axis, const Eigen::VectorXd& coordinates);

/// How a coordinate of a model stands in a scene: `slope` times it and `offset` is the scene's.
struct SceneCoordinate {
  std::string name;
  Real slope = 1, offset = 0;
  bool translation = false;
};

/// A range's bound (rad or m) as scenes have it: finite, and so far off that nothing comes there.
Real scene_bound(Real bound);

/// Nothing where no axis of the coordinate's joint follows it alone and evenly.
std::optional<SceneCoordinate> scene_coordinate(const Model& model, Index coordinate);

/// A model's motion as a scene reads it: a column per axis, in rad and m.
Table scene_motion(const Model& model, const CoordinateMotion& motion, const std::string& name);

}  // namespace gracilis::opensim
