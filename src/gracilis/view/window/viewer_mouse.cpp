#include <gracilis/view/window/picking.hpp>
#include <gracilis/view/window/viewer.hpp>

#include <vtkActor.h>
#include <vtkActor2D.h>
#include <vtkPolyData.h>
#include <vtkTextActor.h>

namespace gracilis {

/// Controls come first; in a live scene a bone that a joint moves can be grabbed; else the mouse turns the camera.
bool Viewer::press_mouse(int x, int y) {
  pressed_at_ = {x, y};
  overlay_pressed_ = overlay_.press(x, y);
  if (overlay_pressed_ || !options_.live) return overlay_pressed_;
  const std::shared_ptr<const ShownFrame> frame = history_.at(player_.frame);
  const std::optional<SurfaceHit> hit = surface_at(x, y, shapes_, *frame, state_, projection_of(*scene_renderer_));
  if (!hit || !hit->is_bone) return false;
  grabbed_ = Grabbed{hit->number, frame->bones[hit->number].inverse() * hit->place};
  if (pull_bone(x, y)) return true;
  grabbed_.reset();
  return false;
}

bool Viewer::drag_mouse(int x, int y) {
  if (!grabbed_) return overlay_.drag(x);
  pull_bone(x, y);
  return true;
}

/// A click where nothing was turned picks a muscle's vertex, or lets go of it beside all muscles.
void Viewer::release_mouse(int x, int y) {
  overlay_.release();
  constexpr int still = 3;  // pixels
  const bool clicked = (Eigen::Vector2i(x, y) - pressed_at_).cwiseAbs().maxCoeff() < still;
  if (clicked && !overlay_pressed_ && !grabbed_) {
    state_.picked.reset();
    const std::optional<SurfaceHit> hit =
        surface_at(x, y, shapes_, *history_.at(player_.frame), state_, projection_of(*scene_renderer_));
    if (hit && !hit->is_bone) state_.picked = PickedVertex{hit->number, hit->vertex};
    changed_ = relaid_ = true;
  }
  grabbed_.reset();
  overlay_pressed_ = false;
}

bool Viewer::pull_bone(int x, int y) {
  const WindowProjection projection = projection_of(*scene_renderer_);
  const Vec3 target = projection.in_world({Real(x), Real(y), 0}), looking = -projection.axes.col(2);
  if (!options_.live->pull(grabbed_->bone, grabbed_->point, target, looking)) return false;
  follows_ = changed_ = relaid_ = true;
  player_.playing = false;
  return true;
}

}  // namespace gracilis
