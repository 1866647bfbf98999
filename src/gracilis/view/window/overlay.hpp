#pragma once

#include <gracilis/view/pictures/palette.hpp>
#include <gracilis/view/pictures/picture_layout.hpp>

#include <vtkSmartPointer.h>

#include <functional>
#include <string>
#include <vector>

class vtkActor2D;
class vtkPolyData;
class vtkRenderer;
class vtkTextActor;

namespace gracilis {

/// Flat things over a window: shapes, texts, and areas that answer the mouse. Pixels from the lower left corner.
class Overlay {
 public:
  /// Draws into the renderer, which must outlive it and shows nothing else.
  explicit Overlay(vtkRenderer& renderer);

  void clear();  ///< takes everything away
  /// What is added from now on covers what was added before. Within a layer texts stand over shapes.
  void begin_layer();
  /// Filled; `opacity` 0 to 1.
  void add_rectangle(const Rectangle& part, const Color& color, Real opacity = 1);
  /// One that points to the right, as on a button to play.
  void add_triangle(const Rectangle& part, const Color& color);
  /// A rectangle that can be moved without laying everything out anew.
  vtkSmartPointer<vtkActor2D> add_mark(const Rectangle& part, const Color& color);
  /// Text that begins, ends or has its middle at x, and stands on y.
  vtkSmartPointer<vtkTextActor> add_text(int x, int y, const std::string& text, int size, const Color& color);
  /// One that ends at x.
  vtkSmartPointer<vtkTextActor> add_text_right(int x, int y, const std::string& text, int size, const Color& color);
  /// One with its middle at x.
  vtkSmartPointer<vtkTextActor> add_text_centered(int x, int y, const std::string& text, int size, const Color& color);
  /// How wide a text is, pixels. Precondition: the renderer is in a window.
  int width_of(const std::string& text, int size) const;
  /// `act` gets where in `scale` (the area itself) the mouse is, 0 to 1 from left to right: when it is pressed in the
  /// area, and, where `drags`, while it moves until it is released.
  void add_area(const Rectangle& area, bool drags, std::function<void(Real)> act);
  /// With a scale that is not the area.
  void add_area(const Rectangle& area, bool drags, std::function<void(Real)> act, const Rectangle& scale);

  /// True when an area took it; of several, the one that was added last.
  bool press(int x, int y);
  /// The mouse moved to x; true where an area follows it.
  bool drag(int x);
  void release() { dragged_.clear(); }  ///< the button of the mouse

 private:
  struct Area {
    Rectangle part, scale;
    bool drags;
    std::function<void(Real)> act;
  };
  vtkRenderer& renderer_;
  vtkSmartPointer<vtkPolyData> shapes_;  ///< of the present layer: one actor, for each costs time
  std::vector<Area> areas_;
  std::vector<Area> dragged_;  ///< one, or none
};

}  // namespace gracilis
