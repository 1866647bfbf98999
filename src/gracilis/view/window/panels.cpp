#include <gracilis/view/window/panels.hpp>

#include <gracilis/view/window/interactive_window.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gracilis {

std::string words_of(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

/// Which of several entries stand on a page.
struct PageEntries {
  std::size_t begin, end, pages;
};

/// With room for `most` entries, or one less and what turns the page.
static PageEntries entries_on(std::size_t& page, std::size_t count, int most) {
  const auto all = static_cast<std::size_t>(std::max(1, most));
  const std::size_t each = count > all ? std::max<std::size_t>(1, all - 1) : all;
  const std::size_t pages = std::max<std::size_t>(1, (count + each - 1) / each);
  page %= pages;
  return {page * each, std::min(count, (page + 1) * each), pages};
}

/// Below `y`, where there is more than one page. Returns where it ends.
static int add_page_turner(int left, int y, int width, const std::string& what, std::size_t& page, std::size_t pages,
                           const std::function<void()>& turned, Overlay& overlay) {
  if (pages < 2) return y;
  y -= 24;
  overlay.add_text(left, y, fmt::format("{} {} of {}: more", what, page + 1, pages), 14, accent);
  overlay.add_area({left - 6, y - 6, width, 24}, false, [turned, &page](Real) {
    ++page;
    turned();
  });
  return y;
}

static constexpr int list_pitch = 22, list_width = 186;

static void add_entry(int x, int y, const ListEntry& entry, Overlay& overlay) {
  overlay.add_rectangle({x, y, 14, 14}, Color::Constant(0.45), 1);
  overlay.add_rectangle({x + 1, y + 1, 12, 12}, Color::Ones(), 1);
  if (entry.strength > 0) overlay.add_rectangle({x + 1, y + 1, 12, 12}, entry.color, entry.strength);
  overlay.add_text(x + list_indent, y - 2, entry.text, list_text_size,
                   entry.strength > 0 ? ink : Color(Color::Constant(0.5)));
  overlay.add_area({x - 4, y - 4, list_width, list_pitch}, false, [act = entry.act](Real) { act(); });
}

int add_list(int left, int top, const std::vector<ListEntry>& entries, Overlay& overlay) {
  for (const ListEntry& entry : entries) add_entry(left, top -= list_pitch, entry, overlay);
  return top;
}

int add_paged_list(int left, int top, int bottom, const std::string& what, std::size_t& page,
                   const std::vector<ListEntry>& entries, const std::function<void()>& turned, Overlay& overlay) {
  const PageEntries shown = entries_on(page, entries.size(), (top - bottom - 8) / list_pitch);
  for (std::size_t i = shown.begin; i < shown.end; ++i) add_entry(left, top -= list_pitch, entries[i], overlay);
  return add_page_turner(left, top, list_width, what, page, shown.pages, turned, overlay);
}

void add_options(int left, int top, const std::vector<OptionEntry>& entries, Overlay& overlay) {
  static constexpr int pitch = 20;
  int y = top;
  for (const OptionEntry& entry : entries) {
    y -= pitch;
    overlay.add_rectangle({left - 2, y - 1, 18, 17}, Color::Constant(0.86), 1);
    overlay.add_text_centered(left + 7, y, entry.key, 13, ink);
    overlay.add_text(left + 26, y, entry.name + (entry.value.empty() ? "" : ": " + entry.value), 14,
                     entry.value.empty() || entry.value == "off" ? faint : ink);
    overlay.add_area({left - 4, y - 5, 220, pitch}, false, [act = entry.act](Real) { act(); });
  }
}

static void add_slider(const WindowSlider& slider, const Rectangle& bar, const std::function<void(Real)>& moved,
                       Overlay& overlay) {
  const Real value = slider.value(), range = std::max(slider.high - slider.low, 1e-12);
  const Real share = std::clamp((value - slider.low) / range, 0.0, 1.0);
  const int thumb = bar.x + static_cast<int>(std::lround(share * bar.width));
  overlay.add_text(bar.x, bar.y + 13, words_of(slider.name), 14, ink);
  overlay.add_text_right(bar.x + bar.width, bar.y + 13,
                         fmt::format("{:.{}f}{}", value + 0.0, range > 2 ? 0 : 2, slider.unit), 14, ink);
  overlay.add_rectangle(bar, Color::Constant(0.76), 1);
  overlay.add_rectangle({bar.x, bar.y, thumb - bar.x, bar.height}, accent, 0.55);
  overlay.add_rectangle({thumb - 4, bar.y - 6, 8, bar.height + 12}, accent, 1);
  overlay.add_area({bar.x - 6, bar.y - 9, bar.width + 12, bar.height + 18}, true, moved, bar);
}

int add_sliders(int left, int top, int bottom, int width, std::size_t& page, const std::vector<WindowSlider>& sliders,
                const std::function<void(std::size_t, Real)>& moved, const std::function<void()>& turned,
                Overlay& overlay) {
  static constexpr int pitch = 36;
  if (sliders.empty()) return top;
  const PageEntries shown = entries_on(page, sliders.size(), (top - bottom - 60) / pitch);
  int y = top;
  for (std::size_t s = shown.begin; s < shown.end; ++s) {
    if (!sliders[s].group.empty() && (s == shown.begin || sliders[s].group != sliders[s - 1].group))
      overlay.add_text(left, y -= 20, sliders[s].group, 13, faint);
    y -= pitch;
    add_slider(
        sliders[s], {left, y + 6, width, 5}, [s, moved](Real share) { moved(s, share); }, overlay);
  }
  return add_page_turner(left, y, width, "sliders", page, shown.pages, turned, overlay);
}

void add_color_bar(const ColorScale& scale, const std::vector<std::string>& ticks, const Rectangle& bar,
                   Overlay& overlay) {
  static constexpr int pieces = 48;
  for (int i = 0; i < pieces; ++i) {
    const int begin = bar.width * i / pieces, end = bar.width * (i + 1) / pieces;
    overlay.add_rectangle({bar.x + begin, bar.y, end - begin, bar.height},
                          color_at(scale, scale.low + (scale.high - scale.low) * i / (pieces - 1)), 1);
  }
  overlay.add_text(bar.x, bar.y + bar.height + 7, scale.title, 15, ink);
  for (std::size_t i = 0; i < ticks.size(); ++i) {
    const int x = bar.x + static_cast<int>(i) * bar.width / static_cast<int>(ticks.size() - 1);
    if (i == 0)
      overlay.add_text(x, bar.y - 17, ticks[i], 13, ink);
    else if (i + 1 == ticks.size())
      overlay.add_text_right(x, bar.y - 17, ticks[i], 13, ink);
    else
      overlay.add_text_centered(x, bar.y - 17, ticks[i], 13, ink);
  }
}

void add_scale_bar(int left, int bottom, Real pixels_per_metre, int most, Overlay& overlay) {
  Real length = 0.001;
  for (const Real each : {0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0})
    if (each * pixels_per_metre <= most) length = each;
  const int width = static_cast<int>(std::lround(length * pixels_per_metre));
  overlay.add_rectangle({left, bottom, width, 3}, ink, 1);
  overlay.add_text_centered(
      left + width / 2, bottom + 8,
      length < 0.01 ? fmt::format("{:.0f} mm", 1000 * length) : fmt::format("{:.0f} cm", 100 * length), 14, ink);
}

void add_help(int width, int height, const std::vector<std::pair<std::string, std::string>>& rows, Overlay& overlay) {
  static constexpr int pitch = 23, column = 400, margin = 24, key_width = 125;
  const int per_column = (static_cast<int>(rows.size()) + 1) / 2;
  const Rectangle sheet{width / 2 - column - margin / 2, height / 2 - (per_column * pitch) / 2 - margin,
                        2 * column + margin, per_column * pitch + 2 * margin};
  overlay.add_rectangle({sheet.x - 1, sheet.y - 1, sheet.width + 2, sheet.height + 2}, Color::Constant(0.6), 1);
  overlay.add_rectangle(sheet, Color::Ones(), 0.97);
  for (int i = 0; i < static_cast<int>(rows.size()); ++i) {
    const int x = sheet.x + margin + column * (i / per_column);
    const int y = sheet.y + sheet.height - margin - pitch * (1 + i % per_column) + 6;
    overlay.add_text(x, y, rows[static_cast<std::size_t>(i)].first, 14, accent);
    overlay.add_text(x + key_width, y, rows[static_cast<std::size_t>(i)].second, 14, ink);
  }
}

}  // namespace gracilis
