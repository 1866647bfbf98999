#include <gracilis/view/window/arrows.hpp>
#include <gracilis/view/window/viewer.hpp>

#include <vtkActor.h>
#include <vtkActor2D.h>
#include <vtkPolyData.h>
#include <vtkTextActor.h>

#include <algorithm>
#include <array>

namespace gracilis {

static constexpr std::array view_keys = {"anterior", "posterior", "lateral", "medial", "superior", "anteromedial"};

/// The next value of an enumeration of `count`.
template <class Enumeration>
static void turn_to_next(Enumeration& value, int count) {
  value = static_cast<Enumeration>((static_cast<int>(value) + 1) % count);
}

std::vector<KeyBinding> Viewer::bindings() {
  const auto look_at = [this](int i) { return [this, i] { this->look(view_keys[static_cast<std::size_t>(i)]); }; };
  std::vector<KeyBinding> table = {
      {{"space"}, "space", "play, pause", [this] { toggle_play(); }},
      {{"Left"}, "left, right", "one frame back, on", [this] { step(-1); }},
      {{"Right"}, "", "", [this] { step(1); }},
      {{"Prior"}, "page up, down", "ten frames back, on", [this] { step(-10); }},
      {{"Next"}, "", "", [this] { step(10); }},
      {{"Home"}, "home, end", "first, last frame", [this] { jump(history_.begin()); }},
      {{"End"}, "", "", [this] { jump(history_.end() - 1); }},
      {{"j"}, "j 4 5 enter", "jump to frame 45", [this] { frame_number_ = ":"; }},
      {{"less", "comma"}, "< >", "play slower, faster", [this] { player_.change_speed(0.5); }},
      {{"greater", "period"}, "", "", [this] { player_.change_speed(2); }},
      {{"1"}, "1  2", "from anterior, posterior", look_at(0)},
      {{"2"}, "", "", look_at(1)},
      {{"3"}, "3  4", "from lateral, medial", look_at(2)},
      {{"4"}, "", "", look_at(3)},
      {{"5"}, "5  6", "from superior, anteromedial", look_at(4)},
      {{"6"}, "", "", look_at(5)},
      {{"w"},
       "w",
       "fit the whole into the window",
       [this] { fit_all(shapes_, history_, state_, room(), *scene_renderer_); }},
      {{"0"}, "0", "the first view again", [this] { look(options_.view); }},
      {{"c"},
       "c",
       "color by the next quantity",
       [this] { turn_to_next(state_.color_by, window_color_count), update_requests(); }},
      {{"s"}, "s", "surfaces solid, with edges, wireframe", [this] { turn_to_next(state_.style, 3); }},
      {{"b"}, "b", "bones on, off", [this] { state_.bones = !state_.bones; }},
      {{"f"}, "f", "fibers on, off", [this] { state_.fibers = !state_.fibers; }},
      {{"a"}, "a", "attachments on, off", [this] { state_.attachments = !state_.attachments; }},
      {{"g"}, "g", "ghost of the first frame, of earlier ones", [this] { turn_to_next(state_.ghost, 3); }},
      {{"x"}, "x", "slice of the bones' distance field", [this] { turn_to_next(state_.slice, 4); }}};
  if (options_.live) {
    table.push_back({{"v"}, "v", "arrows: what each constraint moved", [this] { next_arrows(); }});
    table.push_back({{"bracketleft"}, "[ ]", "the arrows' inner iteration", [this] { step_iteration(-1); }});
    table.push_back({{"bracketright"}, "", "", [this] { step_iteration(1); }});
    table.push_back({{"m"}, "m", "the scene's own motion", [this] {
                       options_.live->play_motion();
                       follows_ = true;
                     }});
    table.push_back({{"r"}, "r", "back to the capture pose", [this] {
                       options_.live->reset();
                       follows_ = true;
                     }});
  }
  table.push_back({{"p"}, "p", "picture into a file", [this] { take_picture(); }});
  table.push_back({{"question", "h"}, "?", "this help", [this] { help_ = !help_; }});
  table.push_back({{"Escape"}, "", "", [this] { help_ = false; }});
  table.push_back({{"q"}, "q", "close", [this] { interactor_->TerminateApp(); }});
  table.push_back({{}, "mouse", "turn; with shift: move; wheel: zoom", {}});
  if (options_.live) table.push_back({{}, "mouse on a bone", "moves its joint", {}});
  table.push_back({{}, "click a muscle", "numbers of its vertex there", {}});
  table.push_back({{}, "click a name", "solid, see-through, hidden", {}});
  return table;
}

void Viewer::press(const std::string& key) {
  changed_ = relaid_ = true;
  if (!type_frame_number(key)) press_key(bindings_, key);
}

/// While a frame's number is typed, keys belong to it.
bool Viewer::type_frame_number(const std::string& key) {
  if (frame_number_.empty()) return false;
  const std::string digit = key.starts_with("KP_") ? key.substr(3) : key;
  if (digit.size() == 1 && digit[0] >= '0' && digit[0] <= '9' && frame_number_.size() < 8)
    frame_number_ += digit;
  else if (key == "BackSpace" && frame_number_.size() > 1)
    frame_number_.pop_back();
  else if (key == "Return" || key == "KP_Enter") {
    if (frame_number_.size() > 1) jump(std::stoi(frame_number_.substr(1)));
    frame_number_.clear();
  } else
    frame_number_.clear();
  return true;
}

void Viewer::toggle_play() {
  const bool at_end = player_.frame == history_.end() - 1;
  if (options_.live && (follows_ || at_end) && !player_.playing) {
    options_.live->pause(!options_.live->is_paused());
    follows_ = true;
  } else {
    player_.play(!player_.playing, now());
    last_drawn_ = now();
    follows_ = false;
  }
}

void Viewer::step(int frames) {
  if (options_.live && frames > 0 && player_.frame == history_.end() - 1 && options_.live->is_paused()) {
    options_.live->step();
    follows_ = true;
  } else {
    jump(player_.frame + frames);
  }
}

void Viewer::jump(int frame) {
  player_.jump(frame, history_.begin(), history_.end());
  follows_ = options_.live && player_.frame == history_.end() - 1;
}

void Viewer::next_arrows() {
  turn_to_next(state_.arrows, 3);
  update_requests();
}

void Viewer::step_iteration(int by) {
  const int count = iteration_count(*history_.at(player_.frame));
  state_.iteration = std::clamp(state_.iteration + by, 0, std::max(count - 1, 0));
}

void Viewer::update_requests() {
  history_.requests.tension = state_.color_by == WindowColor::tension;
  history_.requests.contact_depth = state_.color_by == WindowColor::contact_depth;
  history_.requests.passes = state_.arrows != Arrows::none;
  if (options_.live && (history_.requests.contact_depth || history_.requests.tension)) options_.live->look_again();
}

void Viewer::cycle_muscle(std::size_t muscle) {
  turn_to_next(state_.muscles[muscle], 3);
  changed_ = relaid_ = true;
}

}  // namespace gracilis
