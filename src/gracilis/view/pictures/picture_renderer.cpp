#include <gracilis/view/pictures/picture_renderer.hpp>

#include <gracilis/io/mesh/vtk_mesh.hpp>
#include <gracilis/view/pictures/smooth_lines.hpp>
#include <gracilis/view/pictures/stripes.hpp>

#include <vtkActor.h>
#include <vtkActor2D.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkFloatArray.h>
#include <vtkLight.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty.h>
#include <vtkProperty2D.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkTexture.h>
#include <vtkTubeFilter.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace gracilis {

/// Area-weighted averages of the normals around each vertex: smooth shading.
static vtkSmartPointer<vtkFloatArray> vertex_normals(const TriangleMesh& mesh) {
  Points normals = Points::Zero(3, mesh.vertices.cols());
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const Eigen::Vector3i face = mesh.faces.col(f);
    const Vec3 a = mesh.vertices.col(face[0]);
    const Vec3 normal = (mesh.vertices.col(face[1]) - a).cross(mesh.vertices.col(face[2]) - a);
    for (const int vertex : face) normals.col(vertex) += normal;
  }
  const auto array = vtkSmartPointer<vtkFloatArray>::New();
  array->SetName("Normals");
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(normals.cols());
  Eigen::Map<Eigen::Matrix3Xf>(array->GetPointer(0), 3, normals.cols()) = normals.colwise().normalized().cast<float>();
  return array;
}

/// One color per point or cell, as bytes, which VTK takes for colors.
static vtkSmartPointer<vtkUnsignedCharArray> color_array(const Points& colors) {
  const auto array = vtkSmartPointer<vtkUnsignedCharArray>::New();
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(colors.cols());
  for (Index i = 0; i < colors.cols(); ++i)
    for (int k = 0; k < 3; ++k) array->SetComponent(i, k, std::lround(255 * std::clamp<Real>(colors(k, i), 0, 1)));
  return array;
}

static void add_surface(const PaintedSurface& surface, vtkRenderer& renderer) {
  const vtkSmartPointer<vtkPolyData> mesh = to_vtk(surface.mesh.vertices, surface.mesh.faces);
  mesh->GetPointData()->SetNormals(vertex_normals(surface.mesh));
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(mesh);
  if (surface.colors.cols() == surface.mesh.vertices.cols() && surface.colors.cols() > 0) {
    mesh->GetPointData()->SetScalars(color_array(surface.colors));
  } else {
    mapper->ScalarVisibilityOff();
  }
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  if (!surface.stripes.empty()) {
    mesh->GetPointData()->SetTCoords(stripe_places(surface.stripes));
    actor->SetTexture(stripe_texture());
  }
  vtkProperty* property = actor->GetProperty();
  property->SetColor(surface.color.x(), surface.color.y(), surface.color.z());
  property->SetOpacity(surface.opacity);
  property->SetAmbient(0.2);
  property->SetDiffuse(0.85);
  property->SetSpecular(0.18);
  property->SetSpecularPower(18);
  property->SetBackfaceCulling(surface.solid && surface.opacity == 1);
  renderer.AddActor(actor);
}

static void add_lines(const PaintedLines& lines, int scale, vtkRenderer& renderer) {
  if (lines.lines.count() == 0) return;
  const vtkSmartPointer<vtkPolyData> data = to_vtk(lines.radius > 0 ? smooth_lines(lines.lines) : lines.lines);
  vtkNew<vtkPolyDataMapper> mapper;
  if (static_cast<Index>(lines.colors.size()) == lines.lines.count()) {
    Points colors(3, lines.lines.count());
    for (Index i = 0; i < colors.cols(); ++i) colors.col(i) = lines.colors[static_cast<std::size_t>(i)];
    data->GetCellData()->SetScalars(color_array(colors));
  } else {
    mapper->ScalarVisibilityOff();
  }
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(lines.color.x(), lines.color.y(), lines.color.z());
  if (lines.radius > 0) {
    vtkNew<vtkTubeFilter> tubes;
    tubes->SetInputData(data);
    tubes->SetRadius(lines.radius);
    tubes->SetNumberOfSides(8);
    mapper->SetInputConnection(tubes->GetOutputPort());
  } else {
    mapper->SetInputData(data);
    actor->GetProperty()->SetLineWidth(static_cast<float>(lines.width * scale));
    actor->GetProperty()->LightingOff();
  }
  renderer.AddActor(actor);
}

