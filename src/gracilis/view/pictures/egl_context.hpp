#pragma once

namespace gracilis {

/// An OpenGL context without window, screen or X server (EGL "surfaceless"), current on the calling thread while this
/// lives. Debian's VTK opens X windows only; with this context vtkGenericOpenGLRenderWindow draws on any machine, with
/// Mesa's software renderer where there is no graphics card.
class EglContext {
 public:
  /// Throws Error (exit code 4) naming the step that failed when this machine cannot offer OpenGL.
  EglContext();
  ~EglContext();
  EglContext(const EglContext&) = delete;
  EglContext& operator=(const EglContext&) = delete;

 private:
  void* display_ = nullptr;
  void* context_ = nullptr;
};

}  // namespace gracilis
