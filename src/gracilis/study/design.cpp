#include <gracilis/study/design.hpp>

#include <gracilis/geometry/halton.hpp>
#include <gracilis/geometry/latin_hypercube.hpp>
#include <gracilis/geometry/sobol_points.hpp>

#include <limits>
#include <random>

namespace gracilis {

/// Sobol's first points are corners and middles in every column, which both halves of a design would share.
static constexpr Eigen::Index skipped_sobol_points = 1024;

static Eigen::MatrixXd grid_points(const std::vector<Index>& steps, const std::vector<bool>& in_parts) {
  Index rows = 1;
  for (const Index count : steps) rows *= count;
  Eigen::MatrixXd points(rows, static_cast<Index>(steps.size()));
  for (Index row = 0; row < rows; ++row) {
    Index left = row;
    for (std::size_t column = steps.size(); column-- > 0;) {  // the last one changes fastest
      const Index at = left % steps[column];
      left /= steps[column];
      const auto count = static_cast<Real>(steps[column]), number = static_cast<Real>(at);
      points(row, static_cast<Index>(column)) =
          in_parts[column] || steps[column] == 1 ? (number + 0.5) / count : number / (count - 1);
    }
  }
  return points;
}

/// Ways through a grid of levels (Morris 1991): each begins anywhere and changes one column after the other, in any
/// order, by half of the levels, up or down.
static Eigen::MatrixXd morris_points(Index ways, Index columns, Index levels, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto below = [&](Index count) { return static_cast<Index>(random() % static_cast<std::uint64_t>(count)); };
  const Index half = levels / 2;
  const Real step = static_cast<Real>(half) / static_cast<Real>(levels - 1);
  Eigen::MatrixXd points(ways * (columns + 1), columns);
  for (Index way = 0; way < ways; ++way) {
    Eigen::RowVectorXd low(columns), at(columns);
    for (Index column = 0; column < columns; ++column) {
      low[column] = static_cast<Real>(below(half)) / static_cast<Real>(levels - 1);
      at[column] = low[column] + (below(2) == 0 ? 0 : step);
    }
    points.row(way * (columns + 1)) = at;
    const std::vector<Index> order = shuffled_order(columns, random);
    for (Index i = 0; i < columns; ++i) {
      const Index column = order[static_cast<std::size_t>(i)];
      at[column] = at[column] > low[column] ? low[column] : low[column] + step;
      points.row(way * (columns + 1) + i + 1) = at;
    }
  }
  return points;
}

/// Per sample a row of each half, then the first with one column after the other of the second (Saltelli et al. 2010).
static Eigen::MatrixXd mixed_points(Index samples, Index columns) {
  const Eigen::MatrixXd halves = sobol_points(samples, static_cast<int>(2 * columns), skipped_sobol_points);
  Eigen::MatrixXd points(samples * (columns + 2), columns);
  for (Index sample = 0; sample < samples; ++sample) {
    const Index first = sample * (columns + 2);
    points.row(first) = halves.row(sample).head(columns);
    points.row(first + 1) = halves.row(sample).tail(columns);
    for (Index column = 0; column < columns; ++column) {
      points.row(first + 2 + column) = points.row(first);
      points(first + 2 + column, column) = points(first + 1, column);
    }
  }
  return points;
}

/// A design per seed, one after the other.
static Eigen::MatrixXd points_of_seeds(const Sampling& sampling, Index columns) {
  const bool is_latin = sampling.kind == SamplingKind::latin;
  const Index rows = is_latin ? sampling.samples : sampling.samples * (columns + 1);
  Eigen::MatrixXd points(rows * static_cast<Index>(sampling.seeds.size()), columns);
  Index first = 0;
  for (const std::uint64_t seed : sampling.seeds) {
    points.middleRows(first, rows) = is_latin ? latin_hypercube(sampling.samples, columns, seed)
                                              : morris_points(sampling.samples, columns, sampling.levels, seed);
    first += rows;
  }
  return points;
}

Eigen::MatrixXd design_points(const Sampling& sampling, Index columns, const std::vector<Index>& steps,
                              const std::vector<bool>& in_parts) {
  switch (sampling.kind) {
    case SamplingKind::list:
      return {};
    case SamplingKind::grid:
      return grid_points(steps, in_parts);
    case SamplingKind::halton:
      return halton_points(sampling.samples, columns);
    case SamplingKind::sobol:
      return sobol_points(sampling.samples, static_cast<int>(columns));
    case SamplingKind::indices:
      return mixed_points(sampling.samples, columns);
    case SamplingKind::latin:
    case SamplingKind::morris:
      break;
  }
  return points_of_seeds(sampling, columns);
}

Real design_size(const Sampling& sampling, Index columns, const std::vector<Index>& steps) {
  const auto samples = static_cast<Real>(sampling.samples), width = static_cast<Real>(columns),
             seeds = static_cast<Real>(sampling.seeds.size());
  Real combinations = 1;
  switch (sampling.kind) {
    case SamplingKind::list:
      return 0;
    case SamplingKind::grid:
      for (const Index count : steps) combinations *= static_cast<Real>(count);
      return combinations;
    case SamplingKind::latin:
      return samples * seeds;
    case SamplingKind::halton:
    case SamplingKind::sobol:
      return samples;
    case SamplingKind::morris:
      return samples * (width + 1) * seeds;
    case SamplingKind::indices:
      return samples * (width + 2);
  }
  return 0;
}

Index most_columns(SamplingKind kind) {
  if (kind == SamplingKind::halton) return 16;
  if (kind == SamplingKind::sobol) return most_sobol_dimensions;
  if (kind == SamplingKind::indices) return most_sobol_dimensions / 2;
  return std::numeric_limits<Index>::max();
}

}  // namespace gracilis
