#include <gracilis/view/window/run_loader.hpp>

#include <gracilis/core/failure.hpp>
#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/rotations.hpp>
#include <gracilis/view/pictures/recorded_look.hpp>
#include <gracilis/view/pictures/run_picture.hpp>

#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>

namespace gracilis {

/// Surfaces of a frame, read at the same time.
static std::vector<TriangleMesh> read_surfaces(const RecordedRun& run, const std::vector<std::string>& names,
                                               int frame) {
  std::vector<TriangleMesh> surfaces(names.size());
  parallel_for_each(names.size(), [&](std::size_t i) { surfaces[i] = placed_surface(run, names[i], frame); });
  return surfaces;
}

RunLoader::RunLoader(const RecordedRun& run, ShapeHistory& history)
    : run_(run),
      history_(history),
      captions_(captioned_frames(run)),
      has_depth_(static_cast<std::size_t>(run.frame_count)),
      activations_(measure_of(run, "activation")),
      volumes_(measure_of(run, "volume_ratio")),
      milliseconds_(measure_of(run, "milliseconds")) {
  shapes_.title = run.manifest.value("scene", run.folder.filename().string());
  shapes_.axes = run.axes;
  shapes_.left_side = view_direction(run, "lateral").dot(run.axes.right()) < 0;
  shapes_.muscles = run.muscles;
  shapes_.bones = run.bones;
  maker_.emplace(read_surfaces(run, run.muscles, 0), read_surfaces(run, run.bones, 0), shapes_);
  for (std::size_t m = 0; m < run.muscles.size(); ++m) {
    take_tissue(m);
    maker_->paint(m, recorded_look(run, run.muscles[m]), shapes_);
  }
  tensions_ = recorded_tensions(run);
  history_.append(read(0));
  thread_ = std::thread([this] { work(); });
}

void RunLoader::take_tissue(std::size_t muscle) {
  const Points tissue = recorded_tissue(run_, run_.muscles[muscle]);
  if (tissue.cols() == 0) return;
  std::vector<HeldAt> held;
  std::vector<float> belly;
  for (const Vec3 vertex : tissue.colwise()) {
    held.push_back(vertex.x() > 0 ? HeldAt::origin : vertex.y() > 0 ? HeldAt::insertion : HeldAt::nothing);
    belly.push_back(static_cast<float>(vertex.z()));
  }
  shapes_.held[muscle] = maker_->shown_of(muscle, held);
  shapes_.belly[muscle] = maker_->shown_of(muscle, belly);
}

RunLoader::~RunLoader() {
  stop_ = true;
  thread_.join();
}

void RunLoader::work() {
  try {
    for (int frame = 1; frame < run_.frame_count && !stop_; ++frame) history_.append(read(frame));
    while (!stop_) {
      const int frame = history_.requests.contact_depth ? frame_without_depth() : -1;
      if (frame >= 0)
        history_.replace(frame, read(frame));
      else
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  } catch (const std::exception&) {
    // Whatever it is, such as a folder that is gone, what was read stays in sight.
    spdlog::warn("what comes after frame {} cannot be shown: {}", history_.end() - 1, current_failure().text);
  }
}

/// The first one from where somebody looks; -1: all have it.
int RunLoader::frame_without_depth() const {
  const int count = history_.end(), from = history_.requests.frame;
  for (int i = 0; i < count; ++i)
    if (!has_depth_[static_cast<std::size_t>((from + i) % count)]) return (from + i) % count;
  return -1;
}

void RunLoader::fill_forces(int number, ShownFrame& frame) const {
  std::vector<Eigen::VectorXd> stresses, tensions;
  for (std::size_t m = 0; m < run_.muscles.size(); ++m) {
    stresses.push_back(recorded_fiber_stresses(run_, run_.muscles[m], number));
    tensions.emplace_back(number < tensions_[m].rows() ? Eigen::VectorXd(tensions_[m].row(number)) : Eigen::VectorXd());
  }
  maker_->fill_stress(stresses, frame);
  FrameMaker::fill_tension(tensions, frame);
}

ShownFrame RunLoader::read(int number) {
  ShownFrame frame;
  frame.caption = pose_words(captions_, number);
  std::vector<Points> muscles;
  for (TriangleMesh& surface : read_surfaces(run_, run_.muscles, number))
    muscles.push_back(std::move(surface.vertices));
  std::vector<RigidTransform> bones;
  const std::vector<TriangleMesh> moved = read_surfaces(run_, run_.bones, number);
  for (std::size_t b = 0; b < moved.size(); ++b)
    bones.push_back(rigid_motion(maker_->bones()[b].vertices, moved[b].vertices));
  const bool with_depth = history_.requests.contact_depth;
  maker_->fill(muscles, std::move(bones), with_depth, frame);
  has_depth_[static_cast<std::size_t>(number)] = with_depth;
  std::vector<Polylines> fibers;
  for (const std::string& name : run_.muscles) fibers.push_back(placed_fibers(run_, name, number));
  maker_->fill_fibers(fibers, frame);
  fill_forces(number, frame);
  for (Index m = 0; m < static_cast<Index>(run_.muscles.size()); ++m) {
    frame.activation.push_back(activations_.size() > 0 ? activations_(number, m) : 0);
    if (volumes_.size() > 0) frame.volume[static_cast<std::size_t>(m)] = volumes_(number, m);
    if (milliseconds_.size() > 0) frame.milliseconds += milliseconds_(number, m);
  }
  return frame;
}

}  // namespace gracilis
