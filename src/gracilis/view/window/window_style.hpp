#pragma once

#include <vtkSmartPointer.h>

#include <functional>
#include <string>

class vtkInteractorStyle;

namespace gracilis {

/// What a window is asked before the mouse turns anything. Positions in pixels from the lower left corner.
struct WindowEvents {
  std::function<bool(int x, int y)> press;  ///< of the left button; true: taken
  std::function<bool(int x, int y)> drag;   ///< true: taken
  std::function<void(int x, int y)> release;
  std::function<void(const std::string& key)> key;  ///< X's name of the key, such as "space" or "c"
  std::function<void()> turned;                     ///< the camera may have moved
};

/// Turns, moves and zooms by the mouse as VTK's trackball does, and knows none of VTK's keys.
vtkSmartPointer<vtkInteractorStyle> make_window_style(WindowEvents events);

}  // namespace gracilis
