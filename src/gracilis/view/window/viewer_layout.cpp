#include <gracilis/view/window/arrows.hpp>
#include <gracilis/view/window/bone_slice.hpp>
#include <gracilis/view/window/picking.hpp>
#include <gracilis/view/window/viewer.hpp>

#include <fmt/format.h>
#include <vtkActor.h>
#include <vtkActor2D.h>
#include <vtkCamera.h>
#include <vtkPolyData.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <gracilis/view/pictures/muscle_colors.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace gracilis {

static const Color background(0.96, 0.965, 0.97);
static constexpr int margin = 16, right_width = 210, options_width = 210, track_height = 66;
static constexpr int words_height = 40;  // above the track: which way is which, and the scale bar

void Viewer::lay_out() {
  width_ = window_->GetSize()[0];
  height_ = window_->GetSize()[1];
  overlay_.clear();
  lay_out_left();
  lay_out_right();
  lay_out_track();
  if (!help_) return;
  overlay_.begin_layer();
  add_help(width_, height_, help_rows(bindings_), overlay_);
}

/// From a standard direction, into the room that the texts leave.
void Viewer::look(const std::string& view) {
  view_ = view;
  look_from(view, shapes_, history_, state_, room(), *scene_renderer_);
}

/// All of them, or the room would change with the list's pages.
void Viewer::measure_names() {
  left_width_ = options_width;
  for (const std::string& name : shapes_.muscles)
    left_width_ = std::max(left_width_, list_indent + overlay_.width_of(words_of(name), list_text_size));
}

/// Between the texts.
Rectangle Viewer::room() const {
  const int* size = window_->GetSize();
  const int left = margin + left_width_ + 10, right = margin + right_width + 10;
  const int bottom = track_height + words_height;
  return {left, bottom, std::max(100, size[0] - left - right), std::max(100, size[1] - bottom - 46)};
}

/// Until somebody turns the camera, what moves out of its room, as a femur under the sliders, gets more of it.
void Viewer::keep_in_view() {
  if (view_.empty() || grabbed_ || is_within(shapes_, *history_.at(player_.frame), state_, room(), *scene_renderer_))
    return;
  look(view_);
  relaid_ = true;
}

static const char* name_of(WindowColor color) {
  static constexpr std::array names = {"natural",      "muscle",        "tissue", "activation", "fiber strain",
                                       "edge stretch", "contact depth", "volume", "stress",     "tension"};
  return names[static_cast<std::size_t>(color)];
}

std::vector<OptionEntry> Viewer::options_shown() {
  static constexpr std::array styles = {"solid", "edges", "wireframe"};
  static constexpr std::array ghosts = {"off", "first frame", "10, 20, 30 earlier"};
  static constexpr std::array slices = {"off", "sagittal", "coronal", "transverse"};
  static constexpr std::array arrows = {"off", "whole frame", "iteration"};
  const auto on = [](bool value) { return std::string(value ? "on" : "off"); };
  const auto of = [](const auto& names, auto value) { return std::string(names[static_cast<std::size_t>(value)]); };
  std::vector<OptionEntry> entries = {{"c", "color", name_of(state_.color_by), {}},
                                      {"s", "surface", of(styles, state_.style), {}},
                                      {"b", "bones", on(state_.bones), {}},
                                      {"f", "fibers", on(state_.fibers), {}},
                                      {"a", "attachments", on(state_.attachments), {}},
                                      {"g", "ghost", of(ghosts, state_.ghost), {}},
                                      {"x", "slice", of(slices, state_.slice), {}}};
  if (options_.live) {
    std::string which = of(arrows, state_.arrows);
    if (state_.arrows == Arrows::iteration)
      which += fmt::format(" {} of {}", state_.iteration + 1, iteration_count(*history_.at(player_.frame)));
    entries.push_back({"v", "arrows", which, {}});
  }
  for (OptionEntry& entry : entries) entry.act = [this, key = entry.key] { press(key); };
  entries.push_back({"?", "help", "", [this] { press("question"); }});
  return entries;
}

