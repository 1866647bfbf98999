#pragma once

#include <gracilis/anatomy/sections/spindle.hpp>
#include <gracilis/opensim/import/volume_settings.hpp>
#include <gracilis/opensim/reader/model.hpp>
#include <gracilis/scene/scene.hpp>

namespace gracilis::opensim {

/// A muscle of a model before it has a surface.
struct MuscleLine {
  ActionLine line;  ///< its bodies are the model's
  MuscleSize size;
  Real tendon_share = 1;  ///< of the tendon's length that the line left room for
};

/// The line along a muscle's path for the bodies at `poses`, and what of it is tendon. Throws InputError for a path by
/// functions, which has no place, for one without length, and for a muscle without force.
MuscleLine muscle_line(const Model& model, const Muscle& muscle, const std::vector<RigidTransform>& poses,
                       const Eigen::VectorXd& coordinates, const VolumeSettings& settings);

/// In how many parts a length (m) is divided so that none is longer than `longest` (m).
Index part_count(Real length, Real longest);

/// Radii of round sections (m) at these places along the line (m, ascending), by spindle_radii.
Eigen::VectorXd radii_at(const MuscleLine& muscle, const std::vector<Real>& places);

}  // namespace gracilis::opensim
