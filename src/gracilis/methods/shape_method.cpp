#include <gracilis/methods/shape_method.hpp>

#include <gracilis/anatomy/attachments/muscle_bodies.hpp>
#include <gracilis/core/errors.hpp>
#include <gracilis/core/parallel.hpp>

#include <chrono>
#include <utility>

namespace gracilis {

namespace {

class ShapeMethod final : public DeformationMethod {
 public:
  ShapeMethod(const Scene& scene, std::vector<DistanceField> fields, const ShapedMuscleMaker& make, std::string advice)
      : fields_(std::move(fields)),
        body_count_(scene.bodies.size()),
        advice_(std::move(advice)),
        groups_(hosts_first(scene)),
        carried_(carried_bodies(scene)),
        muscles_(scene.muscles.size()) {
    parallel_for_each(muscles_.size(), [&](std::size_t m) { muscles_[m] = make(scene, scene.muscles[m], fields_); });
    reset();
  }

  void reset() override {
    shapes_.clear();
    for (const ShapedMuscle& muscle : muscles_) shapes_.push_back(muscle.rest);
    pose_ = capture_pose(body_count_);
  }

  StepReport advance(const Pose& asked, Real) override {
    StepReport report;
    report.muscles.resize(muscles_.size());
    std::vector<Points> next(muscles_.size());
    Pose pose = asked;
    for (const std::vector<std::size_t>& group : groups_) {
      for (const std::size_t m : group) next[m] = step(m, pose, report.muscles[m]);
      place_carried_bodies(
          carried_, group, [&](std::size_t m) { return &next[m]; }, pose);
    }
    shapes_ = std::move(next);
    pose_ = std::move(pose);
    return report;
  }

  void write(Frame& frame) const override {
    frame.muscles.clear();
    for (const Points& shape : shapes_) frame.muscles.push_back({shape});
  }

  void restore(const std::vector<Pose>& poses, const Frame&, const Frame& last) override {
    for (std::size_t m = 0; m < shapes_.size(); ++m) shapes_[m] = last.muscles[m].points;
    pose_ = poses.back();
    for (const std::vector<std::size_t>& group : groups_)
      place_carried_bodies(
          carried_, group, [&](std::size_t m) { return &shapes_[m]; }, pose_);
  }

 private:
  Points step(std::size_t m, const Pose& pose, MuscleReport& report) const {
    const auto started = std::chrono::steady_clock::now();
    ShapeStep done = muscles_[m].step(pose_, pose, shapes_[m]);
    const std::chrono::duration<Real, std::milli> taken = std::chrono::steady_clock::now() - started;
    report = {taken.count(), std::move(done.metrics)};
    if (!done.points.allFinite())
      throw QualityError("muscle " + muscles_[m].name + ": a vertex position is not finite; " + advice_);
    return std::move(done.points);
  }

  std::vector<DistanceField> fields_;
  std::size_t body_count_;
  std::string advice_;
  std::vector<std::vector<std::size_t>> groups_;  ///< of muscles, hosts first
  std::vector<CarriedBody> carried_;
  std::vector<ShapedMuscle> muscles_;
  std::vector<Points> shapes_;
  Pose pose_;  ///< of the shapes
};

}  // namespace

std::unique_ptr<DeformationMethod> shape_method(const Scene& scene, std::vector<DistanceField> fields,
                                                const ShapedMuscleMaker& make, std::string advice) {
  return std::make_unique<ShapeMethod>(scene, std::move(fields), make, std::move(advice));
}

}  // namespace gracilis
