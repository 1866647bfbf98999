#include <gracilis/opensim/reader/model.hpp>

#include <algorithm>

namespace gracilis::opensim {

Eigen::VectorXd default_coordinates(const Model& model) {
  Eigen::VectorXd values(static_cast<Eigen::Index>(model.coordinates.size()));
  for (std::size_t i = 0; i < model.coordinates.size(); ++i)
    values[static_cast<Eigen::Index>(i)] = model.coordinates[i].default_value;
  apply_couplers(model, values);
  return values;
}

void apply_couplers(const Model& model, Eigen::VectorXd& coordinates) {
  for (const Coupler& coupler : model.couplers) {
    std::vector<Real> arguments;
    for (const Index i : coupler.independent) arguments.push_back(coordinates[i]);
    coordinates[coupler.dependent] = value(coupler.function, arguments);
  }
}

bool is_dependent(const Model& model, Index coordinate) {
  return std::any_of(model.couplers.begin(), model.couplers.end(),
                     [&](const Coupler& coupler) { return coupler.dependent == coordinate; });
}

MuscleCurves curves_of(const Muscle& muscle) {
  if (muscle.type.starts_with("Thelen")) return MuscleCurves::thelen;
  return muscle.type.starts_with("Millard2012") ? MuscleCurves::millard : MuscleCurves::de_groote;
}

RigidTransform body_fixed_xyz(const Vec3& angles, const Vec3& translation) {
  RigidTransform transform = RigidTransform::Identity();
  transform.translation() = translation;
  transform.linear() = (Eigen::AngleAxisd(angles.x(), Vec3::UnitX()) * Eigen::AngleAxisd(angles.y(), Vec3::UnitY()) *
                        Eigen::AngleAxisd(angles.z(), Vec3::UnitZ()))
                           .toRotationMatrix();
  return transform;
}

}  // namespace gracilis::opensim
