#include <gracilis/methods/placed_method.hpp>

#include <gracilis/scene/scene_place.hpp>

#include <utility>

namespace gracilis {

namespace {

Pose shifted(Pose pose, const Vec3& by) {
  for (RigidTransform& body : pose.bodies) body = Eigen::Translation3d(by) * body * Eigen::Translation3d(-by);
  return pose;
}

void shift_shapes(Frame& frame, const Vec3& by) {
  for (MuscleShape& shape : frame.muscles) {
    shape.points.colwise() += by;
    shape.fibers.points.colwise() += by;
  }
}

Frame shifted(Frame frame, const Vec3& by) {
  frame.pose = shifted(std::move(frame.pose), by);
  shift_shapes(frame, by);
  return frame;
}

class PlacedMethod final : public DeformationMethod {
 public:
  PlacedMethod(const Vec3& place, std::unique_ptr<DeformationMethod> method)
      : place_(place), method_(std::move(method)) {}

  void reset() override { method_->reset(); }
  StepReport advance(const Pose& pose, Real time_step) override {
    return method_->advance(shifted(pose, -place_), time_step);
  }
  bool depends_on_clock() const override { return method_->depends_on_clock(); }
  std::string remark() const override { return method_->remark(); }

  std::vector<FiberActions> fiber_actions(const std::vector<std::vector<Twist>>& coordinates) const override {
    std::vector<FiberActions> actions = method_->fiber_actions(near(coordinates));
    for (FiberActions& muscle : actions)
      for (Index body = 0; body < muscle.wrenches.cols(); ++body)
        muscle.wrenches.col(body).tail<3>() += place_.cross(Vec3(muscle.wrenches.col(body).head<3>()));
    return actions;
  }
  std::vector<MuscleForces> muscle_forces(const std::vector<std::vector<Twist>>& coordinates) const override {
    std::vector<MuscleForces> forces = method_->muscle_forces(near(coordinates));
    for (MuscleForces& muscle : forces)
      for (std::vector<ForceOn>* list :
           {&muscle.origin, &muscle.insertion, &muscle.fascia, &muscle.contact, &muscle.muscles})
        for (ForceOn& each : *list) each.wrench.moment += place_.cross(each.wrench.force);
    return forces;
  }

  PassTracing* pass_tracing() override { return method_->pass_tracing(); }  // passes tell of motion, not of places

  void write(Frame& frame) const override {
    method_->write(frame);
    shift_shapes(frame, place_);
  }

  void give_lengths_and_arms() override { method_->give_lengths_and_arms(); }

  void restore(const std::vector<Pose>& poses, const Frame& before, const Frame& last) override {
    std::vector<Pose> near;
    for (const Pose& pose : poses) near.push_back(shifted(pose, -place_));
    method_->restore(near, shifted(before, -place_), shifted(last, -place_));
  }

 private:
  /// As the method near the origin sees how bodies move.
  std::vector<std::vector<Twist>> near(std::vector<std::vector<Twist>> coordinates) const {
    for (std::vector<Twist>& bodies : coordinates)
      for (Twist& twist : bodies) twist.velocity = twist.velocity_at(place_);
    return coordinates;
  }

  Vec3 place_;
  std::unique_ptr<DeformationMethod> method_;
};

}  // namespace

std::unique_ptr<DeformationMethod> placed_method(const Vec3& place, std::unique_ptr<DeformationMethod> method) {
  return std::make_unique<PlacedMethod>(place, std::move(method));
}

std::unique_ptr<DeformationMethod> made_near_origin(
    const Scene& scene, std::vector<DistanceField> fields,
    const std::function<std::unique_ptr<DeformationMethod>(const Scene&, std::vector<DistanceField>)>& make) {
  const Vec3 place = place_of(scene);
  if (place.isZero()) return make(scene, std::move(fields));
  for (DistanceField& field : fields) field.origin -= place;
  return placed_method(place, make(shifted(scene, -place), std::move(fields)));
}

}  // namespace gracilis
