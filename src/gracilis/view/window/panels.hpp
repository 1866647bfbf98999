#pragma once

#include <gracilis/view/pictures/color_scale.hpp>
#include <gracilis/view/window/overlay.hpp>
#include <gracilis/view/window/window_state.hpp>

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace gracilis {

struct WindowSlider;

/// The colors of texts and marks.
inline const Color ink = Color::Constant(0.1), faint = Color::Constant(0.38), accent(0.04, 0.36, 0.68);

/// The parts that stand over a window's picture. All positions in pixels from the lower left corner.

/// A swatch and a text that can be clicked.
struct ListEntry {
  std::string text;
  Color color;
  Real strength = 1;  ///< of the swatch: 1 full, 0 empty
  std::function<void()> act;
};
/// Where a list's texts begin, from its left end, and their size.
inline constexpr int list_indent = 22, list_text_size = 15;

/// Entries from `top` downwards. Returns where the list ends.
int add_list(int left, int top, const std::vector<ListEntry>& entries, Overlay& overlay);

/// The same; those that would come below `bottom` are on further pages, which `what` and their number name.
int add_paged_list(int left, int top, int bottom, const std::string& what, std::size_t& page,
                   const std::vector<ListEntry>& entries, const std::function<void()>& turned, Overlay& overlay);

/// A key, what it switches, and how that stands.
struct OptionEntry {
  std::string key, name, value;
  std::function<void()> act;
};
/// A line each from `top` downwards: a button with its key, name and value.
void add_options(int left, int top, const std::vector<OptionEntry>& entries, Overlay& overlay);

/// Sliders from `top` downwards; those that would come below `bottom` are on further pages. Returns where they end.
int add_sliders(int left, int top, int bottom, int width, std::size_t& page, const std::vector<WindowSlider>& sliders,
                const std::function<void(std::size_t slider, Real share)>& moved, const std::function<void()>& turned,
                Overlay& overlay);

/// A scale's colors in `bar` with its title above and `ticks` below, at equal distances.
void add_color_bar(const ColorScale& scale, const std::vector<std::string>& ticks, const Rectangle& bar,
                   Overlay& overlay);

/// A line of a round length, at most `most` pixels wide.
void add_scale_bar(int left, int bottom, Real pixels_per_metre, int most, Overlay& overlay);

/// Rows of key and meaning over the middle of a window, in two columns.
void add_help(int width, int height, const std::vector<std::pair<std::string, std::string>>& rows, Overlay& overlay);

/// "hip flexion r" of "hip_flexion_r".
std::string words_of(std::string name);

}  // namespace gracilis