void Viewer::lay_out_left() {
  overlay_.add_text(margin, height_ - 32, words_of(shapes_.title), 19, ink);
  std::vector<ListEntry> muscles;
  for (std::size_t m = 0; m < shapes_.muscles.size(); ++m) {
    const MuscleState shown = state_.muscles[m];
    // Where colors do not tell which muscle it is, those here would only confuse.
    const Color color =
        state_.color_by == WindowColor::muscle ? muscle_color(shapes_.muscles[m]) : Color(Color::Constant(0.6));
    muscles.push_back({words_of(shapes_.muscles[m]), color,
                       shown == MuscleState::solid         ? 1
                       : shown == MuscleState::transparent ? 0.35
                                                           : 0,
                       [this, m] { cycle_muscle(m); }});
  }
  const std::vector<OptionEntry> entries = options_shown();
  static constexpr int numbers_height = 90;  // of what a click on a muscle tells
  const int options_height = 20 * static_cast<int>(entries.size()) + 16;
  const int below = track_height + words_height + (state_.picked ? numbers_height : 0);
  const int end = add_paged_list(
      margin, height_ - 46, below + options_height + 10, "muscles", muscle_page_, muscles,
      [this] { changed_ = relaid_ = true; }, overlay_);
  add_options(margin, end - 14, entries, overlay_);
  picked_ = nullptr;
  if (!state_.picked) return;
  picked_ = overlay_.add_text(margin, end - options_height - 10, "", 13, ink);
  picked_->GetTextProperty()->SetVerticalJustificationToTop();
}

/// A scale above `bottom`; returns the next free height.
int Viewer::lay_out_scale(const ColorScale& scale, const std::vector<std::string>& ticks, int bottom) {
  const Rectangle bar{width_ - margin - right_width, bottom + 20, right_width, 12};
  add_color_bar(scale, ticks, bar, overlay_);
  return bottom + 66;
}

void Viewer::lay_out_right() {
  const int left = width_ - margin - right_width;
  // What lies behind the panel steps back; it costs time, so only where there is a panel.
  const bool explains = state_.color_by != WindowColor::natural && state_.color_by != WindowColor::muscle;
  const bool has_panel = options_.live || explains || state_.attachments || state_.slice != Slice::none;
  if (has_panel)
    overlay_.add_rectangle({left - 10, track_height, right_width + margin + 10, height_ - track_height}, background,
                           0.7);
  int bottom = track_height + 8;
  if (const ColorScale& scale = window_scale(state_.color_by); !scale.colors.empty())
    bottom = lay_out_scale(scale, scene_->ticks(state_.color_by), bottom);
  if (state_.color_by == WindowColor::tissue || state_.attachments) {
    std::vector<ListEntry> entries;
    for (const TissueColor& tissue : tissue_colors()) entries.push_back({tissue.name, tissue.color, 1, [] {}});
    if (state_.color_by != WindowColor::tissue) entries.erase(entries.begin(), entries.begin() + 2);
    add_list(left, bottom + 22 * static_cast<int>(entries.size()) + 4, entries, overlay_);
    bottom += 22 * static_cast<int>(entries.size()) + 12;
  }
  if (state_.slice != Slice::none) bottom = lay_out_scale(slice_scale(), slice_scale().ticks, bottom);
  if (state_.arrows != Arrows::none) {
    std::vector<ListEntry> entries;
    for (const ConstraintRow& row : constraint_table())
      entries.push_back({row.name, arrow_color(row.kind),
                         state_.arrow_kinds[static_cast<std::size_t>(row.kind)] ? 1.0 : 0.0, [this, kind = row.kind] {
                           const auto place = static_cast<std::size_t>(kind);
                           state_.arrow_kinds[place] = !state_.arrow_kinds[place];
                           changed_ = relaid_ = true;
                         }});
    const int height = 22 * static_cast<int>(entries.size());
    add_list(left, bottom + height + 4, entries, overlay_);
    overlay_.add_text(left, bottom + height + 10, fmt::format("moved by, {:g} times as long", scene_->arrow_scale()),
                      15, ink);
    bottom += height + 36;
  }

  int top = height_ - 18;
  if (state_.slice != Slice::none) {
    const std::vector<WindowSlider> one = {{"", "slice at", "", 0, 1, [this] { return state_.slice_at; }, {}}};
    std::size_t page = 0;
    top = add_sliders(
        left, top, bottom, right_width, page, one,
        [this](std::size_t, Real share) {
          state_.slice_at = share;
          changed_ = relaid_ = true;
        },
        {}, overlay_);
  }
  if (!options_.live) return;
  add_sliders(
      left, top, bottom, right_width, slider_page_, options_.live->sliders,
      [this](std::size_t s, Real share) {
        const WindowSlider& slider = options_.live->sliders[s];
        slider.moved(slider.low + share * (slider.high - slider.low));
        follows_ = changed_ = relaid_ = true;  // who moves a slider wants to see what comes of it
        player_.playing = false;
      },
      [this] { changed_ = relaid_ = true; }, overlay_);
}

