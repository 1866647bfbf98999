#pragma once

#include <gracilis/dynamics/solver/surface_system.hpp>

#include <Eigen/Dense>

#include <algorithm>
#include <vector>

namespace gracilis {

/// Ways to make more of a fixed point iteration x → G(x), tried on the solver from outside. Positions and multipliers
/// are extrapolated alike, so that they go on belonging to each other.
class Accelerator {
 public:
  static Accelerator none() { return {}; }
  /// Chebyshev's semi-iteration (Wang 2015): x ← ω (G(x) - x₂) + x₂ with x₂ two iterations back, ω = 4 / (4 - ρ² ω).
  static Accelerator chebyshev(float radius) {
    Accelerator result;
    result.radius_ = radius;
    return result;
  }
  /// Anderson's mixing (Walker and Ni 2011) over the last `window` iterations.
  static Accelerator anderson(int window) {
    Accelerator result;
    result.window_ = static_cast<std::size_t>(window);
    return result;
  }

  /// Once after each iteration, which took the last state to this one. False: left as it is.
  bool improve(SurfaceState& state) {
    if (radius_ > 0) return chebyshev_step(state);
    if (window_ > 0) return anderson_step(state);
    return false;
  }

 private:
  /// Chebyshev begins after these.
  static constexpr int calm = 4;

  static Eigen::VectorXf pack(const SurfaceState& state) {
    const auto part = [](const AlignedVector<float>& values) {
      return Eigen::Map<const Eigen::VectorXf>(values.data(), static_cast<Eigen::Index>(values.size()));
    };
    const auto &x = part(state.particles.xyzw), &d = part(state.distance_lambda), &h = part(state.dihedral_lambda);
    Eigen::VectorXf all(x.size() + d.size() + h.size() + 1);
    all << x, d, h, static_cast<float>(state.volume_lambda);
    return all;
  }

  static void unpack(const Eigen::VectorXf& all, SurfaceState& state) {
    const float* next = all.data();
    for (AlignedVector<float>* part : {&state.particles.xyzw, &state.distance_lambda, &state.dihedral_lambda}) {
      std::copy(next, next + part->size(), part->begin());
      next += part->size();
    }
    state.volume_lambda = static_cast<double>(*next);
  }

  bool chebyshev_step(SurfaceState& state) {
    Eigen::VectorXf now = pack(state);
    const bool active = ++count_ > calm && before_.size() == now.size();
    if (active) {
      omega_ = count_ == calm + 1 ? 2 / (2 - radius_ * radius_) : 4 / (4 - radius_ * radius_ * omega_);
      now = omega_ * (now - before_) + before_;
      unpack(now, state);
    }
    before_ = std::move(last_);
    last_ = std::move(now);
    return active;
  }

  bool anderson_step(SurfaceState& state) {
    const Eigen::VectorXf reached = pack(state);
    const auto positions = static_cast<Eigen::Index>(state.particles.xyzw.size());
    if (last_.size() == 0) {
      last_ = reached;
      return false;
    }
    reached_.push_back(reached);
    residuals_.push_back((reached - last_).head(positions));
    if (reached_.size() > window_ + 1) reached_.erase(reached_.begin()), residuals_.erase(residuals_.begin());
    const auto count = static_cast<Eigen::Index>(reached_.size()) - 1;
    if (count < 1) {
      last_ = reached;
      return false;
    }
    Eigen::MatrixXf differences(positions, count);
    for (Eigen::Index i = 0; i < count; ++i)
      differences.col(i) = residuals_.back() - residuals_[static_cast<std::size_t>(i)];
    const Eigen::MatrixXd normal = (differences.transpose() * differences).cast<double>();
    const Eigen::VectorXd right = (differences.transpose() * residuals_.back()).cast<double>();
    const double ridge = 1e-6 * normal.trace();
    const Eigen::VectorXd shares = (normal + ridge * Eigen::MatrixXd::Identity(count, count)).ldlt().solve(right);
    Eigen::VectorXf mixed = reached;
    for (Eigen::Index i = 0; i < count; ++i)
      mixed -= static_cast<float>(shares[i]) * (reached - reached_[static_cast<std::size_t>(i)]);
    unpack(mixed, state);
    last_ = std::move(mixed);
    return true;
  }

  float radius_ = 0, omega_ = 1;
  std::size_t window_ = 0;
  int count_ = 0;
  Eigen::VectorXf last_, before_;
  std::vector<Eigen::VectorXf> reached_, residuals_;
};

}  // namespace gracilis
