#include <gracilis/view/window/window_scene.hpp>

#include <gracilis/view/pictures/muscle_colors.hpp>
#include <gracilis/view/pictures/muscle_look.hpp>
#include <gracilis/view/pictures/run_picture.hpp>
#include <gracilis/view/window/arrows.hpp>
#include <gracilis/view/window/picking.hpp>

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkMapper.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gracilis {

static constexpr Real fiber_radius = 0.0007;         // m
static constexpr float attachment_radius = 0.0012f;  // m
static constexpr Real opacity_seen_through = 0.3;
static constexpr Real picked_pixels = 5;  // however far the camera is

static void paint(const Color& color, SurfaceActor& surface) {
  surface.actor->GetProperty()->SetColor(color.x(), color.y(), color.z());
}

WindowScene::WindowScene(const ShownShapes& shapes, const ShapeHistory& history, vtkRenderer& renderer)
    : shapes_(shapes), history_(history), renderer_(renderer) {
  seen_.fill({std::numeric_limits<Real>::infinity(), -std::numeric_limits<Real>::infinity()});
  const std::shared_ptr<const ShownFrame> first = history.at(0);
  for (std::size_t b = 0; b < shapes.bones.size(); ++b)
    bones_.push_back(add_surface(shapes.bone_points[b], shapes.bone_faces[b], bone_color(), renderer));
  for (std::size_t m = 0; m < shapes.muscles.size(); ++m) {
    evened_.emplace_back(TriangleMesh{first->muscles[m].cast<Real>(), shapes.muscle_faces[m]});
    MuscleActors actors{
        add_surface(first->muscles[m], shapes.muscle_faces[m], muscle_color(shapes.muscles[m]), renderer),
        add_empty(true, renderer),
        add_empty(true, renderer),
        {}};
    for (std::size_t g = 0; g < actors.ghosts.size(); ++g) {
      actors.ghosts[g] = add_surface(first->muscles[m], shapes.muscle_faces[m], Color(0.30, 0.42, 0.62), renderer);
      actors.ghosts[g].actor->GetProperty()->SetOpacity(0.28 / static_cast<Real>(g + 1));
      actors.ghosts[g].actor->VisibilityOff();
    }
    muscles_.push_back(std::move(actors));
  }
  slice_ = add_empty(false, renderer);
  arrows_ = add_empty(true, renderer);
  picked_ = add_empty(false, renderer);
}

/// Whether colors tell only whose or what a vertex is, and nothing else says where it is measured.
static bool evens(const WindowState& state) {
  const bool tells_values = state.color_by != WindowColor::natural && state.color_by != WindowColor::muscle &&
                            state.color_by != WindowColor::tissue;
  return !tells_values && state.style == SurfaceStyle::solid && state.arrows == Arrows::none &&
         state.slice == Slice::none;
}

ShownPoints WindowScene::drawn_points(std::size_t muscle, const ShownFrame& frame, const WindowState& state) const {
  const ShownPoints& points = frame.muscles[muscle];
  return evens(state) ? evened_[muscle].of(points.cast<Real>()).cast<float>() : points;
}

static bool colors_fibers(const WindowState& state) {
  return state.color_by == WindowColor::fiber_strain || state.color_by == WindowColor::tension;
}

bool is_seen_through(std::size_t muscle, const WindowState& state) {
  return state.muscles[muscle] == MuscleState::transparent || state.fibers || colors_fibers(state) ||
         state.arrows != Arrows::none || state.slice != Slice::none || state.attachments;
}

static std::vector<Color> tissue_of(const ShownShapes& shapes, std::size_t muscle, std::size_t count) {
  const std::vector<TissueColor>& colors = tissue_colors();
  std::vector<Color> result(count, Color::Constant(0.75));
  for (std::size_t v = 0; v < shapes.belly[muscle].size(); ++v) {
    const HeldAt held = shapes.held[muscle][v];
    const Real belly = shapes.belly[muscle][v];
    // A sharp step in the middle of the grade tells the two apart better than a long blend.
    const Real share = std::clamp((belly - 0.4) / 0.2, 0.0, 1.0);
    result[v] = held == HeldAt::origin      ? colors[2].color
                : held == HeldAt::insertion ? colors[3].color
                                            : Color((1 - share) * colors[1].color + share * colors[0].color);
  }
  return result;
}

/// By the scale, and remembered for what stands beside its bar.
Color WindowScene::color_of(Real value, WindowColor by) {
  auto& [least, most] = seen_[static_cast<std::size_t>(by)];
  if (std::isfinite(value)) least = std::min(least, value), most = std::max(most, value);
  return color_at(window_scale(by), value);
}

std::vector<std::string> WindowScene::ticks(WindowColor color) const {
  return ticks_for(window_scale(color), seen_[static_cast<std::size_t>(color)]);
}

/// The colors of a muscle's vertices; empty where its own color says all.
std::vector<Color> WindowScene::vertex_colors(std::size_t muscle, const ShownFrame& frame, WindowColor by) {
  const auto count = static_cast<std::size_t>(frame.muscles[muscle].cols());
  const auto each = [&](const std::vector<float>& values, const auto& shown) {
    std::vector<Color> colors(count, Color::Constant(0.8));
    for (std::size_t v = 0; v < std::min(values.size(), count); ++v) colors[v] = color_of(shown(values[v]), by);
    return colors;
  };
  switch (by) {
    case WindowColor::natural:
      return shapes_.natural[muscle];
    case WindowColor::muscle:
      return {};
    case WindowColor::tissue:
      return tissue_of(shapes_, muscle, count);
    case WindowColor::activation:
      return std::vector<Color>(count, color_of(frame.activation[muscle], by));
    case WindowColor::volume:
      return std::vector<Color>(count, color_of(frame.volume[muscle] - 1, by));
    case WindowColor::stress:
      return each(frame.stress.empty() ? std::vector<float>() : frame.stress[muscle],
                  [](float stress) { return std::log10(std::max(1.0, static_cast<Real>(stress))); });
    case WindowColor::tension:
    case WindowColor::fiber_strain:
      return std::vector<Color>(count, flesh_color());
    case WindowColor::edge_stretch:
      return each(frame.stretch[muscle], [](float ratio) { return std::log2(static_cast<Real>(ratio)); });
    case WindowColor::contact_depth:
      return each(frame.contact_depth.empty() ? std::vector<float>() : frame.contact_depth[muscle],
                  [](float depth) { return static_cast<Real>(depth); });
  }
  return {};
}

void WindowScene::show_muscle(std::size_t muscle, const ShownFrame& frame, const WindowState& state, bool fast) {
  SurfaceActor& surface = muscles_[muscle].surface;
  const bool visible = state.muscles[muscle] != MuscleState::hidden;
  surface.actor->SetVisibility(visible);
  if (!visible) return;
  move_points(drawn_points(muscle, frame, state), shapes_.muscle_faces[muscle], surface);
  set_point_colors(vertex_colors(muscle, frame, state.color_by), surface);
  // They cost as much as half of all the rest.
  set_stripes(state.color_by == WindowColor::natural && !fast ? shapes_.stripes[muscle] : std::vector<Real>(),
              *stripe_texture_, surface);
  vtkProperty* property = surface.actor->GetProperty();
  property->SetOpacity(is_seen_through(muscle, state) ? opacity_seen_through : 1);
  // The far side of a closed surface is never seen, unless one looks through it.
  property->SetBackfaceCulling(property->GetOpacity() == 1 && state.style != SurfaceStyle::wireframe);
  property->SetEdgeVisibility(state.style == SurfaceStyle::edges);
  property->SetRepresentation(state.style == SurfaceStyle::wireframe ? VTK_WIREFRAME : VTK_SURFACE);
}

void WindowScene::show_fibers(std::size_t muscle, const ShownFrame& frame, const WindowState& state) {
  const bool by_fiber = colors_fibers(state);
  SurfaceActor& tubes = muscles_[muscle].fibers;
  const bool visible =
      (state.fibers || by_fiber) && state.muscles[muscle] != MuscleState::hidden && frame.fibers[muscle].count() > 0;
  tubes.actor->SetVisibility(visible);
  if (!visible) return;
  std::vector<Color> colors;
  if (state.color_by == WindowColor::tension && !frame.tension.empty())
    for (const Real tension : frame.tension[muscle])
      colors.push_back(color_of(std::log10(std::max(1e-9, tension)), state.color_by));
  for (const Real strain : frame.strain[muscle])
    if (state.color_by == WindowColor::fiber_strain) colors.push_back(color_of(std::log2(strain), state.color_by));
  const std::string& name = shapes_.muscles[muscle];
  paint(state.color_by == WindowColor::natural ? fiber_paint(name) : muscle_color(name), tubes);
  set_tubes(frame.fibers[muscle], fiber_radius, colors, tubes);
}

void WindowScene::show_attachments(std::size_t muscle, const ShownFrame& frame, const WindowState& state) {
  SurfaceActor& dots = muscles_[muscle].attachments;
  const bool visible =
      state.attachments && state.muscles[muscle] != MuscleState::hidden && !shapes_.held[muscle].empty();
  dots.actor->SetVisibility(visible);
  if (!visible) return;
  ColoredMesh mesh;
  const ShownPoints points = drawn_points(muscle, frame, state);
  for (std::size_t v = 0; v < shapes_.held[muscle].size(); ++v) {
    const HeldAt held = shapes_.held[muscle][v];
    if (held != HeldAt::nothing)
      append_dot(points.col(static_cast<Index>(v)), attachment_radius,
                 tissue_colors()[held == HeldAt::origin ? 2 : 3].color, mesh);
  }
  set_shape(mesh, dots);
}

void WindowScene::show_ghosts(std::size_t muscle, int frame, const WindowState& state) {
  for (std::size_t g = 0; g < trail_steps.size(); ++g) {
    SurfaceActor& ghost = muscles_[muscle].ghosts[g];
    const int number = state.ghost == Ghost::first_frame ? 0 : frame - trail_steps[g];
    const bool visible = state.ghost != Ghost::none && state.muscles[muscle] != MuscleState::hidden &&
                         number >= history_.begin() && number < frame && (state.ghost == Ghost::trail || g == 0);
    ghost.actor->SetVisibility(visible);
    if (visible) move_points(drawn_points(muscle, *history_.at(number), state), shapes_.muscle_faces[muscle], ghost);
  }
}

void WindowScene::show_bones(const ShownFrame& frame, const WindowState& state) {
  // Beside colors that mean something bones step back.
  const Color color = state.color_by == WindowColor::natural || state.color_by == WindowColor::muscle ||
                              state.color_by == WindowColor::tissue
                          ? bone_color()
                          : Color(0.72, 0.74, 0.75);
  for (std::size_t b = 0; b < bones_.size(); ++b) {
    bones_[b].actor->SetVisibility(state.bones);
    vtkNew<vtkMatrix4x4> matrix;
    for (int row = 0; row < 4; ++row)
      for (int column = 0; column < 4; ++column) matrix->SetElement(row, column, frame.bones[b].matrix()(row, column));
    bones_[b].actor->SetUserMatrix(matrix);
    bones_[b].actor->GetProperty()->SetOpacity(state.slice == Slice::none ? 1 : 0.25);
    bones_[b].actor->GetProperty()->SetBackfaceCulling(state.slice == Slice::none);
    paint(color, bones_[b]);
  }
}

void WindowScene::show_arrows(const ShownFrame& frame, const WindowState& state) {
  const std::vector<Displacement> displacements = displacements_of(shapes_, frame, state);
  arrows_.actor->SetVisibility(!displacements.empty());
  if (displacements.empty()) return;
  arrow_scale_ = gracilis::arrow_scale(displacements);
  set_shape(arrow_mesh(displacements, arrow_scale_), arrows_);
}

void WindowScene::show_picked(const ShownFrame& frame, const WindowState& state) {
  picked_.actor->SetVisibility(state.picked.has_value());
  if (!state.picked) return;
  ColoredMesh dot;
  append_dot(drawn_points(state.picked->muscle, frame, state).col(state.picked->vertex),
             static_cast<float>(picked_pixels / projection_of(renderer_).pixels_per_metre), Color(0.05, 0.35, 0.75),
             dot);
  set_shape(dot, picked_);
}

void WindowScene::show(int number, const WindowState& state, const ColoredMesh& slice, bool fast) {
  const std::shared_ptr<const ShownFrame> frame = history_.at(number);
  show_bones(*frame, state);
  for (std::size_t m = 0; m < muscles_.size(); ++m) {
    show_muscle(m, *frame, state, fast);
    show_fibers(m, *frame, state);
    show_attachments(m, *frame, state);
    show_ghosts(m, number, state);
  }
  show_arrows(*frame, state);
  show_picked(*frame, state);
  slice_.actor->SetVisibility(state.slice != Slice::none && !slice.faces.empty());
  if (slice_.actor->GetVisibility() != 0) set_shape(slice, slice_);
  bool translucent = state.ghost != Ghost::none || state.slice != Slice::none;
  for (std::size_t m = 0; m < muscles_.size(); ++m)
    translucent = translucent || (is_seen_through(m, state) && state.muscles[m] != MuscleState::hidden);
  renderer_.SetUseDepthPeeling(translucent);
  renderer_.SetMaximumNumberOfPeels(fast ? 1 : 4);
}

/// The box, along three axes, of all muscles and bones that are shown.
static Eigen::AlignedBox3d box_along(const Eigen::Matrix3d& axes, const ShownShapes& shapes, const ShownFrame& frame,
                                     const WindowState& state) {
  Eigen::AlignedBox3d box;
  for (std::size_t m = 0; m < frame.muscles.size(); ++m)
    if (state.muscles[m] != MuscleState::hidden)
      for (const auto& point : frame.muscles[m].colwise()) box.extend(axes.transpose() * point.cast<Real>());
  for (std::size_t b = 0; state.bones && b < frame.bones.size(); ++b)
    for (const auto& point : shapes.bone_points[b].colwise())
      box.extend(axes.transpose() * (frame.bones[b] * point.cast<Real>()));
  return box;
}

bool is_within(const ShownShapes& shapes, const ShownFrame& frame, const WindowState& state, const Rectangle& part,
               vtkRenderer& renderer) {
  const WindowProjection projection = projection_of(renderer);
  const Eigen::AlignedBox3d box = box_along(projection.axes, shapes, frame, state);
  if (box.isEmpty()) return true;
  const Vec3 low = projection.in_window(projection.axes * box.min());
  const Vec3 high = projection.in_window(projection.axes * box.max());
  return low.x() >= part.x && low.y() >= part.y && high.x() <= part.x + part.width && high.y() <= part.y + part.height;
}

static void look_from(const Vec3& direction, const Vec3& superior, const ShownShapes& shapes,
                      const ShapeHistory& history, const WindowState& state, const Rectangle& part,
                      vtkRenderer& renderer) {
  const Vec3 right = superior.cross(direction).normalized(), up = direction.cross(right);
  Eigen::Matrix3d axes;
  axes << right, up, direction;
  Eigen::AlignedBox3d box;
  const int step = std::max(1, (history.end() - history.begin()) / 12);
  for (int frame = history.begin(); frame < history.end(); frame += step)
    box.extend(box_along(axes, shapes, *history.at(frame), state));
  box.extend(box_along(axes, shapes, *history.at(history.end() - 1), state));
  if (box.isEmpty()) return;
  const int* window = renderer.GetSize();
  const Real metres_per_pixel = 1.08 * std::max(box.sizes().x() / part.width, box.sizes().y() / part.height);
  Vec3 center = box.center();
  center.x() += metres_per_pixel * (window[0] / 2.0 - (part.x + part.width / 2.0));
  center.y() += metres_per_pixel * (window[1] / 2.0 - (part.y + part.height / 2.0));
  const Vec3 middle = axes * center, eye = middle + direction * (10 * box.sizes().norm());
  vtkCamera* camera = renderer.GetActiveCamera();
  camera->ParallelProjectionOn();
  camera->SetFocalPoint(middle.x(), middle.y(), middle.z());
  camera->SetPosition(eye.x(), eye.y(), eye.z());
  camera->SetViewUp(up.x(), up.y(), up.z());
  camera->SetParallelScale(metres_per_pixel * window[1] / 2);
  renderer.ResetCameraClippingRange();
}

void look_from(const std::string& view, const ShownShapes& shapes, const ShapeHistory& history,
               const WindowState& state, const Rectangle& part, vtkRenderer& renderer) {
  RecordedRun sides;
  sides.axes = shapes.axes;
  sides.muscles = {shapes.left_side ? "_l" : "_r"};
  look_from(view_direction(sides, view), shapes.axes.superior, shapes, history, state, part, renderer);
}

void fit_all(const ShownShapes& shapes, const ShapeHistory& history, const WindowState& state, const Rectangle& part,
             vtkRenderer& renderer) {
  vtkCamera* camera = renderer.GetActiveCamera();
  look_from(-Vec3(camera->GetDirectionOfProjection()), Vec3(camera->GetViewUp()), shapes, history, state, part,
            renderer);
}

}  // namespace gracilis
