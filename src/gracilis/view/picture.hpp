#pragma once

#include <gracilis/core/types.hpp>
#include <gracilis/geometry/polylines.hpp>
#include <gracilis/geometry/triangle_mesh.hpp>
#include <gracilis/view/palette.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace gracilis {

/// One surface of a picture.
struct PaintedSurface {
  std::string name;  ///< appears in the picture's legend; empty: not in the legend
  TriangleMesh mesh;
  Color color = bone_color();
  Real opacity = 1;
  bool framed = true;  ///< false: the picture makes no room for it and may cut it off
};

/// Lines of a picture, such as fibers; never in the legend, and no room is made for them.
struct PaintedLines {
  Polylines lines;
  Color color = Color::Zero();
  int width = 2;  ///< pixels
};

/// One view of some surfaces, with a caption below it.
struct Panel {
  std::string caption;
  std::vector<PaintedSurface> surfaces;
  std::vector<PaintedLines> lines = {};
  Vec3 looking = Vec3::UnitY();  ///< direction in which the camera looks, world frame
  Vec3 up = Vec3::UnitZ();       ///< points up in the picture; not parallel to `looking`
};

/// Panels side by side, all at the same scale, with a title above and a legend of the named surfaces below.
struct Picture {
  std::string title;          ///< empty: none
  std::vector<Panel> panels;  ///< at least one
  int columns = 0;            ///< panels per row; 0: all in one row
  int panel_width = 720;      ///< pixels
  int panel_height = 0;       ///< pixels; 0: as what is seen needs at this width
  Color background = Color::Ones();
};

/// Draws the picture without window or display and writes it to `path` (.png), whole or not at all.
/// Throws Error when this machine offers no OpenGL (exit code 4: a run warns and goes on) or the file cannot be
/// written.
void render_picture(const Picture& picture, const std::filesystem::path& path);

}  // namespace gracilis
