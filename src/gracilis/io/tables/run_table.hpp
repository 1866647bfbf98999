#pragma once

#include <gracilis/scene/muscle_forces.hpp>
#include <gracilis/scene/pose.hpp>
#include <gracilis/scene/scene.hpp>

#include <string>

namespace gracilis {

/// A .sto table of a run to which each frame adds a row.
struct RunTable {
  std::string name;       ///< of the file
  std::string head, row;  ///< text, with line breaks
};

/// Labels and numbers of one row, which grow together. Tables have no empty cells, so that a number that is not finite
/// throws QualityError.
struct RowColumns {
  std::string labels = "time", row;
  std::size_t count = 1;

  /// A column. Throws QualityError where the value is not finite.
  void add(const std::string& label, Real value);
  /// _x, _y and _z
  void add(const std::string& label, const Vec3& vector);
  /// _force_x ... and _moment_x ... about the place of the world's origin in the capture pose, which went with the
  /// body.
  void add(const std::string& label, const Wrench& wrench, const RigidTransform& body);
};

/// The time, then the scene's coordinates (degrees or m).
RowColumns begin_row(const Scene& scene, const Pose& pose);

/// `rows`: how many the file will have.
RunTable run_table(const std::string& file, int rows, const RowColumns& columns);

/// What tables call a muscle's fiber: muscle_f000
std::string fiber_name(const std::string& muscle, Index fiber);

}  // namespace gracilis
