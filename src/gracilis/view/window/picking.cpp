#include <gracilis/view/window/picking.hpp>

#include <gracilis/core/words_of_name.hpp>

#include <fmt/format.h>
#include <vtkCamera.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <limits>

namespace gracilis {

Vec3 WindowProjection::in_window(const Vec3& place) const {
  const Vec3 along = axes.transpose() * (place - middle);
  return {width / 2 + pixels_per_metre * along.x(), height / 2 + pixels_per_metre * along.y(), along.z()};
}

Vec3 WindowProjection::in_world(const Vec3& in_window) const {
  return middle + axes * Vec3((in_window.x() - width / 2) / pixels_per_metre,
                              (in_window.y() - height / 2) / pixels_per_metre, in_window.z());
}

WindowProjection projection_of(vtkRenderer& renderer) {
  vtkCamera* camera = renderer.GetActiveCamera();
  WindowProjection projection;
  const Vec3 back = -Vec3(camera->GetDirectionOfProjection());
  const Vec3 right = Vec3(camera->GetViewUp()).cross(back).normalized();
  projection.axes << right, back.cross(right), back;
  projection.middle = Vec3(camera->GetFocalPoint());
  projection.width = renderer.GetSize()[0], projection.height = renderer.GetSize()[1];
  projection.pixels_per_metre = projection.height / (2 * camera->GetParallelScale());
  return projection;
}

namespace {

/// Looks for what lies nearest to the eye.
struct Search {
  Eigen::Vector2d pixel;
  Real highest = -std::numeric_limits<Real>::infinity();
  std::optional<SurfaceHit> found = {};

  void look_at(const Points& in_window, const Eigen::Matrix3Xi& faces, bool is_bone, std::size_t number) {
    for (const Eigen::Vector3i face : faces.colwise()) {
      const Vec3 a = in_window.col(face[0]), b = in_window.col(face[1]), c = in_window.col(face[2]);
      const Eigen::Vector2d ab = (b - a).head<2>(), ac = (c - a).head<2>(), ap = pixel - a.head<2>();
      const Real area = ab.x() * ac.y() - ab.y() * ac.x();
      if (area == 0) continue;
      const Real of_b = (ap.x() * ac.y() - ap.y() * ac.x()) / area, of_c = (ab.x() * ap.y() - ab.y() * ap.x()) / area;
      if (of_b < 0 || of_c < 0 || of_b + of_c > 1) continue;
      const Vec3 place = a + of_b * (b - a) + of_c * (c - a);
      if (place.z() <= highest) continue;
      highest = place.z();
      const int corner = of_b > of_c && of_b > 1 - of_b - of_c ? 1 : of_c > 1 - of_b - of_c ? 2 : 0;
      found = SurfaceHit{is_bone, number, face[corner], place};
    }
  }
};

Points in_window(const Points& points, const WindowProjection& projection) {
  Points result(3, points.cols());
  for (Index v = 0; v < points.cols(); ++v) result.col(v) = projection.in_window(points.col(v));
  return result;
}

}  // namespace

std::optional<SurfaceHit> surface_at(int x, int y, const ShownShapes& shapes, const ShownFrame& frame,
                                     const WindowState& state, const WindowProjection& projection) {
  Search search{{x, y}};
  for (std::size_t m = 0; m < frame.muscles.size(); ++m)
    if (state.muscles[m] != MuscleState::hidden)
      search.look_at(in_window(frame.muscles[m].cast<Real>(), projection), shapes.muscle_faces[m], false, m);
  for (std::size_t b = 0; state.bones && b < frame.bones.size(); ++b)
    search.look_at(in_window(frame.bones[b] * shapes.bone_points[b].cast<Real>(), projection), shapes.bone_faces[b],
                   true, b);
  if (search.found) search.found->place = projection.in_world(search.found->place);
  return search.found;
}

std::string numbers_of(const PickedVertex& picked, const ShownShapes& shapes, const ShownFrame& frame) {
  const std::size_t m = picked.muscle;
  const auto v = static_cast<std::size_t>(picked.vertex);
  const Eigen::Vector3f place = 1000 * frame.muscles[m].col(picked.vertex);
  std::string text = fmt::format("{}, vertex {}\nat {:.1f}, {:.1f}, {:.1f} mm", words_of_name(shapes.muscles[m]),
                                 shapes.vertex_numbers[m][v], place.x(), place.y(), place.z());
  const auto add = [&](const std::vector<std::vector<float>>& values, const char* form, float factor) {
    if (m < values.size() && v < values[m].size()) text += fmt::format(fmt::runtime(form), factor * values[m][v]);
  };
  add(frame.stretch, "\nedges {:.2f} × rest", 1);
  add(frame.stress, "\nfibers {:.1f} kPa", 0.001f);
  add(frame.contact_depth, "\ncontact {:.2f} mm", 1000);
  return text;
}

}  // namespace gracilis
