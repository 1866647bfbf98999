#include <gracilis/anatomy/fibers/fiber_field.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
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

/// How much of the smoothing each edge of the grid keeps.
using EdgeShares = std::vector<Real>;

/// The quadratic energy of smooth_directions.
class DirectionEnergy {
 public:
  DirectionEnergy(const SolidGrid& grid, const std::vector<DirectionSample>& samples, Real smoothing,
                  const EdgeShares& shares)
      : grid_(grid), smoothness_(smoothing * smoothing * grid.step()), shares_(shares) {
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
    for (std::size_t e = 0; e < shares_.size(); ++e) {
      const SolidGrid::Edge& edge = grid_.edges()[e];
      const Vec3 flow = conductance(e) * (v.col(edge.a) - v.col(edge.b));
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
    for (std::size_t e = 0; e < shares_.size(); ++e)
      for (const Index n : {grid_.edges()[e].a, grid_.edges()[e].b}) result.col(n).array() += conductance(e);
    for (const Term& term : samples_) add_diagonal(term, result);
    return result;
  }

 private:
  struct Term {
    SolidGrid::Place at;
    Vec3 vector;
    Real weight;
  };

  Real conductance(std::size_t edge) const { return smoothness_ * grid_.edges()[edge].share * shares_[edge]; }

  static void spread(const Term& term, const Vec3& vector, Points& result) {
    for (std::size_t k = 0; k < 8; ++k) result.col(term.at.nodes[k]) += term.weight * term.at.weights[k] * vector;
  }
  static void add_diagonal(const Term& term, Points& result) {
    for (std::size_t k = 0; k < 8; ++k)
      result.col(term.at.nodes[k]).array() += term.weight * term.at.weights[k] * term.at.weights[k];
  }

  const SolidGrid& grid_;
  Real smoothness_;
  const EdgeShares& shares_;
  std::vector<Term> samples_;
};

EdgeShares all_of(const SolidGrid& grid) { return EdgeShares(grid.edges().size(), 1); }

/// smooth_directions where edges keep their shares of the smoothing only.
Points directions_of_least_energy(const SolidGrid& grid, const std::vector<DirectionSample>& samples, Real smoothing,
                                  const EdgeShares& shares, const Points& start) {
  constexpr int most_iterations = 1000;
  constexpr Real accuracy = 1e-4;  // of directions, which are unit: far below what tracts tell
  const DirectionEnergy energy(grid, samples, smoothing, shares);
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

/// Geman and McClure's: what lies by much more than the scale beside the rest hardly counts.
Real robust_weight(Real by_scale) { return std::pow(1 + by_scale * by_scale, -2); }

/// Turns tracts around that run against the field.
void turn_tracts(const FiberField& field, std::vector<DirectionSample>& samples) {
  std::map<Index, Real> agreement;
  for (const DirectionSample& sample : samples)
    agreement[sample.tract] += sample.weight * field.direction(sample.place).dot(sample.direction);
  for (DirectionSample& sample : samples)
    if (agreement[sample.tract] < 0) sample.direction = -sample.direction;
}

/// How a field is smooth: over so far, m, and perhaps not where it turns much faster than it does elsewhere.
struct Smoothness {
  Real reach = 0;
  bool has_seams = false;
};

/// Edges keep the less the more the field turns along them.
EdgeShares seams_in(const SolidGrid& grid, const Points& vectors) {
  constexpr Real usual_turns = 3, least_turn = 0.02;
  std::vector<Real> turns;
  for (const SolidGrid::Edge& edge : grid.edges()) turns.push_back((vectors.col(edge.a) - vectors.col(edge.b)).norm());
  const Real scale = std::max(least_turn, usual_turns * median_of(turns));
  EdgeShares shares;
  for (const Real turn : turns) shares.push_back(robust_weight(turn / scale));
  return shares;
}

/// Fits, judges the samples, and seams, by the fit, and fits again, so many rounds.
FiberField robust_fit(const SolidGrid& grid, std::vector<DirectionSample> samples, const Smoothness& smoothness,
                      int rounds) {
  constexpr Real least_scale = radians(5);  // nobody measures directions better
  const Real turn_reach = smoothness.has_seams ? 2 * grid.step() : smoothness.reach;
  EdgeShares shares = all_of(grid);
  FiberField field(grid,
                   directions_of_least_energy(grid, samples, smoothness.reach, shares, Points::Zero(3, grid.count())),
                   turn_reach);
  for (int round = 0; round < rounds; ++round) {
    turn_tracts(field, samples);
    const std::vector<Real> angles = angles_off(field, samples);
    const Real scale = std::max(least_scale, 2 * median_of(angles));
    std::vector<DirectionSample> weighed = samples;
    for (std::size_t i = 0; i < weighed.size(); ++i) weighed[i].weight *= robust_weight(angles[i] / scale);
    if (smoothness.has_seams) shares = seams_in(grid, field.vectors());
    field = FiberField(grid, directions_of_least_energy(grid, weighed, smoothness.reach, shares, field.vectors()),
                       turn_reach);
  }
  return field;
}

/// Which of some parts of the tracts one belongs to, whatever order they come in.
std::uint32_t part_of(Index tract, std::uint32_t parts) {
  return static_cast<std::uint32_t>((std::uint64_t{static_cast<std::uint32_t>(tract) * 2654435769u} * parts) >> 32);
}

/// How far off a field is on a part of the tracts when fitted to the others, for each of `parts`.
Real cross_error(const SolidGrid& grid, const std::vector<DirectionSample>& samples, const Smoothness& smoothness,
                 std::uint32_t parts) {
  std::vector<Real> angles;
  for (std::uint32_t part = 0; part < parts; ++part) {
    std::vector<DirectionSample> fitted, kept;
    for (const DirectionSample& sample : samples)
      (part_of(sample.tract, parts) == part ? kept : fitted).push_back(sample);
    if (fitted.empty() || kept.empty()) continue;
    const FiberField field = robust_fit(grid, fitted, smoothness, smoothness.has_seams ? 4 : 2);
    turn_tracts(field, kept);
    const std::vector<Real> of_part = angles_off(field, kept);
    angles.insert(angles.end(), of_part.begin(), of_part.end());
  }
  return angles.empty() ? 0 : median_of(angles);
}

}  // namespace

Points smooth_directions(const SolidGrid& grid, const std::vector<DirectionSample>& samples, Real smoothing,
                         const Points& start) {
  return directions_of_least_energy(grid, samples, smoothing, all_of(grid), start);
}

FiberField fitted_field(const SolidGrid& grid, std::vector<DirectionSample> samples) {
  constexpr int rounds = 5;
  constexpr Real clearly = 0.9;  // nearer to what is kept: then there are seams
  Real volume = 0;
  for (const Real depth : grid.depths()) volume += depth > 0 ? std::pow(grid.step(), 3) : 0;
  std::set<Index> tracts;
  for (const DirectionSample& sample : samples) tracts.insert(sample.tract);
  const std::uint32_t parts = tracts.size() < 200 ? 4 : 2;
  Smoothness best;
  Real least = std::numeric_limits<Real>::infinity();
  const auto try_smoothness = [&](const Smoothness& each, Real enough) {
    const Real error = cross_error(grid, samples, each, parts);
    if (error < enough * least) least = error, best = each;
  };
  for (const Real share : {0.5, 0.25, 0.125, 0.0625, 0.03125}) try_smoothness({share * std::cbrt(volume), false}, 1);
  for (const Real share : {0.25, 0.125})
    try_smoothness({share * std::cbrt(volume), true}, best.has_seams ? 1 : clearly);
  return robust_fit(grid, std::move(samples), best, rounds);
}

}  // namespace gracilis
