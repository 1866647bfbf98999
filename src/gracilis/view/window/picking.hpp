#pragma once

#include <gracilis/view/window/shape_history.hpp>
#include <gracilis/view/window/window_state.hpp>

#include <optional>
#include <string>

class vtkRenderer;

namespace gracilis {

/// Between world (m) and window: pixels from the lower left corner, and m towards the eye.
struct WindowProjection {
  Eigen::Matrix3d axes;  ///< right, up, towards the eye; orthonormal
  Vec3 middle;           ///< in the window's middle, m
  Real pixels_per_metre = 1, width = 0, height = 0;

  /// Pixels from the lower left corner, and m towards the eye.
  Vec3 in_window(const Vec3& place) const;
  /// The inverse of in_window, m.
  Vec3 in_world(const Vec3& in_window) const;
};
/// Of the renderer's camera as it is. Precondition: it projects in parallel.
WindowProjection projection_of(vtkRenderer& renderer);

/// What of the surfaces that are shown is seen at a pixel.
struct SurfaceHit {
  bool is_bone = false;
  std::size_t number = 0;     ///< of the muscle or bone
  Index vertex = 0;           ///< the nearest corner of the triangle
  Vec3 place = Vec3::Zero();  ///< m
};
/// The one nearest to the eye among muscles and bones that are not hidden; pixels from the lower left corner.
std::optional<SurfaceHit> surface_at(int x, int y, const ShownShapes& shapes, const ShownFrame& frame,
                                     const WindowState& state, const WindowProjection& projection);

/// "gluteus medius r, vertex 412: 12.0, 34.5, -8.1 mm; edges 1.43 × rest": what the frame knows of a vertex.
std::string numbers_of(const PickedVertex& picked, const ShownShapes& shapes, const ShownFrame& frame);

}  // namespace gracilis
