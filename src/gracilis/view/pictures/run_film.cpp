#include <gracilis/view/pictures/run_film.hpp>

#include <algorithm>
#include <utility>

namespace gracilis {

RunFilm::RunFilm(const std::vector<RecordedRun>& runs, const std::vector<RunPainter>& painters,
                 const RunPictureOptions& options, int first, int step, std::function<void(Picture&)> finish)
    : runs_(runs),
      painters_(painters),
      options_(options),
      first_(first),
      step_(step),
      count_((runs[0].frame_count - first + step - 1) / step),
      finish_(std::move(finish)) {
  for (std::size_t r = 0; r < runs.size(); ++r)
    rooms_.push_back(painters[r].room(std::min(first, runs[r].frame_count - 1)));
}

RunFilm::~RunFilm() {
  if (next_.valid()) next_.wait();
}

Picture RunFilm::picture(int i) const {
  Picture picture = run_picture(runs_, painters_, {first_ + i * step_}, options_);
  // A panel per run. What a single frame needs would move the camera and change the image's size.
  for (std::size_t p = 0; p < picture.panels.size(); ++p) {
    Panel& panel = picture.panels[p];
    panel.room = rooms_[p];
    for (PaintedSurface& surface : panel.surfaces) surface.framed = false;
    for (PaintedLines& lines : panel.lines) lines.framed = false;
  }
  finish_(picture);
  return picture;
}

PixelImage RunFilm::image(int i) {
  const bool is_ready = next_.valid() && next_image_ == i;
  if (next_.valid() && !is_ready) next_.wait(), next_ = {};  // painters work for one picture at a time
  const Picture now = is_ready ? next_.get() : picture(i);
  next_image_ = i + 1;
  if (next_image_ < count_)
    next_ = std::async(std::launch::async, [this, next = next_image_] { return picture(next); });
  return drawer_.draw(now);
}

}  // namespace gracilis
