#include <gracilis/view/pictures/picture_layout.hpp>

#include <gracilis/core/errors.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gracilis {

static constexpr int strip_height = 56;                // pixels: title, legend or caption
static constexpr int color_bar_width = 460;            // pixels
static constexpr int scale_bar_height = 44;            // pixels, where it stands by itself
static constexpr int narrow_panel = 260;               // pixels; a caption has no room beside a scale bar
static constexpr int least_font = 11, most_font = 20;  // pixels, of a legend
// Pages show a wider picture smaller: 15 pixels of 1200 are 11 on a page of 900.
static constexpr Real unscaled_width = 1200;  // pixels
static constexpr Real border = 1.06;          // free space around what is seen

static void require_drawable(bool ok, const char* what) {
  if (!ok) throw ConfigurationError({"", "picture", what, ""});
}

/// Smallest and largest coordinates along the camera's right, up and looking directions.
struct Extent {
  Vec3 low = Vec3::Constant(std::numeric_limits<Real>::infinity());
  Vec3 high = -low;
};

/// Of what this panel's camera has to see: it is shared by those that look the same way and have none of their own.
static Extent extent_seen_by(const CameraView& camera, const Panel& own, const Picture& picture) {
  Eigen::Matrix3d axes;
  axes << camera.right.transpose(), camera.up.transpose(), camera.looking.transpose();
  Extent extent;
  for (const Panel& panel : picture.panels) {
    const bool shares_camera =
        !own.has_own_camera && !panel.has_own_camera && panel.looking.normalized().isApprox(camera.looking, 1e-9);
    if (!shares_camera && &panel != &own) continue;
    const auto add = [&](const Points& points) {
      if (points.cols() == 0) return;
      require_drawable(points.allFinite(), "a point is not finite");
      const Points seen = axes * points;
      extent.low = extent.low.cwiseMin(seen.rowwise().minCoeff());
      extent.high = extent.high.cwiseMax(seen.rowwise().maxCoeff());
    };
    add(panel.room);
    for (const PaintedSurface& surface : panel.surfaces)
      if (surface.framed) add(surface.mesh.vertices);
    for (const PaintedLines& lines : panel.lines)
      if (lines.framed) add(lines.lines.points);
  }
  return extent;
}

static CameraView camera_of(const Panel& panel) {
  CameraView camera;
  camera.looking = panel.looking.normalized();
  camera.right = camera.looking.cross(panel.up);
  require_drawable(camera.right.norm() > 1e-9,
                   "the camera's up direction must not be parallel to its looking direction");
  camera.right.normalize();
  camera.up = camera.right.cross(camera.looking);
  return camera;
}

/// Points the cameras; returns half the width and height that the panel seeing most needs, m.
static Eigen::Vector2d place_cameras(const Picture& picture, PictureLayout& layout) {
  Eigen::Vector2d needed = Eigen::Vector2d::Zero();
  for (const Panel& panel : picture.panels) {
    CameraView camera = camera_of(panel);
    const Extent extent = extent_seen_by(camera, panel, picture);
    require_drawable(extent.low.allFinite() && extent.high.allFinite(), "there is nothing to see");
    const Vec3 middle = (extent.low + extent.high) / 2;
    camera.center = camera.right * middle.x() + camera.up * middle.y() + camera.looking * middle.z();
    needed = needed.cwiseMax(((extent.high - extent.low) / 2 * border).head<2>());
    layout.cameras.push_back(camera);
  }
  require_drawable(needed.maxCoeff() > 0, "there is nothing to see: all points coincide");
  return needed;
}

static std::vector<std::pair<std::string, Color>> legend_of(const Picture& picture) {
  std::vector<std::pair<std::string, Color>> entries;
  for (const Panel& panel : picture.panels) {
    for (const PaintedSurface& surface : panel.surfaces) {
      const auto same_name = [&](const auto& entry) { return entry.first == surface.name; };
      if (surface.name.empty() || std::any_of(entries.begin(), entries.end(), same_name)) continue;
      entries.emplace_back(surface.name, surface.color);
    }
  }
  return entries;
}

/// A swatch, gaps and a name whose letters are as wide as the wide ones of most names.
static int entry_width(std::size_t letters, int font, Real text) {
  return static_cast<int>(40 * text) + static_cast<int>(std::ceil(0.6 * font * static_cast<Real>(letters)));
}

