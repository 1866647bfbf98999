#include <gracilis/view/window/viewer.hpp>

#include <gracilis/io/value_reader.hpp>
#include <gracilis/view/pictures/picture_renderer.hpp>
#include <gracilis/view/window/arrows.hpp>
#include <gracilis/view/window/bone_slice.hpp>
#include <gracilis/view/window/window_style.hpp>

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <vtkActor.h>
#include <vtkActor2D.h>
#include <vtkAutoInit.h>
#include <vtkCallbackCommand.h>
#include <vtkInteractorStyle.h>
#include <vtkPNGWriter.h>
#include <vtkPolyData.h>
#include <vtkTextActor.h>
#include <vtkWindowToImageFilter.h>

#include <algorithm>

// These two are of the window alone, and not among the modules that CMake initializes for everything.
VTK_MODULE_INIT(vtkRenderingUI)
VTK_MODULE_INIT(vtkInteractionStyle)

namespace gracilis {

static constexpr unsigned long tick_milliseconds = 4;
static constexpr Real still_seconds = 0.2;

Viewer::Viewer(const ShownShapes& shapes, ShapeHistory& history, const WindowOptions& options)
    : shapes_(shapes), history_(history), options_(options), bindings_(bindings()), view_(options.view) {
  state_.muscles.assign(shapes.muscles.size(), MuscleState::solid);
  state_.arrow_kinds.assign(static_cast<std::size_t>(ConstraintKind::bone_contact) + 1, true);
  player_.frames_per_second = options.frames_per_second;
  player_.loops = !options.live;
  follows_ = options.live.has_value();
  window_->SetSize(options.width, options.height);
  window_->SetWindowName(("Gracilis: " + shapes.title).c_str());
  window_->SetNumberOfLayers(2);
  window_->SetMultiSamples(0);
  scene_renderer_->SetBackground(0.96, 0.965, 0.97);
  scene_renderer_->AutomaticLightCreationOff();
  add_camera_lights(*scene_renderer_);
  flat_renderer_->SetLayer(1);
  flat_renderer_->InteractiveOff();
  window_->AddRenderer(scene_renderer_);
  window_->AddRenderer(flat_renderer_);
  interactor_->SetRenderWindow(window_);
  interactor_->SetInteractorStyle(make_window_style(
      {[this](int x, int y) { return press_mouse(x, y); }, [this](int x, int y) { return drag_mouse(x, y); },
       [this](int x, int y) { release_mouse(x, y); }, [this](const std::string& key) { press(key); },
       [this] { view_.clear(), changed_ = relaid_ = true; }}));
  scene_.emplace(shapes, history, *scene_renderer_);
}

Real Viewer::now() const { return std::chrono::duration<Real>(std::chrono::steady_clock::now() - opened_).count(); }

int Viewer::total_frames() const { return std::max(options_.expected_frames, history_.end()); }

WindowReport Viewer::run() {
  interactor_->Initialize();
  measure_names();
  look(view_);
  draw(true);
  report_.first_picture = now();
  vtkNew<vtkCallbackCommand> tick;
  tick->SetClientData(this);
  tick->SetCallback([](vtkObject*, unsigned long, void* self, void*) { static_cast<Viewer*>(self)->tick(); });
  interactor_->AddObserver(vtkCommand::TimerEvent, tick);
  // Whoever wants a picture, mouse or X, gets it with the next tick.
  interactor_->EnableRenderOff();
  vtkNew<vtkCallbackCommand> change;
  change->SetClientData(this);
  change->SetCallback(
      [](vtkObject*, unsigned long, void* self, void*) { static_cast<Viewer*>(self)->changed_ = true; });
  interactor_->AddObserver(vtkCommand::RenderEvent, change);
  interactor_->CreateRepeatingTimer(tick_milliseconds);
  interactor_->Start();
  return report_;
}

/// Everything that may have changed since the last picture.
void Viewer::tick() {
  const int* size = window_->GetSize();
  if (size[0] != width_ || size[1] != height_) changed_ = relaid_ = true;
  follow_history();
  press_scripted_keys();
  const bool was_playing = player_.playing;
  if (options_.benchmark > 0)
    run_benchmark();
  else if (player_.advance(now(), history_.begin(), history_.end()))
    changed_ = true;
  if (was_playing && !player_.playing) follows_ = options_.live.has_value(), changed_ = relaid_ = true;
  update_slice();
  if (changed_)
    draw(false);
  else if (!is_smooth_ && now() - last_drawn_ > still_seconds)
    draw(true);
}

/// New frames, and what a simulation says of itself.
void Viewer::follow_history() {
  const int begin = history_.begin(), end = history_.end();
  if (begin != known_begin_ || end != known_end_) {
    known_begin_ = begin, known_end_ = end;
    if (follows_) player_.frame = end - 1, changed_ = true;
    player_.frame = std::max(player_.frame, begin);
    // The track grows; often enough is when one sees it.
    if (options_.live || end == options_.expected_frames || end % 16 == 0) changed_ = relaid_ = true;
  }
  if (options_.live && options_.live->status() != known_status_) {
    known_status_ = options_.live->status();
    changed_ = relaid_ = true;
  }
  // What was wished for arrives later.
  const bool waits_for_depth = state_.color_by == WindowColor::contact_depth && !depth_is_shown_;
  if (waits_for_depth && !history_.at(player_.frame)->contact_depth.empty()) changed_ = true;
  history_.requests.frame = player_.frame;
}

/// True while something that was asked for is still to come.
bool Viewer::is_waiting() const {
  if (history_.end() < options_.expected_frames) return true;
  if (state_.slice != Slice::none && fields_.empty() && options_.bone_fields) return true;
  const bool lacks_depth =
      state_.color_by == WindowColor::contact_depth && history_.at(player_.frame)->contact_depth.empty();
  if (!options_.live) return lacks_depth;
  return (options_.live->status() == "preparing" || options_.live->status() == "moving");
}

/// Keys are pressed when nothing is still to come, or after a given time.
void Viewer::press_scripted_keys() {
  while (next_key_ < options_.keys.size() && now() >= keys_wait_until_ && (keys_wait_until_ > 0 || !is_waiting())) {
    const std::string& key = options_.keys[next_key_++];
    keys_wait_until_ = 0;
    Real seconds = 0;
    const bool is_wait = key.ends_with('s') && key.find_first_not_of("0123456789.") == key.size() - 1;
    if (is_wait && parse_number(std::string_view(key).substr(0, key.size() - 1), seconds))
      keys_wait_until_ = now() + seconds;
    else
      press(key);
  }
}

/// All frames one after the other, each drawn as soon as the one before is.
void Viewer::run_benchmark() {
  if (history_.end() < options_.expected_frames) return;
  if (benchmark_from_ < 0) benchmark_from_ = last_drawn_ = now();
  player_.playing = changed_ = true;
  player_.frame = (player_.frame + 1) % history_.end();
  if (now() - benchmark_from_ >= options_.benchmark) interactor_->TerminateApp();
}

void Viewer::update_slice() {
  if (state_.slice == Slice::none || !options_.bone_fields) return;
  if (fields_.empty() && !fields_to_come_.valid())
    fields_to_come_ = std::async(std::launch::async, options_.bone_fields);
  if (fields_.empty() && fields_to_come_.wait_for(std::chrono::seconds(0)) == std::future_status::ready) {
    fields_ = fields_to_come_.get();
    changed_ = relaid_ = true;
  }
}

/// Smooth edges and all layers of what one sees through cost more than all the rest, so they come when nothing moves.
void Viewer::draw(bool smooth) {
  const Real begin = now();
  is_smooth_ = smooth;
  scene_renderer_->SetUseFXAA(smooth);
  keep_in_view();
  const std::shared_ptr<const ShownFrame> frame = history_.at(player_.frame);
  depth_is_shown_ = !frame->contact_depth.empty();
  if (state_.slice != Slice::none) slice_ = bone_slice(shapes_, *frame, fields_, state_.slice, state_.slice_at);
  const std::vector<std::string> ticks = scene_->ticks(state_.color_by);
  scene_->show(player_.frame, state_, slice_, !smooth);
  // A scale says that values go beyond it as soon as some do.
  if (relaid_ || scene_->ticks(state_.color_by) != ticks) lay_out();
  write_status();
  scene_renderer_->ResetCameraClippingRange();
  window_->Render();
  if (!smooth) draw_seconds_ = now() - begin;
  if (player_.playing) {
    ++report_.pictures;
    report_.drawing += draw_seconds_;
    const Real since = now() - last_drawn_;
    report_.playing += since;
    const Real rate = 1 / std::max(since, 1e-4);
    pictures_per_second_ = pictures_per_second_ > 0 ? 0.9 * pictures_per_second_ + 0.1 * rate : rate;
  }
  last_drawn_ = now();
  changed_ = relaid_ = false;
}

void Viewer::take_picture() {
  relaid_ = true;
  draw(true);
  vtkNew<vtkWindowToImageFilter> filter;
  filter->SetInput(window_);
  filter->ReadFrontBufferOff();
  filter->ShouldRerenderOff();
  vtkNew<vtkPNGWriter> writer;
  std::filesystem::path path;
  do path = options_.pictures / fmt::format("gracilis_{:04}.png", ++picture_);
  while (std::filesystem::exists(path));
  writer->SetFileName(path.c_str());
  writer->SetInputConnection(filter->GetOutputPort());
  writer->Write();
  spdlog::info("picture: {}", path.string());
}

}  // namespace gracilis