void add_camera_lights(vtkRenderer& renderer) {
  struct CameraLight {
    double x, y, z, intensity;
  };
  for (const CameraLight& setup : {CameraLight{-0.7, 0.8, 1.0, 0.85}, {1.0, -0.1, 0.8, 0.38}, {0.3, 1.0, -0.6, 0.3}}) {
    vtkNew<vtkLight> light;
    light->SetLightTypeToCameraLight();
    light->SetPosition(setup.x, setup.y, setup.z);
    light->SetFocalPoint(0, 0, 0);
    light->SetIntensity(setup.intensity);
    renderer.AddLight(light);
  }
}

static void place_camera(const CameraView& view, Real half_height, vtkRenderer& renderer) {
  vtkCamera* camera = renderer.GetActiveCamera();
  const Vec3 position = view.center - view.looking * (10 * half_height);
  camera->ParallelProjectionOn();
  camera->SetPosition(position.x(), position.y(), position.z());
  camera->SetFocalPoint(view.center.x(), view.center.y(), view.center.z());
  camera->SetViewUp(view.up.x(), view.up.y(), view.up.z());
  camera->SetParallelScale(half_height);
  renderer.ResetCameraClippingRange();
}

/// `part` lies in `area`, which the window shows.
static vtkSmartPointer<vtkRenderer> renderer_in(const Rectangle& part, const Rectangle& area, const Color& background,
                                                vtkRenderWindow& window) {
  const auto renderer = vtkSmartPointer<vtkRenderer>::New();
  const int x = part.x - area.x, y = part.y - area.y;
  renderer->SetViewport(Real(x) / area.width, Real(y) / area.height, Real(x + part.width) / area.width,
                        Real(y + part.height) / area.height);
  renderer->SetBackground(background.x(), background.y(), background.z());
  renderer->AutomaticLightCreationOff();
  window.AddRenderer(renderer);
  return renderer;
}

static vtkSmartPointer<vtkTextActor> text_actor(const std::string& text, int pixels, bool bold) {
  const auto actor = vtkSmartPointer<vtkTextActor>::New();
  actor->SetInput(text.c_str());
  vtkTextProperty* property = actor->GetTextProperty();
  property->SetFontFamilyToArial();
  property->SetFontSize(pixels);
  property->SetBold(bold);
  property->SetColor(0.13, 0.13, 0.13);
  property->SetVerticalJustificationToCentered();
  return actor;
}

/// In the middle of a part, or as near to it as what takes up the part's first `taken` pixels allows; smaller where it
/// would not find room.
static void add_centered_text(const std::string& text, int pixels, bool bold, const Rectangle& part, int scale,
                              vtkRenderer& renderer, int taken = 0) {
  constexpr int margin = 8;  // pixels
  const vtkSmartPointer<vtkTextActor> actor = text_actor(text, pixels * scale, bold);
  actor->GetTextProperty()->SetJustificationToCentered();
  double size[2] = {0, 0};
  actor->GetSize(&renderer, size);
  const int begin = taken > 0 ? taken + 2 * margin : margin;
  const Real room = (part.width - margin - begin) * scale;
  if (size[0] > room && room > 0) {
    actor->GetTextProperty()->SetFontSize(static_cast<int>(pixels * scale * room / size[0]));
    actor->GetSize(&renderer, size);
  }
  actor->SetPosition(std::max(part.width * scale / 2.0, begin * scale + size[0] / 2), part.height * scale / 2.0);
  renderer.AddActor2D(actor);
}

