#pragma once

#include <vtkSmartPointer.h>

class vtkGenericOpenGLRenderWindow;

namespace gracilis {

/// A VTK window of that many pixels that draws into memory with the EGL context current on this thread. The context
/// must outlive it.
vtkSmartPointer<vtkGenericOpenGLRenderWindow> make_offscreen_window(int width, int height);

}  // namespace gracilis
