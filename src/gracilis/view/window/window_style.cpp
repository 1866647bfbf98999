#include <gracilis/view/window/window_style.hpp>

#include <vtkInteractorStyleTrackballCamera.h>
#include <vtkObjectFactory.h>
#include <vtkRenderWindowInteractor.h>

namespace gracilis {

namespace {

class WindowStyle : public vtkInteractorStyleTrackballCamera {
 public:
  static WindowStyle* New();
  vtkTypeMacro(WindowStyle, vtkInteractorStyleTrackballCamera)

      WindowEvents events;

  void OnLeftButtonDown() override {
    if (!events.press(Interactor->GetEventPosition()[0], Interactor->GetEventPosition()[1]))
      Superclass::OnLeftButtonDown();
  }
  void OnMouseMove() override {
    if (events.drag(Interactor->GetEventPosition()[0], Interactor->GetEventPosition()[1])) return;
    Superclass::OnMouseMove();
    if (State != VTKIS_NONE) events.turned();
  }
  void OnLeftButtonUp() override {
    events.release(Interactor->GetEventPosition()[0], Interactor->GetEventPosition()[1]);
    Superclass::OnLeftButtonUp();
  }
  void OnMouseWheelForward() override {
    Superclass::OnMouseWheelForward();
    events.turned();
  }
  void OnMouseWheelBackward() override {
    Superclass::OnMouseWheelBackward();
    events.turned();
  }
  void OnKeyPress() override { events.key(Interactor->GetKeySym() ? Interactor->GetKeySym() : ""); }
  void OnChar() override {}
  // VTK's would repeat the mouse's last motion at each tick of the window.
  void OnTimer() override {}
};

vtkStandardNewMacro(WindowStyle)

}  // namespace

vtkSmartPointer<vtkInteractorStyle> make_window_style(WindowEvents events) {
  const auto style = vtkSmartPointer<WindowStyle>::New();
  style->events = std::move(events);
  return style;
}

}  // namespace gracilis
