#pragma once

#include <gracilis/geometry/distance_field.hpp>
#include <gracilis/view/window/shape_history.hpp>

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace gracilis {

/// A value that the user may change while a simulation runs. The functions are called on the window's thread with the
/// value as shown, and must not take long.
struct WindowSlider {
  std::string group;  ///< stands above the first slider of those that share it
  std::string name, unit;
  Real low = 0, high = 1;
  std::function<Real()> value;
  std::function<void(Real)> moved;
};

/// A simulation beside the window. The functions are called on the window's thread and must not take long.
struct LiveControls {
  std::vector<WindowSlider> sliders;
  std::function<void(bool)> pause;
  std::function<bool()> is_paused;
  std::function<void()> step, play_motion, reset, look_again;
  /// Moves the joint of a bone so that a point of it (at rest) comes, as seen along `looking`, to `target`; false where
  /// no joint moves the bone.
  std::function<bool(std::size_t bone, const Vec3& point, const Vec3& target, const Vec3& looking)> pull;
  std::function<std::string()> status;
};

struct WindowOptions {
  int width = 1280, height = 720;
  std::string view = "lateral";      ///< one of view_names()
  std::filesystem::path pictures;    ///< folder that the screenshot key writes to
  std::optional<LiveControls> live;  ///< the window follows the last frame
  int expected_frames = 0;           ///< 0: nobody knows
  Real frames_per_second = 60;       ///< as it happened
  std::vector<std::string> keys;  ///< pressed one after the other as soon as nothing is still to come; "2s": the next
                                  ///< one after 2 seconds, anyway
  Real benchmark = 0;             ///< s; above 0: plays as fast as it can for that long and closes
  std::function<std::vector<DistanceField>()> bone_fields;  ///< called on another thread when they are first needed
};

/// What a window did while it was open.
struct WindowReport {
  Real first_picture = 0;  ///< s from the call to the first picture
  long pictures = 0;       ///< drawn while playing
  Real drawing = 0;        ///< s, to draw them
  Real playing = 0;        ///< s
};

/// Opens a window and returns when the user closes it. Needs a display; throws Error with exit code 4 where there is
/// none. The history has one frame at least; others may come at any time from other threads.
WindowReport show_window(const ShownShapes& shapes, ShapeHistory& history, const WindowOptions& options);

/// Throws Error (exit code 4) where show_window would.
void require_display();

}  // namespace gracilis
