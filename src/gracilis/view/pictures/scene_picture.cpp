#include <gracilis/view/pictures/scene_picture.hpp>

#include <gracilis/core/words_of_name.hpp>
#include <gracilis/view/pictures/muscle_colors.hpp>

#include <algorithm>
#include <array>

namespace gracilis {
namespace {

const Color origin_color(0.84, 0.15, 0.12), insertion_color(0.1, 0.3, 0.85), doubtful_color(0.98, 0.75, 0.0),
    on_muscle_color(0.55, 0.2, 0.7), axis_color(0.0, 0.55, 0.35);
constexpr Real axis_reach = 0.08, axis_radius = 0.0015;  // m
constexpr Real bone_opacity = 0.45;                      // where attachments are to be seen that lie in bones

/// The triangles about an attachment's vertices.
TriangleMesh attached_faces(const Muscle& muscle, const Attachment& attachment) {
  std::vector<char> held(static_cast<std::size_t>(muscle.surface.vertex_count()), 0);
  for (const Index v : attachment.vertices) held[static_cast<std::size_t>(v)] = 1;
  std::vector<Index> faces;
  for (Index f = 0; f < muscle.surface.face_count(); ++f) {
    int corners = 0;
    for (int k = 0; k < 3; ++k) corners += held[static_cast<std::size_t>(muscle.surface.faces(k, f))];
    if (corners == 3) faces.push_back(f);
  }
  return {muscle.surface.vertices, muscle.surface.faces(Eigen::all, faces)};
}

/// Adds the attachments of all muscles, each kind named once in the legend.
void add_attachments(const Scene& scene, const std::set<std::string>& doubtful, Panel& panel) {
  std::set<std::string> named;
  for (const Muscle& muscle : scene.muscles)
    for (const Attachment& attachment : muscle.attachments) {
      TriangleMesh faces = attached_faces(muscle, attachment);
      if (faces.face_count() == 0) continue;
      const bool doubt = doubtful.contains(muscle.name + " " + attachment.name);
      const bool origin = attachment.end == AttachmentEnd::origin;
      auto [name, color] = muscle_body(scene, attachment.body) ? std::pair("end on a muscle", on_muscle_color)
                           : origin                            ? std::pair("origin", origin_color)
                                                               : std::pair("insertion", insertion_color);
      if (doubt) name = "doubtful end", color = doubtful_color;
      panel.surfaces.push_back({named.insert(name).second ? name : "", std::move(faces), color});
    }
}

void add_axes(const Scene& scene, Panel& panel) {
  PaintedLines axes;
  axes.color = axis_color;
  axes.radius = axis_radius;
  for (const Joint& joint : scene.joints)
    for (const JointAxis& axis : joint.axes) {
      const Vec3 center = joint.frame.translation(), along = axis_reach * (joint.frame.linear() * axis.axis);
      Points line(3, 2);
      line << center - along, center + along;
      axes.lines.append(line);
    }
  panel.lines.push_back(std::move(axes));
}

void add_bones(const Scene& scene, Real opacity, Panel& panel) {
  for (const Bone& bone : scene.bones) panel.surfaces.push_back({"", bone.surface, bone_color(), opacity});
}

void add_muscles(const Scene& scene, Panel& panel) {
  for (const Muscle& muscle : scene.muscles) panel.surfaces.push_back({"", muscle.surface, muscle_color(muscle.name)});
}

}  // namespace

Picture scene_picture(const Scene& scene, const std::set<std::string>& doubtful) {
  const Vec3 forward = scene.axes.anterior, right = scene.axes.right();
  const std::array<std::pair<const char*, Vec3>, 4> views = {
      {{"from the front", -forward}, {"from the right", -right}, {"from behind", forward}, {"from the left", right}}};
  Picture picture;
  picture.title = words_of_name(scene.name) + ": where muscles attach, joints' axes; muscles";
  picture.columns = static_cast<int>(views.size());
  picture.panel_width = 480;
  picture.scale_bar = true;
  for (const bool with_muscles : {false, true})
    for (const auto& [caption, looking] : views) {
      Panel panel;
      panel.caption = caption;
      panel.looking = looking;
      panel.up = scene.axes.superior;
      add_bones(scene, with_muscles ? 1 : bone_opacity, panel);
      if (with_muscles)
        add_muscles(scene, panel);
      else
        add_attachments(scene, doubtful, panel), add_axes(scene, panel);
      picture.panels.push_back(std::move(panel));
    }
  return picture;
}

}  // namespace gracilis
