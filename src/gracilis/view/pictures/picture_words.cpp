#include <gracilis/view/pictures/picture_words.hpp>

#include <gracilis/io/mesh/vtk_mesh.hpp>

#include <fmt/format.h>
#include <vtkActor2D.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty2D.h>
#include <vtkRenderer.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

namespace gracilis {
namespace {

// Pixels of a picture that is up to 1200 wide.
constexpr int scale_bar_left = 20, scale_bar_font = 17, largest_title = 30, text_margin = 8;
constexpr int largest_caption = 24, least_in_one_line = 16, smallest_letters = 11;
constexpr Real caption_pitch = 1.2;  // of a font

vtkSmartPointer<vtkTextActor> text_actor(const std::string& text, int pixels, bool bold) {
  auto actor = vtkSmartPointer<vtkTextActor>::New();
  actor->SetInput(text.c_str());
  vtkTextProperty* property = actor->GetTextProperty();
  property->SetFontFamilyToArial();
  property->SetFontSize(pixels);
  property->SetBold(bold);
  property->SetColor(0.13, 0.13, 0.13);
  property->SetVerticalJustificationToCentered();
  return actor;
}

/// How wide texts are. Asked for at one size, for the font's shapes are scaled.
class TextWidths {
 public:
  explicit TextWidths(vtkRenderer& renderer) : renderer_(renderer) {}

  /// Pixels, of a font of so many.
  Real of(const std::string& text, Real font) {
    const auto [found, is_new] = widths_.try_emplace(text);
    if (is_new) {
      double size[2] = {0, 0};
      text_actor(text, measured_font, false)->GetSize(&renderer_, size);
      found->second = size[0] / measured_font;
    }
    return font * found->second;
  }

