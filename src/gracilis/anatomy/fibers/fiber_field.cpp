#include <gracilis/anatomy/fibers/fiber_field.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

namespace gracilis {

Vec3 FiberField::direction(const Vec3& p) const {
  const SolidGrid::Place at = grid_->place(p);
  if (!at.is_known) return Vec3::Zero();
  const Vec3 sum = at.mean(vectors_);
  const Real size = sum.norm();
  return size > 1e-9 ? Vec3(sum / size) : Vec3::Zero();
}

namespace {

/// The quadratic energy of smooth_directions.
class DirectionEnergy {
 public:
  DirectionEnergy(const SolidGrid& grid, const std::vector<DirectionSample>& samples, Real smoothing)
      : grid_(grid), smoothness_(smoothing * smoothing * grid.step()) {
    Real total = 0, volume = 0;
    for (const Real depth : grid.depths()) volume += depth > 0 ? std::pow(grid.step(), 3) : 0;
    for (const DirectionSample& sample : samples) total += sample.weight;
    for (const DirectionSample& sample : samples)
      if (const SolidGrid::Place at = grid.place(sample.place); at.is_known)
        samples_.push_back({at, sample.direction, volume * sample.weight / total});
  }

  /// Half of the energy's gradient, without what is constant in it.
  Points product(const Points& v) const {
    Points result = 1e-12 * smoothness_ * v;  // what no sample reaches
    for (const SolidGrid::Edge& edge : grid_.edges()) {
      const Vec3 flow = conductance(edge) * (v.col(edge.a) - v.col(edge.b));
      result.col(edge.a) += flow;
      result.col(edge.b) -= flow;
    }
    for (const Term& term : samples_) spread(term, term.at.mean(v), result);
    return result;
  }

  Points right_side() const {
    Points result = Points::Zero(3, grid_.count());
    for (const Term& term : samples_) spread(term, term.vector, result);
    return result;
  }

  Points diagonal() const {
    Points result = Points::Constant(3, grid_.count(), 1e-12 * smoothness_);
    for (const SolidGrid::Edge& edge : grid_.edges())
      for (const Index n : {edge.a, edge.b}) result.col(n).array() += conductance(edge);
    for (const Term& term : samples_) add_diagonal(term, result);
    return result;
  }

 private:
  struct Term {
    SolidGrid::Place at;
    Vec3 vector;
    Real weight;
  };

  Real conductance(const SolidGrid::Edge& edge) const { return smoothness_ * edge.share; }

  static void spread(const Term& term, const Vec3& vector, Points& result) {
    for (std::size_t k = 0; k < 8; ++k) result.col(term.at.nodes[k]) += term.weight * term.at.weights[k] * vector;
  }
  static void add_diagonal(const Term& term, Points& result) {
    for (std::size_t k = 0; k < 8; ++k)
      result.col(term.at.nodes[k]).array() += term.weight * term.at.weights[k] * term.at.weights[k];
  }

