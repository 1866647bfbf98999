#include <gracilis/view/pictures/fiber_picture.hpp>

namespace gracilis {

namespace {

/// The world's upright axis: the one along which bones hang below each other, else the one that muscles are longest in.
Vec3 up_direction(const Scene& scene) {
  Eigen::AlignedBox3d fixed, moving;
  for (const Bone& bone : scene.bones) {
    Eigen::AlignedBox3d& box = bone.body == 0 ? fixed : moving;
    box.extend(Vec3(bone.surface.vertices.rowwise().minCoeff()));
    box.extend(Vec3(bone.surface.vertices.rowwise().maxCoeff()));
  }
  if (fixed.isEmpty() || moving.isEmpty()) return Vec3::UnitZ();
  const Vec3 upwards = fixed.center() - moving.center();
  Eigen::Index axis = 2;
  upwards.cwiseAbs().maxCoeff(&axis);
  Vec3 up = Vec3::Zero();
  up[axis] = upwards[axis] < 0 ? -1 : 1;
  return up;
}

}  // namespace

Picture muscle_fiber_picture(const Muscle& muscle, const Polylines& fibers, const Color& color) {
  Picture picture;
  picture.title = muscle.name;
  // The two axes along which the muscle is wide, and the one along which it is thin.
  const Vec3 extent = muscle.surface.vertices.rowwise().maxCoeff() - muscle.surface.vertices.rowwise().minCoeff();
  Eigen::Index longest = 2;
  extent.maxCoeff(&longest);
  const Vec3 up = Vec3::Unit(longest), side = Vec3::Unit((longest + 1) % 3), front = Vec3::Unit((longest + 2) % 3);
  for (const Vec3& looking : {side, front, Vec3((side + front).normalized())}) {
    Panel panel;
    panel.looking = looking;
    panel.up = up;
    panel.surfaces.push_back({"", muscle.surface, color, 0.2});
    panel.lines.push_back({fibers, Color(0.25, 0.05, 0.05), 1});
    picture.panels.push_back(std::move(panel));
  }
  picture.panel_width = 600;
  return picture;
}

Picture all_fibers_picture(const Scene& scene, const std::vector<Polylines>& fibers) {
  Picture picture;
  picture.title = scene.name;
  const Vec3 up = up_direction(scene), side = up.unitOrthogonal(), front = up.cross(side);
  for (const Vec3& looking : {side, front, Vec3(-side), Vec3(-front)}) {
    Panel panel;
    panel.looking = looking;
    panel.up = up;
    for (const Bone& bone : scene.bones) panel.surfaces.push_back({"", bone.surface});
    for (std::size_t i = 0; i < scene.muscles.size(); ++i)
      panel.lines.push_back({fibers[i], muscle_color(static_cast<Index>(i)), 1});
    picture.panels.push_back(std::move(panel));
  }
  picture.columns = 2;
  return picture;
}

}  // namespace gracilis