/// In pixels of the window.
static void add_rectangle(const Color& color, const Rectangle& part, vtkRenderer& renderer) {
  Points corners(3, 4);
  corners << part.x, part.x + part.width, part.x + part.width, part.x, part.y, part.y, part.y + part.height,
      part.y + part.height, 0, 0, 0, 0;
  Eigen::Matrix3Xi faces(3, 2);
  faces << 0, 0, 1, 2, 2, 3;
  vtkNew<vtkPolyDataMapper2D> mapper;
  mapper->SetInputData(to_vtk(corners, faces));
  vtkNew<vtkActor2D> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(color.x(), color.y(), color.z());
  renderer.AddActor2D(actor);
}

/// Swatch and name of every entry, in cells of equal width.
static void add_legend(const PictureLayout& layout, int scale, vtkRenderer& renderer) {
  const auto& [columns, font, row_height] = layout.legend_grid;
  const int count = static_cast<int>(layout.legend_entries.size()), rows = (count + columns - 1) / columns;
  const int cell = layout.legend.width / columns;
  for (int i = 0; i < count; ++i) {
    const auto& [name, color] = layout.legend_entries[static_cast<std::size_t>(i)];
    const int x = i % columns * cell + text_pixels(layout, 12);
    const int middle = (layout.legend.height + (rows - 1 - 2 * (i / columns)) * row_height) / 2;
    add_rectangle(color, {x * scale, (middle - font / 2) * scale, font * scale, font * scale}, renderer);
    const vtkSmartPointer<vtkTextActor> text = text_actor(name, font * scale, false);
    text->SetPosition((x + font + text_pixels(layout, 8)) * scale, middle * scale);
    renderer.AddActor2D(text);
  }
}

/// A strip of colors with its title to the left and its values below.
static void add_color_bar(const ColorBar& bar, const PictureLayout& layout, int scale, vtkRenderer& renderer) {
  const auto px = [&](int pixels) { return text_pixels(layout, pixels); };
  const Rectangle& part = layout.color_bar;
  const int left = part.width / 2, width = part.width / 2 - px(40), height = px(14), bottom = part.height / 2;
  static constexpr int pieces = 64;
  const auto last = static_cast<Real>(bar.colors.size() - 1);
  for (int i = 0; i < pieces; ++i) {
    const Real at = last * i / (pieces - 1);
    const auto below = static_cast<std::size_t>(std::min(std::floor(at), std::max(last - 1, 0.0)));
    const Color& next = bar.colors[std::min(below + 1, bar.colors.size() - 1)];
    const Color color = bar.colors[below] + (at - static_cast<Real>(below)) * (next - bar.colors[below]);
    const int begin = scale * left + scale * width * i / pieces, end = scale * left + scale * width * (i + 1) / pieces;
    add_rectangle(color, {begin, scale * bottom, end - begin, scale * height}, renderer);
  }
  const vtkSmartPointer<vtkTextActor> title = text_actor(bar.title, px(18) * scale, false);
  title->GetTextProperty()->SetJustificationToRight();
  title->SetPosition((left - px(14)) * scale, (bottom + height / 2) * scale);
  renderer.AddActor2D(title);
  for (std::size_t i = 0; i < bar.ticks.size(); ++i) {
    const vtkSmartPointer<vtkTextActor> tick = text_actor(bar.ticks[i], px(15) * scale, false);
    tick->GetTextProperty()->SetJustificationToCentered();
    const Real share = bar.ticks.size() > 1 ? static_cast<Real>(i) / static_cast<Real>(bar.ticks.size() - 1) : 0.5;
    tick->SetPosition((left + share * width) * scale, (bottom - px(11)) * scale);
    renderer.AddActor2D(tick);
  }
}