  const SolidGrid& grid_;
  Real smoothness_;
  std::vector<Term> samples_;
};

}  // namespace

Points smooth_directions(const SolidGrid& grid, const std::vector<DirectionSample>& samples, Real smoothing,
                         const Points& start) {
  constexpr int most_iterations = 1000;
  constexpr Real accuracy = 1e-4;  // of directions, which are unit: far below what tracts tell
  const DirectionEnergy energy(grid, samples, smoothing);
  const Points inverse = energy.diagonal().cwiseInverse();
  const Points right = energy.right_side();
  // Conjugate gradients (Hestenes and Stiefel 1952), preconditioned by the diagonal.
  Points x = start;
  Points residual = right - energy.product(x);
  Points scaled = inverse.cwiseProduct(residual), way = scaled;
  Real size = residual.cwiseProduct(scaled).sum();
  const Real enough = accuracy * accuracy * right.cwiseProduct(inverse.cwiseProduct(right)).sum();
  for (int i = 0; i < most_iterations && size > enough; ++i) {
    const Points product = energy.product(way);
    const Real step = size / way.cwiseProduct(product).sum();
    x += step * way;
    residual -= step * product;
    scaled = inverse.cwiseProduct(residual);
    const Real before = std::exchange(size, residual.cwiseProduct(scaled).sum());
    way = scaled + size / before * way;
  }
  return x;
}

namespace {

/// Angles between samples and field, rad.
std::vector<Real> angles_off(const FiberField& field, const std::vector<DirectionSample>& samples) {
  std::vector<Real> angles;
  for (const DirectionSample& sample : samples) {
    const Vec3 direction = field.direction(sample.place);
    angles.push_back(std::atan2(direction.cross(sample.direction).norm(), direction.dot(sample.direction)));
  }
  return angles;
}

Real median_of(std::vector<Real> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Turns tracts around that run against the field.
void turn_tracts(const FiberField& field, std::vector<DirectionSample>& samples) {
  std::map<Index, Real> agreement;
  for (const DirectionSample& sample : samples)
    agreement[sample.tract] += sample.weight * field.direction(sample.place).dot(sample.direction);
  for (DirectionSample& sample : samples)
    if (agreement[sample.tract] < 0) sample.direction = -sample.direction;
}

/// Fits, judges the samples by the fit, and fits again, so many rounds.
FiberField robust_fit(const SolidGrid& grid, std::vector<DirectionSample> samples, Real smoothing, int rounds) {
  constexpr Real least_scale = radians(5);  // nobody measures directions better
  FiberField field(grid, smooth_directions(grid, samples, smoothing, Points::Zero(3, grid.count())), smoothing);
  for (int round = 0; round < rounds; ++round) {
    turn_tracts(field, samples);
    const std::vector<Real> angles = angles_off(field, samples);
    const Real scale = std::max(least_scale, 2 * median_of(angles));
    std::vector<DirectionSample> weighed = samples;
    for (std::size_t i = 0; i < weighed.size(); ++i)
      weighed[i].weight /= std::pow(1 + std::pow(angles[i] / scale, 2), 2);
    field = FiberField(grid, smooth_directions(grid, weighed, smoothing, field.vectors()), smoothing);
  }
  return field;
}

/// Which half of the tracts one belongs to, whatever order they come in.
Index half_of(Index tract) { return static_cast<Index>((static_cast<std::uint32_t>(tract) * 2654435769u) >> 31); }

/// How far off a field fitted to one half of the tracts is on the other half, for both.
Real cross_error(const SolidGrid& grid, const std::vector<DirectionSample>& samples, Real smoothing) {
  std::vector<Real> angles;
  for (const Index half : {0, 1}) {
    std::vector<DirectionSample> fitted, kept;
    for (const DirectionSample& sample : samples) (half_of(sample.tract) == half ? fitted : kept).push_back(sample);
    if (fitted.empty() || kept.empty()) return 0;
    const FiberField field = robust_fit(grid, fitted, smoothing, 2);
    turn_tracts(field, kept);
    const std::vector<Real> of_half = angles_off(field, kept);
    angles.insert(angles.end(), of_half.begin(), of_half.end());
  }
  return median_of(angles);
}

}  // namespace

FiberField fitted_field(const SolidGrid& grid, std::vector<DirectionSample> samples) {
  Real volume = 0;
  for (const Real depth : grid.depths()) volume += depth > 0 ? std::pow(grid.step(), 3) : 0;
  Real best = 0, least = std::numeric_limits<Real>::infinity();
  for (const Real share : {0.5, 0.25, 0.125, 0.0625, 0.03125}) {
    const Real smoothing = share * std::cbrt(volume), error = cross_error(grid, samples, smoothing);
    if (error < least) least = error, best = smoothing;
  }
  return robust_fit(grid, std::move(samples), best, 5);
}

}  // namespace gracilis
