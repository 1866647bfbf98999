#include <gracilis/view/window/overlay.hpp>

#include <vtkActor2D.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkRenderer.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>

namespace gracilis {

static vtkSmartPointer<vtkPolyData> make_shapes() {
  auto shapes = vtkSmartPointer<vtkPolyData>::New();
  shapes->SetPoints(vtkNew<vtkPoints>());
  shapes->SetPolys(vtkNew<vtkCellArray>());
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetNumberOfComponents(4);
  shapes->GetCellData()->SetScalars(colors);
  return shapes;
}

static void add_polygon(const Points& corners, const Rectangle& part, const Color& color, Real opacity,
                        vtkPolyData& shapes) {
  vtkNew<vtkIdList> polygon;
  for (const Vec3 corner : corners.colwise())
    polygon->InsertNextId(shapes.GetPoints()->InsertNextPoint(part.x + corner.x(), part.y + corner.y(), 0));
  shapes.GetPolys()->InsertNextCell(polygon);
  const Color bytes = 255 * color;
  vtkUnsignedCharArray::SafeDownCast(shapes.GetCellData()->GetScalars())
      ->InsertNextTuple4(bytes.x(), bytes.y(), bytes.z(), 255 * opacity);
}

static vtkSmartPointer<vtkActor2D> actor_of(vtkPolyData* shapes) {
  vtkNew<vtkPolyDataMapper2D> mapper;
  mapper->SetInputData(shapes);
  auto actor = vtkSmartPointer<vtkActor2D>::New();
  actor->SetMapper(mapper);
  return actor;
}

static Points corners_of(const Rectangle& part) {
  Points corners(3, 4);
  corners << 0, part.width, part.width, 0, 0, 0, part.height, part.height, 0, 0, 0, 0;
  return corners;
}

Overlay::Overlay(vtkRenderer& renderer) : renderer_(renderer) { clear(); }

void Overlay::clear() {
  renderer_.RemoveAllViewProps();
  areas_.clear();
  begin_layer();
}

void Overlay::begin_layer() {
  shapes_ = make_shapes();
  renderer_.AddActor2D(actor_of(shapes_));
}

void Overlay::add_rectangle(const Rectangle& part, const Color& color, Real opacity) {
  add_polygon(corners_of(part), part, color, opacity, *shapes_);
}

void Overlay::add_triangle(const Rectangle& part, const Color& color) {
  Points corners(3, 3);
  corners << 0, part.width, 0, 0, part.height / 2.0, part.height, 0, 0, 0;
  add_polygon(corners, part, color, 1, *shapes_);
}

vtkSmartPointer<vtkActor2D> Overlay::add_mark(const Rectangle& part, const Color& color) {
  const vtkSmartPointer<vtkPolyData> shape = make_shapes();
  add_polygon(corners_of(part), {}, color, 1, *shape);
  vtkSmartPointer<vtkActor2D> actor = actor_of(shape);
  actor->SetPosition(part.x, part.y);
  renderer_.AddActor2D(actor);
  return actor;
}

static vtkSmartPointer<vtkTextActor> make_text(const std::string& text, int size) {
  auto actor = vtkSmartPointer<vtkTextActor>::New();
  actor->SetInput(text.c_str());
  actor->GetTextProperty()->SetFontFamilyToArial();
  actor->GetTextProperty()->SetFontSize(size);
  return actor;
}

int Overlay::width_of(const std::string& text, int size) const {
  double extent[2] = {0, 0};
  make_text(text, size)->GetSize(&renderer_, extent);
  return static_cast<int>(extent[0]);
}

vtkSmartPointer<vtkTextActor> Overlay::add_text(int x, int y, const std::string& text, int size, const Color& color) {
  vtkSmartPointer<vtkTextActor> actor = make_text(text, size);
  actor->SetPosition(x, y);
  actor->GetTextProperty()->SetColor(color.x(), color.y(), color.z());
  renderer_.AddActor2D(actor);
  return actor;
}

vtkSmartPointer<vtkTextActor> Overlay::add_text_right(int x, int y, const std::string& text, int size,
                                                      const Color& color) {
  vtkSmartPointer<vtkTextActor> actor = add_text(x, y, text, size, color);
  actor->GetTextProperty()->SetJustificationToRight();
  return actor;
}

vtkSmartPointer<vtkTextActor> Overlay::add_text_centered(int x, int y, const std::string& text, int size,
                                                         const Color& color) {
  vtkSmartPointer<vtkTextActor> actor = add_text(x, y, text, size, color);
  actor->GetTextProperty()->SetJustificationToCentered();
  return actor;
}

void Overlay::add_area(const Rectangle& area, bool drags, std::function<void(Real)> act) {
  add_area(area, drags, std::move(act), area);
}

void Overlay::add_area(const Rectangle& area, bool drags, std::function<void(Real)> act, const Rectangle& scale) {
  areas_.push_back({area, scale, drags, std::move(act)});
}

static Real share(const Rectangle& part, int x) {
  return std::clamp((x - part.x) / static_cast<Real>(std::max(part.width, 1)), 0.0, 1.0);
}

bool Overlay::press(int x, int y) {
  for (auto area = areas_.rbegin(); area != areas_.rend(); ++area) {
    const Rectangle& part = area->part;
    if (x < part.x || y < part.y || x >= part.x + part.width || y >= part.y + part.height) continue;
    const Area found = *area;  // acting may lay everything out anew
    if (found.drags) dragged_ = {found};
    found.act(share(found.scale, x));
    return true;
  }
  return false;
}

bool Overlay::drag(int x) {
  if (dragged_.empty()) return false;
  const Area found = dragged_[0];
  found.act(share(found.scale, x));
  return true;
}

}  // namespace gracilis