/// A line of a round length, at most a fifth of the panel, in the lower left corner. Returns where it ends, pixels.
static int add_scale_bar(const PictureLayout& layout, int scale, vtkRenderer& renderer) {
  const auto px = [&](int pixels) { return text_pixels(layout, pixels); };
  const Rectangle& part = layout.panels[0];
  const Real pixels_per_metre = part.height / (2 * layout.half_height);
  Real length = 0.001;
  for (const Real each : {0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0})
    if (each * pixels_per_metre <= part.width / 5.0) length = each;
  const int width = static_cast<int>(std::lround(length * pixels_per_metre));
  add_rectangle(Color::Constant(0.13), {px(20) * scale, px(14) * scale, width * scale, px(3) * scale}, renderer);
  char text[20];
  std::snprintf(text, sizeof text, length < 0.01 ? "%.0f mm" : "%.0f cm", length < 0.01 ? 1000 * length : 100 * length);
  const vtkSmartPointer<vtkTextActor> label = text_actor(text, px(17) * scale, false);
  label->GetTextProperty()->SetJustificationToCentered();
  double size[2] = {0, 0};
  label->GetSize(&renderer, size);
  const Real wider = std::max(static_cast<Real>(width * scale), size[0]);  // in a small picture the words are
  label->SetPosition(px(20) * scale + wider / 2, px(28) * scale);
  renderer.AddActor2D(label);
  return px(20) + static_cast<int>(std::ceil(wider / scale));
}

bool is_seen_through(const Panel& panel) {
  return std::any_of(panel.surfaces.begin(), panel.surfaces.end(), [](const auto& s) { return s.opacity < 1; });
}

/// Whether there is something in `part`, and in this area.
static bool is_in(const Rectangle& part, const Rectangle& area) {
  return part.height > 0 && part.x >= area.x && part.y >= area.y && part.x + part.width <= area.x + area.width &&
         part.y + part.height <= area.y + area.height;
}

std::vector<Rectangle> areas_to_draw(const PictureLayout& layout) {
  if (layout.panels.size() == 1) return {{0, 0, layout.width, layout.height}};
  std::vector<Rectangle> areas;
  for (std::size_t i = 0; i < layout.panels.size(); ++i) {
    const Rectangle &panel = layout.panels[i], &caption = layout.captions[i];
    areas.push_back({panel.x, caption.y, panel.width, caption.height + panel.height});
  }
  if (layout.title.height > 0) areas.push_back(layout.title);
  const int below = std::max(layout.legend.y + layout.legend.height, layout.color_bar.y + layout.color_bar.height);
  if (below > 0) areas.push_back({0, 0, layout.width, below});
  return areas;
}

std::map<std::size_t, vtkRenderer*> add_renderers(const Picture& picture, const PictureLayout& layout,
                                                  const Rectangle& area, int scale, vtkRenderWindow& window) {
  const auto add_renderer = [&](const Rectangle& part) { return renderer_in(part, area, picture.background, window); };
  add_renderer(area);  // the background of what stays empty
  std::map<std::size_t, vtkRenderer*> of_panels;
  for (std::size_t i = 0; i < picture.panels.size(); ++i) {
    if (!is_in(layout.panels[i], area)) continue;
    const Panel& panel = picture.panels[i];
    const vtkSmartPointer<vtkRenderer> renderer = add_renderer(layout.panels[i]);
    of_panels[i] = renderer;
    if (is_seen_through(panel)) {
      renderer->SetUseDepthPeeling(true);
      renderer->SetMaximumNumberOfPeels(8);
    }
    for (const PaintedSurface& surface : panel.surfaces) add_surface(surface, *renderer);
    for (const PaintedLines& lines : panel.lines) add_lines(lines, scale, *renderer);
    add_camera_lights(*renderer);
    place_camera(layout.cameras[i], layout.half_height, *renderer);
    if (i == 0 && picture.scale_bar && layout.captions[i].height == 0) add_scale_bar(layout, scale, *renderer);
    if (layout.captions[i].height == 0) continue;
    const auto caption = add_renderer(layout.captions[i]);
    const int taken = i == 0 && picture.scale_bar ? add_scale_bar(layout, scale, *caption) : 0;
    add_centered_text(panel.caption, text_pixels(layout, 24), false, layout.captions[i], scale, *caption, taken);
  }
  if (is_in(layout.title, area))
    add_centered_text(picture.title, text_pixels(layout, 30), true, layout.title, scale, *add_renderer(layout.title));
  if (is_in(layout.color_bar, area)) add_color_bar(*picture.color_bar, layout, scale, *add_renderer(layout.color_bar));
  if (is_in(layout.legend, area)) add_legend(layout, scale, *add_renderer(layout.legend));
  return of_panels;
}

}  // namespace gracilis
