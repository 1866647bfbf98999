#include <gracilis/view/pictures/offscreen_window.hpp>

#include <vtkCommand.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>

namespace gracilis {

namespace {

class IgnoreEvent : public vtkCommand {
 public:
  static IgnoreEvent* New() { return new IgnoreEvent; }
  void Execute(vtkObject*, unsigned long, void*) override {}
};

/// VTK 9.1 loads OpenGL through GLEW, which loads every function and then reports an error because there is no GLX
/// display. VTK takes that for a failure. The EGL context guarantees OpenGL 3.2, so here it is none.
class OffscreenWindow : public vtkGenericOpenGLRenderWindow {
 public:
  static OffscreenWindow* New();
  vtkTypeMacro(OffscreenWindow, vtkGenericOpenGLRenderWindow)

      void OpenGLInitContext() override {
    if (Initialized) return;
    vtkNew<IgnoreEvent> ignore;
    const unsigned long tag = AddObserver(vtkCommand::ErrorEvent, ignore);
    Superclass::OpenGLInitContext();
    RemoveObserver(tag);
    Initialized = true;
    GlewInitValid = true;
  }
};

vtkStandardNewMacro(OffscreenWindow)

}  // namespace

vtkSmartPointer<vtkGenericOpenGLRenderWindow> make_offscreen_window(int width, int height) {
  const auto window = vtkSmartPointer<OffscreenWindow>::New();
  window->SetOwnContext(false);
  window->SetIsCurrent(true);
  window->SetSupportsOpenGL(1);
  window->SetReadyForRendering(true);
  window->SetOffScreenRendering(true);
  window->SetMultiSamples(0);
  window->SetSize(width, height);
  window->SetFrameBlitModeToNoBlit();
  return window;
}

}  // namespace gracilis