/// In as few rows as leave every name its room, and in as large a font as these have room for.
static LegendGrid legend_grid(int count, std::size_t letters, int width, const PictureLayout& layout) {
  const int least = text_pixels(layout, least_font);
  const int most_columns = std::clamp(width / entry_width(letters, least, layout.text), 1, count);
  const int rows = (count + most_columns - 1) / most_columns;
  LegendGrid grid{(count + rows - 1) / rows, text_pixels(layout, most_font), 0};
  while (grid.font > least && entry_width(letters, grid.font, layout.text) > width / grid.columns) --grid.font;
  grid.row_height = grid.font + text_pixels(layout, 8);
  return grid;
}

/// What stands below the panels. Returns where that ends.
static int place_legend(const Picture& picture, int panel_height, PictureLayout& layout) {
  const int strip = text_pixels(layout, strip_height);
  const int bar_width = picture.color_bar ? std::min(layout.width, text_pixels(layout, color_bar_width)) : 0;
  layout.color_bar = {layout.width - bar_width, 0, bar_width, bar_width > 0 ? strip : 0};
  if (layout.legend_entries.empty()) return layout.color_bar.height;
  std::size_t letters = 1;
  for (const auto& [name, color] : layout.legend_entries) letters = std::max(letters, name.size());
  const int count = static_cast<int>(layout.legend_entries.size()), beside = layout.width - bar_width;
  const int entry = entry_width(letters, text_pixels(layout, least_font), layout.text);
  const bool above = bar_width > 0 && beside < std::min(count, 2) * entry;
  const int width = above ? layout.width : beside;
  layout.legend_grid = legend_grid(count, letters, width, layout);
  const int rows = (count + layout.legend_grid.columns - 1) / layout.legend_grid.columns;
  if (2 * rows * layout.legend_grid.row_height > panel_height) {
    // Nobody tells a body's hundred muscles apart by color.
    layout.legend_entries.clear();
    return layout.color_bar.height;
  }
  layout.legend = {0, above ? strip : 0, width, strip + (rows - 1) * layout.legend_grid.row_height};
  return layout.legend.y + layout.legend.height;
}

PictureLayout lay_out(const Picture& picture) {
  require_drawable(!picture.panels.empty(), "a picture needs at least one panel");
  require_drawable(picture.panel_width > 0 && picture.panel_height >= 0, "a panel needs a width and a height");
  const int count = static_cast<int>(picture.panels.size());
  const int columns = picture.columns > 0 ? std::min(picture.columns, count) : count;
  const int rows = (count + columns - 1) / columns;
  const bool captions =
      std::any_of(picture.panels.begin(), picture.panels.end(), [](const Panel& p) { return !p.caption.empty(); });

  PictureLayout layout;
  layout.width = columns * picture.panel_width;
  layout.text = std::max(1.0, layout.width / unscaled_width);
  const int strip = text_pixels(layout, strip_height), caption_height = captions ? strip : 0;
  const Eigen::Vector2d needed = place_cameras(picture, layout);
  const int fitting_height = static_cast<int>(picture.panel_width * std::clamp(needed.y() / needed.x(), 0.5, 2.0));
  const int panel_height = picture.panel_height > 0 ? picture.panel_height : fitting_height;
  layout.half_height = std::max(needed.y(), needed.x() * panel_height / picture.panel_width) / picture.zoom;
  const int row_height = panel_height + caption_height;
  layout.legend_entries = legend_of(picture);
  int below = place_legend(picture, panel_height, layout);
  if (picture.scale_bar && captions && picture.panel_width < text_pixels(layout, narrow_panel)) {
    layout.scale_bar = {0, below, layout.width, text_pixels(layout, scale_bar_height)};
    below += layout.scale_bar.height;
  }
  layout.title = {0, below + rows * row_height, layout.width, picture.title.empty() ? 0 : strip};
  layout.height = layout.title.y + layout.title.height;
  for (int i = 0; i < count; ++i) {
    const int x = (i % columns) * picture.panel_width;
    const int y = below + (rows - 1 - i / columns) * row_height;
    layout.captions.push_back({x, y, picture.panel_width, caption_height});
    layout.panels.push_back({x, y + caption_height, picture.panel_width, panel_height});
  }
  return layout;
}

}  // namespace gracilis
