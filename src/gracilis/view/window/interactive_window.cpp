#include <gracilis/view/window/interactive_window.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/view/window/viewer.hpp>

#include <X11/Xlib.h>

#include <string>

namespace gracilis {

void require_display() {
  // Stays open until the program ends: a server that loses its last client may reset, and drop the window's connection.
  static const Display* const display = XOpenDisplay(nullptr);
  if (!display)
    throw Error(ExitCode::unsupported,
                "there is no display to open a window on; 'gracilis render' and 'gracilis report' need none");
}

WindowReport show_window(const ShownShapes& shapes, ShapeHistory& history, const WindowOptions& options) {
  require_display();
  return Viewer(shapes, history, options).run();
}

}  // namespace gracilis