void Viewer::lay_out_track() {
  const bool runs = player_.playing || (options_.live && follows_ && !options_.live->is_paused());
  const int y = 20;
  overlay_.add_rectangle({0, 0, width_, track_height}, background, 0.8);
  if (runs) {
    overlay_.add_rectangle({margin + 2, y - 5, 5, 16}, ink);
    overlay_.add_rectangle({margin + 11, y - 5, 5, 16}, ink);
  } else {
    overlay_.add_triangle({margin + 2, y - 5, 15, 16}, ink);
  }
  overlay_.add_area({margin - 6, 8, 32, 32}, false, [this](Real) { press("space"); });
  track_ = {margin + 40, y, width_ - 2 * margin - 46, 6};
  overlay_.add_rectangle(track_, Color::Constant(0.85));
  const Real there = static_cast<Real>(history_.end()) / std::max(1, total_frames());
  overlay_.add_rectangle({track_.x, track_.y, static_cast<int>(track_.width * std::min(there, 1.0)), track_.height},
                         Color::Constant(0.62));
  cursor_ = overlay_.add_mark({track_.x, track_.y - 7, 6, 20}, accent);
  overlay_.add_area(
      {track_.x - 8, track_.y - 14, track_.width + 16, 34}, true,
      [this](Real at) {
        const int begin = history_.begin();
        jump(begin + static_cast<int>(std::lround(at * (total_frames() - 1 - begin))));
        changed_ = relaid_ = true;
      },
      track_);
  status_ = overlay_.add_text(margin, 46, "", 16, ink);
  speed_ = overlay_.add_text_right(width_ - margin, 46, "", 14, faint);
  const Real pixels_per_metre = height_ / (2 * scene_renderer_->GetActiveCamera()->GetParallelScale());
  add_scale_bar(margin, track_height + 14, pixels_per_metre, 150, overlay_);
  lay_out_directions();
}

/// "anterior" for what lies to the right in the picture, and so on, or two words where it lies between two.
static std::string direction_word(const Vec3& direction, const AnatomicalAxes& axes) {
  const std::array<std::pair<const char*, Vec3>, 6> words = {{{"anterior", axes.anterior},
                                                              {"posterior", -axes.anterior},
                                                              {"superior", axes.superior},
                                                              {"inferior", -axes.superior},
                                                              {"subject's right", axes.right()},
                                                              {"subject's left", -axes.right()}}};
  std::string text;
  for (const auto& [word, axis] : words)
    if (direction.dot(axis) > std::sin(radians(25))) text += (text.empty() ? "" : ", ") + std::string(word);
  return text;
}

