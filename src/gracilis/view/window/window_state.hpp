#pragma once

#include <gracilis/view/pictures/color_scale.hpp>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace gracilis {

enum class MuscleState { solid, transparent, hidden };
enum class SurfaceStyle { solid, edges, wireframe };
/// What the colors of muscles tell.
enum class WindowColor {
  natural,  ///< what muscles look like
  muscle,
  tissue,
  activation,
  fiber_strain,
  edge_stretch,
  contact_depth,
  volume,
  stress,
  tension
};
/// Earlier frames that are seen through.
enum class Ghost { none, first_frame, trail };
enum class Arrows { none, frame, iteration };
/// A plane through the bones' distance fields.
enum class Slice { none, sagittal, coronal, transverse };

inline constexpr int window_color_count = 10;
inline constexpr std::array trail_steps = {10, 20, 30};  ///< frames back

/// A vertex of what is drawn of a muscle.
struct PickedVertex {
  std::size_t muscle = 0;
  Index vertex = 0;
};

/// What of the shapes is seen, and how.
struct WindowState {
  std::vector<MuscleState> muscles;
  WindowColor color_by = WindowColor::natural;
  SurfaceStyle style = SurfaceStyle::solid;
  bool bones = true, fibers = false, attachments = false;
  Ghost ghost = Ghost::none;
  Arrows arrows = Arrows::none;
  int iteration = 0;              ///< of the arrows
  std::vector<bool> arrow_kinds;  ///< per ConstraintKind
  Slice slice = Slice::none;
  Real slice_at = 0.5;  ///< 0 to 1 through what is shown
  std::optional<PickedVertex> picked = {};
};

/// The scale of a coloring; without colors where muscles have their own.
const ColorScale& window_scale(WindowColor color);

/// The legend of the coloring by tissue.
struct TissueColor {
  std::string name;
  Color color;
};
const std::vector<TissueColor>& tissue_colors();  ///< belly, tendon, origin, insertion

}  // namespace gracilis
