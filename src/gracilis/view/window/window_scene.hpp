#pragma once

#include <gracilis/view/pictures/evened_surface.hpp>
#include <gracilis/view/pictures/picture_layout.hpp>
#include <gracilis/view/pictures/stripes.hpp>
#include <gracilis/view/window/glyphs.hpp>
#include <gracilis/view/window/shape_history.hpp>
#include <gracilis/view/window/surface_actor.hpp>
#include <gracilis/view/window/window_state.hpp>

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace gracilis {

/// The shapes as VTK's actors. For the thread of the window only.
class WindowScene {
 public:
  /// Both must outlive this.
  WindowScene(const ShownShapes& shapes, const ShapeHistory& history, vtkRenderer& renderer);

  /// Everything as it is in a frame; `fast`: of what one sees through, the nearest layer only, and no stripes.
  void show(int frame, const WindowState& state, const ColoredMesh& slice, bool fast);
  /// What stands beside the scale of a coloring: an end says so once values beyond it have been shown.
  std::vector<std::string> ticks(WindowColor color) const;
  /// How many times longer than the displacements the arrows are.
  Real arrow_scale() const { return arrow_scale_; }

 private:
  struct MuscleActors {
    SurfaceActor surface, fibers, attachments;
    std::array<SurfaceActor, trail_steps.size()> ghosts;
  };
  /// Evened, unless something drawn tells where vertices are.
  ShownPoints drawn_points(std::size_t muscle, const ShownFrame& frame, const WindowState& state) const;
  Color color_of(Real value, WindowColor by);
  std::vector<Color> vertex_colors(std::size_t muscle, const ShownFrame& frame, WindowColor by);
  void show_bones(const ShownFrame& frame, const WindowState& state);
  void show_muscle(std::size_t muscle, const ShownFrame& frame, const WindowState& state, bool fast);
  void show_fibers(std::size_t muscle, const ShownFrame& frame, const WindowState& state);
  void show_attachments(std::size_t muscle, const ShownFrame& frame, const WindowState& state);
  void show_ghosts(std::size_t muscle, int frame, const WindowState& state);
  void show_picked(const ShownFrame& frame, const WindowState& state);
  void show_arrows(const ShownFrame& frame, const WindowState& state);

  const ShownShapes& shapes_;
  const ShapeHistory& history_;
  vtkRenderer& renderer_;
  std::vector<MuscleActors> muscles_;
  std::vector<EvenedSurface> evened_;  ///< per muscle
  std::vector<SurfaceActor> bones_;
  SurfaceActor slice_, arrows_, picked_;
  const vtkSmartPointer<vtkTexture> stripe_texture_ = stripe_texture();
  Real arrow_scale_ = 1;
  /// Per coloring: the least and largest value shown so far.
  std::array<std::pair<Real, Real>, window_color_count> seen_;
};

/// True when a muscle is shown so that one sees through it.
bool is_seen_through(std::size_t muscle, const WindowState& state);

/// Camera from a direction of view_names(); all that is shown, wherever it goes in the frames that are known, fills a
/// part of the window.
void look_from(const std::string& view, const ShownShapes& shapes, const ShapeHistory& history,
               const WindowState& state, const Rectangle& part, vtkRenderer& renderer);

/// The same from where the camera looks now.
void fit_all(const ShownShapes& shapes, const ShapeHistory& history, const WindowState& state, const Rectangle& part,
             vtkRenderer& renderer);

/// Whether all that is shown of a frame lies within a part of the window.
bool is_within(const ShownShapes& shapes, const ShownFrame& frame, const WindowState& state, const Rectangle& part,
               vtkRenderer& renderer);

}  // namespace gracilis