/// Which way is which, as at the edges of a radiograph; below what is shown, so that no word lies over a muscle.
void Viewer::lay_out_directions() {
  static constexpr int size = 14;
  double up[3], back[3];
  scene_renderer_->GetActiveCamera()->GetViewUp(up);
  scene_renderer_->GetActiveCamera()->GetDirectionOfProjection(back);
  const Vec3 looking(back), above = (Vec3(up) - Vec3(up).dot(looking) * looking).normalized();
  const Vec3 right = looking.cross(above);
  const auto word = [&](const Vec3& direction) { return direction_word(direction, shapes_.axes); };
  const int left_end = margin + left_width_ + 14, right_end = width_ - margin - right_width - 14;
  const int y = track_height + 14, half = overlay_.width_of(word(-above), size) / 2;
  overlay_.add_text(left_end, y, word(-right), size, faint);
  overlay_.add_text_right(right_end, y, word(right), size, faint);
  overlay_.add_text_centered(width_ / 2, height_ - 24, word(above), size, faint);
  const bool has_room = left_end + overlay_.width_of(word(-right), size) < width_ / 2 - half - 8 &&
                        width_ / 2 + half + 8 < right_end - overlay_.width_of(word(right), size);
  if (has_room) overlay_.add_text_centered(width_ / 2, y, word(-above), size, faint);
}

template <class Values>
static bool none_known(const std::vector<Values>& of_muscles) {
  return std::all_of(of_muscles.begin(), of_muscles.end(), [](const Values& each) { return each.empty(); });
}

/// What the user should know before anything else; empty: nothing.
std::string Viewer::hint() const {
  if (!frame_number_.empty()) return "jump to frame " + frame_number_.substr(1) + "_";
  const std::shared_ptr<const ShownFrame> frame = history_.at(player_.frame);
  if (state_.slice != Slice::none && fields_.empty())
    return options_.bone_fields ? "building the bones' distance fields ..." : "no bones to slice";
  if (state_.color_by == WindowColor::contact_depth && frame->contact_depth.empty()) return "contact depth comes ...";
  if (state_.color_by == WindowColor::stress && none_known(frame->stress)) return "this method knows no forces";
  if (state_.color_by == WindowColor::tension && none_known(frame->tension)) return "this method knows no forces";
  if (state_.arrows != Arrows::none && frame->passes.empty()) return "arrows are there from the next step on";
  const bool knows_tissue =
      std::any_of(shapes_.belly.begin(), shapes_.belly.end(), [](const auto& b) { return !b.empty(); });
  if ((state_.attachments || state_.color_by == WindowColor::tissue) && !knows_tissue)
    return "this run does not tell its attachments; run it again to see them";
  if (history_.end() < options_.expected_frames)
    return fmt::format("reading, {} of {} frames", history_.end(), options_.expected_frames);
  return options_.live ? options_.live->status() : "";
}

/// Says as much of the speed as there is room for beside the status.
void Viewer::write_speed(const ShownFrame& frame) {
  const auto width_of = [this](vtkTextActor& text) {
    std::array<double, 2> size{};
    text.GetSize(flat_renderer_, size.data());
    return size[0];
  };
  std::string drawn = fmt::format("drawn in {:.0f} ms", 1000 * draw_seconds_);
  if (player_.playing) drawn += fmt::format(", {:.0f} frames per second", pictures_per_second_);
  std::string all = player_.playing ? fmt::format("{}, {:g} × as fast", drawn, player_.speed) : drawn;
  if (frame.milliseconds > 0) all = fmt::format("solved in {:.0f} ms, ", frame.milliseconds) + all;
  const double room = width_ - 3 * margin - width_of(*status_);
  for (const std::string& text : {all, drawn, std::string()}) {
    speed_->SetInput(text.c_str());
    if (text.empty() || width_of(*speed_) <= room) return;
  }
}

void Viewer::write_status() {
  const std::shared_ptr<const ShownFrame> frame = history_.at(player_.frame);
  const std::string hint_text = hint();
  status_->SetInput(fmt::format("frame {} of {}    {}{}{}", player_.frame, total_frames() - 1, frame->caption,
                                hint_text.empty() ? "" : "    ", hint_text)
                        .c_str());
  if (picked_) picked_->SetInput(numbers_of(*state_.picked, shapes_, *frame).c_str());
  write_speed(*frame);
  const int begin = history_.begin();
  const Real share = static_cast<Real>(player_.frame - begin) / std::max(1, total_frames() - 1 - begin);
  cursor_->SetPosition(track_.x + share * track_.width - 3, track_.y - 7);
}

}  // namespace gracilis
