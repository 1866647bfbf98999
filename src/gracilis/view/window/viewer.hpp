#pragma once

#include <gracilis/view/window/interactive_window.hpp>
#include <gracilis/view/window/key_bindings.hpp>
#include <gracilis/view/window/overlay.hpp>
#include <gracilis/view/window/panels.hpp>
#include <gracilis/view/window/player.hpp>
#include <gracilis/view/window/window_scene.hpp>
#include <gracilis/view/window/window_state.hpp>

#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <chrono>
#include <future>
#include <optional>
#include <string>
#include <vector>

namespace gracilis {

/// The window itself: looks every few milliseconds what is new, and draws when something is.
class Viewer {
 public:
  /// All three must outlive this.
  Viewer(const ShownShapes& shapes, ShapeHistory& history, const WindowOptions& options);

  /// Opens the window and returns when it is closed.
  WindowReport run();

 private:
  // viewer.cpp: what happens when
  void tick();
  void follow_history();
  bool is_waiting() const;
  void press_scripted_keys();
  void run_benchmark();
  void update_slice();
  void draw(bool smooth);
  Real now() const;
  int total_frames() const;
  void take_picture();

  // viewer_mouse.cpp: what the mouse does to shapes
  bool press_mouse(int x, int y);
  bool drag_mouse(int x, int y);
  void release_mouse(int x, int y);
  bool pull_bone(int x, int y);

  // viewer_keys.cpp: what keys do
  std::vector<KeyBinding> bindings();
  void press(const std::string& key);
  bool type_frame_number(const std::string& key);
  void toggle_play();
  void step(int frames);
  void jump(int frame);
  void next_arrows();
  void step_iteration(int by);
  void update_requests();
  void cycle_muscle(std::size_t muscle);

  // viewer_layout.cpp: what stands over the picture
  void lay_out();
  void measure_names();
  void look(const std::string& view);
  void keep_in_view();
  Rectangle room() const;
  void lay_out_left();
  void lay_out_right();
  void lay_out_track();
  void lay_out_directions();
  int lay_out_scale(const ColorScale& scale, const std::vector<std::string>& ticks, int bottom);
  std::vector<OptionEntry> options_shown();
  void write_status();
  void write_speed(const ShownFrame& frame);
  std::string hint() const;

  const ShownShapes& shapes_;
  ShapeHistory& history_;
  const WindowOptions& options_;
  const std::chrono::steady_clock::time_point opened_ = std::chrono::steady_clock::now();

  vtkNew<vtkRenderWindow> window_;
  vtkNew<vtkRenderer> scene_renderer_, flat_renderer_;
  vtkNew<vtkRenderWindowInteractor> interactor_;
  Overlay overlay_{*flat_renderer_};
  std::optional<WindowScene> scene_;
  const std::vector<KeyBinding> bindings_;

  WindowState state_;
  Player player_;
  WindowReport report_;
  std::string view_, frame_number_;  ///< the number that is being typed, after a colon; empty: none
  bool help_ = false, changed_ = true, relaid_ = true, follows_ = false, depth_is_shown_ = false, is_smooth_ = false;
  int width_ = 0, height_ = 0, known_begin_ = 0, known_end_ = 1, picture_ = 0;
  int left_width_ = 0;  ///< pixels that the texts on the left take
  std::string known_status_;
  std::size_t slider_page_ = 0, muscle_page_ = 0;

  struct Grabbed {
    std::size_t bone = 0;
    Vec3 point = Vec3::Zero();  ///< at rest, m
  };
  std::optional<Grabbed> grabbed_;
  Eigen::Vector2i pressed_at_ = Eigen::Vector2i::Zero();
  bool overlay_pressed_ = false;

  std::future<std::vector<DistanceField>> fields_to_come_;
  std::vector<DistanceField> fields_;
  ColoredMesh slice_;

  std::size_t next_key_ = 0;
  Real keys_wait_until_ = 0, benchmark_from_ = -1, draw_seconds_ = 0, last_drawn_ = 0, pictures_per_second_ = 0;

  vtkSmartPointer<vtkTextActor> status_, speed_, picked_;
  vtkSmartPointer<vtkActor2D> cursor_;
  Rectangle track_;
};

}  // namespace gracilis
