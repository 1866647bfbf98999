#include <gracilis/view/export/animated_run.hpp>

#include <gracilis/geometry/decimation.hpp>
#include <gracilis/geometry/rotations.hpp>

namespace gracilis {

AnimatedSurface animated_surface(const RecordedRun& run, const std::string& name, Index most_vertices) {
  const TriangleMesh rest = placed_surface(run, name, 0);
  CoarseSurface coarse = decimate(rest, most_vertices);
  Points points = picked(rest.vertices, coarse.vertices);
  return {name, std::move(coarse.vertices), std::move(coarse.faces), std::move(points)};
}

Points points_in(const RecordedRun& run, const AnimatedSurface& surface, int frame) {
  return picked(placed_surface(run, surface.name, frame).vertices, surface.vertices);
}

std::vector<RigidTransform> bone_motions(const RecordedRun& run, const std::string& name,
                                         const std::vector<int>& frames) {
  const TriangleMesh rest = placed_surface(run, name, 0);
  std::vector<RigidTransform> motions;
  for (const int frame : frames)
    motions.push_back(rigid_motion(rest.vertices, placed_surface(run, name, frame).vertices));
  return motions;
}

Eigen::Matrix3d upright_turn(const RecordedRun& run) {
  // Rows are where the axes of the animation point in the run's frame.
  Eigen::Matrix3d turn;
  turn << -run.axes.right().transpose(), run.axes.superior.transpose(), run.axes.anterior.transpose();
  return turn;
}

}  // namespace gracilis