 private:
  static constexpr int measured_font = 48;  // pixels
  vtkRenderer& renderer_;
  std::map<std::string, Real> widths_;
};

/// In pixels of the window.
void add_rectangle(const Color& color, const Rectangle& part, vtkRenderer& renderer) {
  Points corners(3, 4);
  corners << part.x, part.x + part.width, part.x + part.width, part.x, part.y, part.y, part.y + part.height,
      part.y + part.height, 0, 0, 0, 0;
  Eigen::Matrix3Xi faces(3, 2);
  faces << 0, 0, 1, 2, 2, 3;
  vtkNew<vtkPolyDataMapper2D> mapper;
  mapper->SetInputData(to_vtk(corners, faces));
  vtkNew<vtkActor2D> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(color.x(), color.y(), color.z());
  renderer.AddActor2D(actor);
}

/// A line of a round length, at most a fifth of the panel. Pixels of the picture.
struct ScaleBar {
  std::string text;
  int width = 0;
  Real words = 0;  ///< how wide the text is
  int end = 0;     ///< from the panel's left
};

ScaleBar scale_bar_of(const PictureLayout& layout, TextWidths& widths) {
  const Rectangle& part = layout.panels[0];
  const Real pixels_per_metre = part.height / (2 * layout.half_height);
  Real length = 0.001;
  for (const Real each : {0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0})
    if (each * pixels_per_metre <= part.width / 5.0) length = each;
  ScaleBar bar;
  bar.text = length < 0.01 ? fmt::format("{:.0f} mm", 1000 * length) : fmt::format("{:.0f} cm", 100 * length);
  bar.width = static_cast<int>(std::lround(length * pixels_per_metre));
  bar.words = widths.of(bar.text, text_pixels(layout, scale_bar_font));
  bar.end = text_pixels(layout, scale_bar_left) + static_cast<int>(std::ceil(std::max<Real>(bar.width, bar.words)));
  return bar;
}

/// A text in lines.
struct Lines {
  std::string text;
  int count = 0;
  Real width = 0;     ///< pixels, of the longest
  bool whole = true;  ///< what stands between commas and colons stays together
};

/// Behind the comma or colon that ends what begins there, and its space.
std::size_t piece_end(const std::string& text, std::size_t begin) {
  return std::min({text.find(", ", begin), text.find(": ", begin), text.size() - 2}) + 2;
}

/// Words in lines that are no wider than `room`, where that can be; what stands between commas and colons stays
/// together where it can.
Lines in_lines(const std::string& text, Real room, Real font, TextWidths& widths) {
  Lines lines;
  std::string line;
  const auto end_line = [&] {
    if (line.ends_with(' ')) line.pop_back();
    if (line.empty()) return;
    lines.text += (lines.count++ > 0 ? "\n" : "") + line;
    lines.width = std::max(lines.width, widths.of(line, font));
    line.clear();
  };
  const auto add = [&](const std::string& piece) {
    if (widths.of(line + piece, font) > room) end_line();
    line += piece;
  };
  for (std::size_t begin = 0, end = 0; begin < text.size(); begin = end) {
    end = piece_end(text, begin);
    const std::string piece = text.substr(begin, end - begin);
    if (widths.of(piece, font) <= room) {
      add(piece);
      continue;
    }
    lines.whole = false;
    for (std::size_t word = 0, next = 0; word < piece.size(); word = next) {
      next = std::min(piece.find(' ', word), piece.size() - 1) + 1;
      add(piece.substr(word, next - word));
    }
  }
  end_line();
  return lines;
}

bool stands_beside_scale_bar(const Picture& picture, const PictureLayout& layout, std::size_t panel) {
  return panel == 0 && picture.scale_bar && layout.scale_bar.height == 0;
}

/// Pixels from the panel's left.
int caption_begin(const Picture& picture, const PictureLayout& layout, std::size_t panel, TextWidths& widths) {
  return stands_beside_scale_bar(picture, layout, panel) ? scale_bar_of(layout, widths).end + 2 * text_margin
                                                         : text_margin;
}

/// Captions in the largest font in which each finds its room: in one line or, where that would be too small, in
/// several, which break a coordinate from its value only where they would else be too small, too. All have the same
/// font.
struct Captions {
  Real font = 0;  ///< pixels
  std::vector<Lines> lines;
};

Captions captions_of(const Picture& picture, const PictureLayout& layout, TextWidths& widths) {
  Captions captions;
  enum class Breaks { none, between_pieces, anywhere };
  const auto fit = [&](int font, Breaks breaks) {
    captions = {layout.text * font, {}};
    bool all = true;
    for (std::size_t i = 0; i < picture.panels.size(); ++i) {
      const std::string& text = picture.panels[i].caption;
      const Rectangle& part = layout.captions[i];
      const Real room = part.width - text_margin - caption_begin(picture, layout, i, widths);
      captions.lines.push_back(breaks == Breaks::none ? Lines{text, 1, widths.of(text, captions.font)}
                                                      : in_lines(text, room, captions.font, widths));
      const Lines& lines = captions.lines.back();
      all = all && (lines.whole || breaks == Breaks::anywhere) && lines.width <= room &&
            lines.count * caption_pitch * captions.font <= part.height;
    }
    return all;
  };
  for (int font = largest_caption; font >= least_in_one_line; --font)
    if (fit(font, Breaks::none)) return captions;
  for (int font = largest_caption; font >= least_in_one_line; --font)
    if (fit(font, Breaks::between_pieces)) return captions;
  for (int font = largest_caption; font > smallest_letters; --font)
    if (fit(font, Breaks::anywhere)) return captions;
  // What would be cut off could not be read either.
  for (int font = smallest_letters; font > 5 && !fit(font, Breaks::anywhere); --font) continue;
  return captions;
}

}  // namespace

void draw_title(const Picture& picture, const PictureLayout& layout, int scale, vtkRenderer& renderer) {
  const int pixels = text_pixels(layout, largest_title) * scale;
  const vtkSmartPointer<vtkTextActor> actor = text_actor(picture.title, pixels, true);
  double size[2] = {0, 0};
  actor->GetSize(&renderer, size);
  const Real room = (layout.title.width - 2 * text_margin) * scale;
  if (size[0] > room) actor->GetTextProperty()->SetFontSize(static_cast<int>(pixels * room / size[0]));
  actor->GetTextProperty()->SetJustificationToCentered();
  actor->SetPosition(layout.title.width * scale / 2.0, layout.title.height * scale / 2.0);
  renderer.AddActor2D(actor);
}

void draw_scale_bar(const PictureLayout& layout, int scale, vtkRenderer& renderer) {
  const auto px = [&](int pixels) { return text_pixels(layout, pixels); };
  TextWidths widths(renderer);
  const ScaleBar bar = scale_bar_of(layout, widths);
  const Rectangle line{px(scale_bar_left) * scale, px(14) * scale, bar.width * scale, px(3) * scale};
  add_rectangle(Color::Constant(0.13), line, renderer);
  const vtkSmartPointer<vtkTextActor> label = text_actor(bar.text, px(scale_bar_font) * scale, false);
  label->GetTextProperty()->SetJustificationToCentered();
  // In a small picture the words are wider than the line.
  label->SetPosition(line.x + std::max<Real>(bar.width, bar.words) * scale / 2, px(28) * scale);
  renderer.AddActor2D(label);
}

void draw_caption(const Picture& picture, const PictureLayout& layout, std::size_t panel, int scale,
                  vtkRenderer& renderer) {
  if (stands_beside_scale_bar(picture, layout, panel)) draw_scale_bar(layout, scale, renderer);
  TextWidths widths(renderer);
  const Captions captions = captions_of(picture, layout, widths);
  const Lines& lines = captions.lines[panel];
  const Rectangle& part = layout.captions[panel];
  const auto actor = text_actor(lines.text, static_cast<int>(captions.font * scale), false);
  actor->GetTextProperty()->SetJustificationToCentered();
  // In the middle, or as near to it as the scale bar allows.
  const Real begin = caption_begin(picture, layout, panel, widths);
  actor->SetPosition(std::max(part.width / 2.0, begin + lines.width / 2) * scale, part.height * scale / 2.0);
  renderer.AddActor2D(actor);
}

void draw_legend(const PictureLayout& layout, int scale, vtkRenderer& renderer) {
  const auto& [columns, font, row_height] = layout.legend_grid;
  const int count = static_cast<int>(layout.legend_entries.size()), rows = (count + columns - 1) / columns;
  const int cell = layout.legend.width / columns;
  for (int i = 0; i < count; ++i) {
    const auto& [name, color] = layout.legend_entries[static_cast<std::size_t>(i)];
    const int x = i % columns * cell + text_pixels(layout, 12);
    const int middle = (layout.legend.height + (rows - 1 - 2 * (i / columns)) * row_height) / 2;
    add_rectangle(color, {x * scale, (middle - font / 2) * scale, font * scale, font * scale}, renderer);
    const vtkSmartPointer<vtkTextActor> text = text_actor(name, font * scale, false);
    text->SetPosition((x + font + text_pixels(layout, 8)) * scale, middle * scale);
    renderer.AddActor2D(text);
  }
}

void draw_color_bar(const ColorBar& bar, const PictureLayout& layout, int scale, vtkRenderer& renderer) {
  const auto px = [&](int pixels) { return text_pixels(layout, pixels); };
  const Rectangle& part = layout.color_bar;
  const int left = part.width / 2, width = part.width / 2 - px(40), height = px(14), bottom = part.height / 2;
  static constexpr int pieces = 64;
  const auto last = static_cast<Real>(bar.colors.size() - 1);
  for (int i = 0; i < pieces; ++i) {
    const Real at = last * i / (pieces - 1);
    const auto below = static_cast<std::size_t>(std::min(std::floor(at), std::max(last - 1, 0.0)));
    const Color& next = bar.colors[std::min(below + 1, bar.colors.size() - 1)];
    const Color color = bar.colors[below] + (at - static_cast<Real>(below)) * (next - bar.colors[below]);
    const int begin = scale * left + scale * width * i / pieces, end = scale * left + scale * width * (i + 1) / pieces;
    add_rectangle(color, {begin, scale * bottom, end - begin, scale * height}, renderer);
  }
  const Real room = left - px(14) - text_margin, most = room / TextWidths(renderer).of(bar.title, 1);
  const Real font = std::clamp<Real>(most, px(smallest_letters), px(18));
  const vtkSmartPointer<vtkTextActor> title = text_actor(bar.title, static_cast<int>(font * scale), false);
  title->GetTextProperty()->SetJustificationToRight();
  const int middle = bottom + height / 2;
  title->SetPosition((left - px(14)) * scale, middle * scale);
  renderer.AddActor2D(title);
  for (std::size_t i = 0; i < bar.ticks.size(); ++i) {
    const vtkSmartPointer<vtkTextActor> tick = text_actor(bar.ticks[i], px(15) * scale, false);
    tick->GetTextProperty()->SetJustificationToCentered();
    const Real share = bar.ticks.size() > 1 ? static_cast<Real>(i) / static_cast<Real>(bar.ticks.size() - 1) : 0.5;
    tick->SetPosition((left + share * width) * scale, (bottom - px(11)) * scale);
    renderer.AddActor2D(tick);
  }
}

}  // namespace gracilis
