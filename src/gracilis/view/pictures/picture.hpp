#pragma once

#include <gracilis/core/types.hpp>
#include <gracilis/geometry/polylines.hpp>
#include <gracilis/geometry/triangle_mesh.hpp>
#include <gracilis/view/pictures/palette.hpp>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace gracilis {

/// One surface of a picture.
struct PaintedSurface {
  std::string name;  ///< appears in the picture's legend; empty: not in the legend
  TriangleMesh mesh;
  Color color = bone_color();
  Real opacity = 1;
  bool framed = true;              ///< false: the picture makes no room for it and may cut it off
  Points colors = Points(3, 0);    ///< one per vertex, instead of `color`; empty: none
  bool solid = false;              ///< closed, its triangles outward: those that look away need not be drawn
  std::vector<Real> stripes = {};  ///< m, one per vertex: where it lies across the fibers, see MuscleLook; empty: none
};

/// Lines of a picture, such as fibers; never in the legend.
struct PaintedLines {
  Polylines lines;
  Color color = Color::Zero();
  int width = 2;                   ///< pixels
  Real radius = 0;                 ///< m; above 0 they are tubes of this radius, and `width` says nothing
  std::vector<Color> colors = {};  ///< one per line, instead of `color`; empty: none
  bool framed = true;              ///< false: the picture makes no room for them
  /// Tubes alone, without `colors`: paler the further back they lie, and with dark rims, so that one sees which of two
  /// that cross lies before the other.
  bool fades = false;
};

/// What the colors of a picture mean.
struct ColorBar {
  std::string title;
  std::vector<Color> colors;       ///< at equal distances, from the lowest value to the highest
  std::vector<std::string> ticks;  ///< what stands at equal distances from the bar's left to its right end
};

/// One view of some surfaces, with a caption below it.
struct Panel {
  std::string caption;
  std::vector<PaintedSurface> surfaces;
  std::vector<PaintedLines> lines = {};
  Vec3 looking = Vec3::UnitY();  ///< direction in which the camera looks, world frame
  Vec3 up = Vec3::UnitZ();       ///< points up in the picture; not parallel to `looking`
  Points room = Points(3, 0);    ///< points that the picture makes room for, too
  bool has_own_camera = false;   ///< looks at what is framed in this panel, wherever it is in others
};

/// Panels side by side, all at the same scale, with a title above and a legend of the named surfaces below.
struct Picture {
  std::string title;          ///< empty: none
  std::vector<Panel> panels;  ///< at least one
  int columns = 0;            ///< panels per row; 0: all in one row
  int panel_width = 720;      ///< pixels
  int panel_height = 0;       ///< pixels; 0: as what is seen needs at this width
  Color background = Color::Ones();
  std::optional<ColorBar> color_bar = {};  ///< beside the legend
  bool scale_bar = false;                  ///< in the first panel
  Real zoom = 1;                           ///< shows everything so many times larger, about the middle
};

/// Pixels as red, green, blue and opacity, 0 ... 255; the upper row first.
struct PixelImage {
  int width = 0, height = 0;
  std::vector<unsigned char> rgba;
};

/// Draws pictures without window or display; keeps what pictures of the same size can share.
class PictureDrawer {
 public:
  /// Throws Error (exit code 4) when this machine offers no OpenGL.
  PictureDrawer();
  ~PictureDrawer();
  PictureDrawer(const PictureDrawer&) = delete;
  PictureDrawer& operator=(const PictureDrawer&) = delete;

  /// Throws ConfigurationError as lay_out does, and Error (exit code 4) when OpenGL fails. `transparent`: without
  /// background.
  PixelImage draw(const Picture& picture, bool transparent = false);

 private:
  struct Window;
  std::unique_ptr<Window> window_;
};

/// Writes a .png, whole or not at all: with opacity where a pixel is not opaque. Throws InputError.
void write_png(const std::filesystem::path& path, const PixelImage& image);

/// Draws the picture without window or display and writes it to `path` (.png), whole or not at all.
/// Throws Error when this machine offers no OpenGL (exit code 4: a run warns and goes on) or the file cannot be
/// written.
void render_picture(const Picture& picture, const std::filesystem::path& path);

}  // namespace gracilis
