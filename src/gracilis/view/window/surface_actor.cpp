#include <gracilis/view/window/surface_actor.hpp>

#include <gracilis/io/mesh/vtk_mesh.hpp>
#include <gracilis/view/pictures/smooth_lines.hpp>
#include <gracilis/view/pictures/stripes.hpp>

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkTexture.h>
#include <vtkTubeFilter.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>

namespace gracilis {

static vtkSmartPointer<vtkFloatArray> float_array(const ShownPoints& values) {
  auto array = vtkSmartPointer<vtkFloatArray>::New();
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(values.cols());
  Eigen::Map<ShownPoints>(array->GetPointer(0), 3, values.cols()) = values;
  return array;
}

/// Area-weighted averages of the normals around each vertex.
static ShownPoints vertex_normals(const ShownPoints& points, const Eigen::Matrix3Xi& faces) {
  ShownPoints normals = ShownPoints::Zero(3, points.cols());
  for (const Eigen::Vector3i face : faces.colwise()) {
    const Eigen::Vector3f a = points.col(face[0]), ab = points.col(face[1]) - a, ac = points.col(face[2]) - a;
    const Eigen::Vector3f normal = ab.cross(ac);
    for (const int v : face) normals.col(v) += normal;
  }
  return normals.colwise().normalized();
}

/// One color per entry, as bytes, which VTK takes for colors.
static vtkSmartPointer<vtkUnsignedCharArray> color_array(const std::vector<Color>& colors) {
  auto array = vtkSmartPointer<vtkUnsignedCharArray>::New();
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(static_cast<vtkIdType>(colors.size()));
  unsigned char* bytes = array->GetPointer(0);
  for (const Color& color : colors)
    for (int k = 0; k < 3; ++k)
      *bytes++ = static_cast<unsigned char>(std::lround(255 * std::clamp<Real>(color[k], 0, 1)));
  return array;
}

static void set_points(const ShownPoints& points, vtkPolyData& data) {
  vtkNew<vtkPoints> stored;
  stored->SetData(float_array(points));
  data.SetPoints(stored);
}

SurfaceActor add_empty(bool lit, vtkRenderer& renderer) {
  SurfaceActor surface{vtkSmartPointer<vtkPolyData>::New(), vtkSmartPointer<vtkActor>::New()};
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(surface.data);
  mapper->ScalarVisibilityOff();
  surface.actor->SetMapper(mapper);
  vtkProperty* property = surface.actor->GetProperty();
  property->SetLighting(lit);
  property->SetAmbient(0.2);
  property->SetDiffuse(0.85);
  property->SetSpecular(0.18);
  property->SetSpecularPower(18);
  property->SetEdgeColor(0.15, 0.15, 0.15);
  renderer.AddActor(surface.actor);
  return surface;
}

SurfaceActor add_surface(const ShownPoints& points, const Eigen::Matrix3Xi& faces, const Color& color,
                         vtkRenderer& renderer) {
  SurfaceActor surface = add_empty(true, renderer);
  surface.data->ShallowCopy(to_vtk(points.cast<Real>(), faces));
  move_points(points, faces, surface);
  surface.actor->GetProperty()->SetColor(color.x(), color.y(), color.z());
  return surface;
}

void move_points(const ShownPoints& points, const Eigen::Matrix3Xi& faces, SurfaceActor& surface) {
  set_points(points, *surface.data);
  surface.data->GetPointData()->SetNormals(float_array(vertex_normals(points, faces)));
}

void set_shape(const ColoredMesh& mesh, SurfaceActor& surface) {
  const auto points = static_cast<Index>(mesh.points.size()), faces = static_cast<Index>(mesh.faces.size());
  const Eigen::Map<const ShownPoints> all_points(points > 0 ? mesh.points[0].data() : nullptr, 3, points);
  const Eigen::Map<const Eigen::Matrix3Xi> all_faces(faces > 0 ? mesh.faces[0].data() : nullptr, 3, faces);
  surface.data->ShallowCopy(to_vtk(all_points.cast<Real>(), all_faces));
  set_point_colors(mesh.colors, surface);
}

void set_point_colors(const std::vector<Color>& colors, SurfaceActor& surface) {
  surface.data->GetPointData()->SetScalars(colors.empty() ? nullptr : color_array(colors).Get());
  surface.actor->GetMapper()->SetScalarVisibility(!colors.empty());
}

void set_stripes(const std::vector<Real>& stripes, vtkTexture& texture, SurfaceActor& surface) {
  surface.actor->SetTexture(stripes.empty() ? nullptr : &texture);
  surface.data->GetPointData()->SetTCoords(stripes.empty() ? nullptr : stripe_places(stripes).Get());
}

void set_tubes(const Polylines& lines, Real radius, const std::vector<Color>& colors, SurfaceActor& surface) {
  const vtkSmartPointer<vtkPolyData> input = to_vtk(smooth_lines(lines));
  if (!colors.empty()) input->GetCellData()->SetScalars(color_array(colors));
  vtkNew<vtkTubeFilter> tubes;
  tubes->SetInputData(input);
  tubes->SetRadius(radius);
  tubes->SetNumberOfSides(5);
  tubes->Update();
  surface.data->ShallowCopy(tubes->GetOutput());
  surface.actor->GetMapper()->SetScalarVisibility(!colors.empty());
}

}  // namespace gracilis
