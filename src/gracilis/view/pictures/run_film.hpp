#pragma once

#include <gracilis/view/pictures/run_picture.hpp>

#include <functional>
#include <future>
#include <vector>

namespace gracilis {

/// Images of a run's frames one after the other: the camera stands still, and all have one size. What shapes need is
/// read while the last image is drawn.
class RunFilm {
 public:
  /// Frames `first`, `first` + `step` ... of the first run. `finish` says what else pictures need, such as a size.
  /// Runs and painters must outlive this. Preconditions: `first` is a frame of the first run, `step` > 0.
  RunFilm(const std::vector<RecordedRun>& runs, const std::vector<RunPainter>& painters,
          const RunPictureOptions& options, int first, int step, std::function<void(Picture&)> finish);
  ~RunFilm();
  RunFilm(const RunFilm&) = delete;
  RunFilm& operator=(const RunFilm&) = delete;

  int count() const { return count_; }  ///< of pictures
  /// Precondition: 0 <= i < count(). Throws as run_picture and PictureDrawer do.
  PixelImage image(int i);

 private:
  Picture picture(int i) const;

  const std::vector<RecordedRun>& runs_;
  const std::vector<RunPainter>& painters_;
  const RunPictureOptions& options_;
  int first_, step_, count_;
  std::function<void(Picture&)> finish_;
  std::vector<Points> rooms_;  ///< per run
  PictureDrawer drawer_;
  std::future<Picture> next_;  ///< of image `next_image_`
  int next_image_ = -1;
};

}  // namespace gracilis
