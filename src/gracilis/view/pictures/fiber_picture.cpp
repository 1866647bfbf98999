#include <gracilis/view/pictures/fiber_picture.hpp>

#include <gracilis/view/pictures/muscle_colors.hpp>

namespace gracilis {

Picture muscle_fiber_picture(const Muscle& muscle, const Polylines& fibers, const Color& color) {
  Picture picture;
  picture.title = muscle.name;
  // The two axes along which the muscle is wide, and the one along which it is thin.
  const Vec3 extent = muscle.surface.vertices.rowwise().maxCoeff() - muscle.surface.vertices.rowwise().minCoeff();
  Eigen::Index longest = 2;
  extent.maxCoeff(&longest);
  const Vec3 up = Vec3::Unit(longest), side = Vec3::Unit((longest + 1) % 3), front = Vec3::Unit((longest + 2) % 3);
  for (const auto& [caption, looking] : {std::pair{"from a side", side},
                                         {"from the next, 90 degrees on", front},
                                         {"from between the two", Vec3((side + front).normalized())}}) {
    Panel panel;
    panel.caption = caption;
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
  const Vec3 forward = scene.axes.anterior, right = scene.axes.right();
  for (const auto& [caption, looking] : {std::pair{"from the front", Vec3(-forward)},
                                         {"from the right", Vec3(-right)},
                                         {"from behind", forward},
                                         {"from the left", right}}) {
    Panel panel;
    panel.caption = caption;
    panel.looking = looking;
    panel.up = scene.axes.superior;
    for (const Bone& bone : scene.bones) panel.surfaces.push_back({"", bone.surface});
    for (std::size_t i = 0; i < scene.muscles.size(); ++i)
      panel.lines.push_back({fibers[i], muscle_color(scene.muscles[i].name), 1});
    picture.panels.push_back(std::move(panel));
  }
  picture.columns = 2;
  return picture;
}

}  // namespace gracilis
