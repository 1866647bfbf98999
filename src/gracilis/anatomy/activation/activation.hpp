#pragma once

#include <gracilis/anatomy/joints/joint_control.hpp>
#include <gracilis/scene/pose.hpp>
#include <gracilis/scene/scene.hpp>

#include <vector>

namespace gracilis {

/// Says how active every muscle of a scene is at a pose, by the scene's plan. Requires that `validate` finds nothing in
/// the scene, which must outlive this.
class ActivationDriver {
 public:
  explicit ActivationDriver(const Scene& scene);  ///< keeps a reference to the scene

  /// One activation per muscle of the scene, within 0 and 1, at the pose's time and coordinates.
  std::vector<Real> at(const Pose& pose) const;

 private:
  struct Unit {
    JointControl control;
    std::vector<std::size_t> coordinates;  ///< of the pose
    std::vector<std::size_t> muscles;      ///< of the scene; none for names that the scene does not have
  };
  std::size_t muscle_index(const std::string& name) const;

  const Scene& scene_;
  std::vector<Unit> units_;
};

/// The value of a signal at a time.
Real value_at(const ActivationSignal& signal, Real time);

/// Fills in Pose::activations of all poses.
void set_activations(const Scene& scene, std::vector<Pose>& poses);

/// The function of pose that is linear in one coordinate between points (rows: rad, activation; coordinates ascending)
/// and constant beyond them. `coordinate` is an index into Pose::coordinates.
std::function<Real(const Pose&)> along_coordinate(std::size_t coordinate, const Eigen::MatrixX2d& points);

}  // namespace gracilis
