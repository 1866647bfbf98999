#include <gracilis/view/pictures/picture_renderer.hpp>

#include <gracilis/io/mesh/vtk_mesh.hpp>
#include <gracilis/view/pictures/drawn_together.hpp>
#include <gracilis/view/pictures/picture_words.hpp>
#include <gracilis/view/pictures/smooth_lines.hpp>
#include <gracilis/view/pictures/stripes.hpp>

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkFloatArray.h>
#include <vtkLight.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkTexture.h>
#include <vtkTubeFilter.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>

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
  auto array = vtkSmartPointer<vtkFloatArray>::New();
  array->SetName("Normals");
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(normals.cols());
  Eigen::Map<Eigen::Matrix3Xf>(array->GetPointer(0), 3, normals.cols()) = normals.colwise().normalized().cast<float>();
  return array;
}

/// One color per point or cell, as bytes, which VTK takes for colors.
static vtkSmartPointer<vtkUnsignedCharArray> color_array(const Points& colors) {
  auto array = vtkSmartPointer<vtkUnsignedCharArray>::New();
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(colors.cols());
  Eigen::Map<Eigen::Matrix<unsigned char, 3, Eigen::Dynamic>>(array->GetPointer(0), 3, colors.cols()) =
      (255 * colors.array().max(0).min(1) + 0.5).cast<unsigned char>();
  return array;
}

static void add_surface(const PaintedSurface& surface, vtkTexture& stripes, vtkRenderer& renderer) {
  const vtkSmartPointer<vtkPolyData> mesh = to_vtk(surface.mesh.vertices, surface.mesh.faces);
  mesh->GetPointData()->SetNormals(vertex_normals(surface.mesh));
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(mesh);
  mesh->GetPointData()->SetScalars(color_array(surface.colors));
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  if (!surface.stripes.empty()) {
    mesh->GetPointData()->SetTCoords(stripe_places(surface.stripes));
    actor->SetTexture(&stripes);
  }
  vtkProperty* property = actor->GetProperty();
  property->SetSpecularColor(0.5, 0.5, 0.5);
  property->SetOpacity(surface.opacity);
  property->SetAmbient(0.2);
  property->SetDiffuse(0.85);
  property->SetSpecular(0.18);
  property->SetSpecularPower(18);
  property->SetBackfaceCulling(surface.solid && surface.opacity == 1);
  renderer.AddActor(actor);
}

/// A column per point: `color` at the one nearest to the camera, paler the further back a point lies.
static Points faded(const Points& points, const Color& color, const Vec3& looking) {
  constexpr Real palest = 0.6;
  const Eigen::RowVectorXd depths = looking.transpose() * points;
  const Real nearest = depths.minCoeff(), range = std::max(depths.maxCoeff() - nearest, Real{1e-9});
  const Eigen::RowVectorXd shares = palest / range * (depths.array() - nearest);
  return (Color::Ones() - color) * shares + color.replicate(1, points.cols());
}

static vtkSmartPointer<vtkTubeFilter> tubes_around(vtkPolyData& lines, Real radius) {
  auto tubes = vtkSmartPointer<vtkTubeFilter>::New();
  tubes->SetInputData(&lines);
  tubes->SetRadius(radius);
  tubes->SetNumberOfSides(8);
  return tubes;
}

/// Wider tubes of which only the far side is drawn, so that each has a dark rim before what lies behind it.
static void add_rims(const Polylines& drawn, const PaintedLines& lines, const Vec3& looking, vtkRenderer& renderer) {
  constexpr Real rim = 1.5, darkness = 0.35;  // of the radius, of the color
  const vtkSmartPointer<vtkPolyData> data = to_vtk(drawn);
  data->GetPointData()->SetScalars(color_array(faded(drawn.points, darkness * lines.color, looking)));
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(tubes_around(*data, rim * lines.radius)->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->FrontfaceCullingOn();
  actor->GetProperty()->LightingOff();
  renderer.AddActor(actor);
}

static void add_lines(const PaintedLines& lines, const Vec3& looking, int scale, vtkRenderer& renderer) {
  if (lines.lines.count() == 0) return;
  const Polylines drawn = lines.radius > 0 ? smooth_lines(lines.lines) : lines.lines;
  const vtkSmartPointer<vtkPolyData> data = to_vtk(drawn);
  vtkNew<vtkPolyDataMapper> mapper;
  if (static_cast<Index>(lines.colors.size()) == lines.lines.count()) {
    Points colors(3, lines.lines.count());
    for (Index i = 0; i < colors.cols(); ++i) colors.col(i) = lines.colors[static_cast<std::size_t>(i)];
    data->GetCellData()->SetScalars(color_array(colors));
  } else if (lines.fades) {
    data->GetPointData()->SetScalars(color_array(faded(drawn.points, lines.color, looking)));
  } else {
    mapper->ScalarVisibilityOff();
  }
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(lines.color.x(), lines.color.y(), lines.color.z());
  if (lines.radius > 0) {
    mapper->SetInputConnection(tubes_around(*data, lines.radius)->GetOutputPort());
    if (lines.fades && lines.colors.empty()) add_rims(drawn, lines, looking, renderer);
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
  auto renderer = vtkSmartPointer<vtkRenderer>::New();
  const int x = part.x - area.x, y = part.y - area.y;
  renderer->SetViewport(Real(x) / area.width, Real(y) / area.height, Real(x + part.width) / area.width,
                        Real(y + part.height) / area.height);
  renderer->SetBackground(background.x(), background.y(), background.z());
  renderer->AutomaticLightCreationOff();
  window.AddRenderer(renderer);
  return renderer;
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
  int below = 0;
  for (const Rectangle* part : {&layout.legend, &layout.color_bar, &layout.scale_bar})
    below = std::max(below, part->y + part->height);
  if (below > 0) areas.push_back({0, 0, layout.width, below});
  return areas;
}

std::map<std::size_t, vtkRenderer*> add_renderers(const Picture& picture, const PictureLayout& layout,
                                                  const Rectangle& area, int scale, vtkRenderWindow& window) {
  const auto add_renderer = [&](const Rectangle& part) { return renderer_in(part, area, picture.background, window); };
  add_renderer(area);  // the background of what stays empty
  // One for all: to load it takes as long as to draw a muscle.
  const vtkSmartPointer<vtkTexture> stripes = stripe_texture();
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
    for (const PaintedSurface& surface : drawn_together(panel.surfaces)) add_surface(surface, *stripes, *renderer);
    for (const PaintedLines& lines : panel.lines) add_lines(lines, layout.cameras[i].looking, scale, *renderer);
    add_camera_lights(*renderer);
    place_camera(layout.cameras[i], layout.half_height, *renderer);
    if (i == 0 && picture.scale_bar && layout.captions[i].height == 0) draw_scale_bar(layout, scale, *renderer);
    if (layout.captions[i].height > 0) draw_caption(picture, layout, i, scale, *add_renderer(layout.captions[i]));
  }
  if (is_in(layout.title, area)) draw_title(picture, layout, scale, *add_renderer(layout.title));
  if (is_in(layout.scale_bar, area)) draw_scale_bar(layout, scale, *add_renderer(layout.scale_bar));
  if (is_in(layout.color_bar, area)) draw_color_bar(*picture.color_bar, layout, scale, *add_renderer(layout.color_bar));
  if (is_in(layout.legend, area)) draw_legend(layout, scale, *add_renderer(layout.legend));
  return of_panels;
}

}  // namespace gracilis
