#include <gracilis/strings/string_system.hpp>

#include <Eigen/LU>

namespace gracilis::strings {

StringSystem::StringSystem(Index nodes) {
  const auto count = static_cast<std::size_t>(nodes);
  stiffness.assign(count, Eigen::Matrix3d::Identity());
  inverse_ = stiffness;
  gradient.assign(count, Vec3::Zero());
  solution.assign(count, Vec3::Zero());
}

void StringSystem::add_spring(Index node, Real k, const Vec3& direction, Real stretch) {
  const auto i = static_cast<std::size_t>(node);
  stiffness[i] += k * direction * direction.transpose();
  gradient[i] += k * stretch * direction;
}

void StringSystem::solve() {
  const std::size_t last = stiffness.size() - 1;
  for (std::size_t i = 1; i < last; ++i) {
    Eigen::Matrix3d reduced = stiffness[i];
    solution[i] = -gradient[i];
    if (i > 1) {
      reduced -= tension * tension * inverse_[i - 1];
      solution[i] += tension * (inverse_[i - 1] * solution[i - 1]);
    }
    inverse_[i] = reduced.inverse();
  }
  for (std::size_t i = last - 1; i > 0; --i) {
    if (i + 1 < last) solution[i] += tension * solution[i + 1];
    solution[i] = (inverse_[i] * solution[i]).eval();
  }
}

}  // namespace gracilis::strings
