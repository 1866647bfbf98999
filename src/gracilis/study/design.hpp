#pragma once

#include <gracilis/core/types.hpp>

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

namespace gracilis {

/// How the runs of a study are spread over its parameters.
enum class SamplingKind { list, grid, latin, halton, sobol, morris, indices };

struct SamplingName {
  SamplingKind kind;
  std::string_view name, meaning;
};
inline constexpr std::array<SamplingName, 7> sampling_names = {
    {{SamplingKind::list, "list", "the first value of every parameter together, then the second ones ..."},
     {SamplingKind::grid, "grid", "every combination"},
     {SamplingKind::latin, "latin", "a Latin hypercube"},
     {SamplingKind::halton, "halton", "Halton's sequence"},
     {SamplingKind::sobol, "sobol", "Sobol's sequence"},
     {SamplingKind::morris, "morris", "ways on which one parameter after the other changes: elementary effects"},
     {SamplingKind::indices, "indices", "Sobol's points twice, and mixed by column: shares of the variance"}}};

struct Sampling {
  SamplingKind kind = SamplingKind::list;
  Index samples = 0;                       ///< points; of morris: ways; of indices: rows of one half
  std::vector<std::uint64_t> seeds = {1};  ///< of latin and morris: one design after the other
  Index levels = 4;                        ///< of morris: even
};

/// Points in the unit cube, a row per run. Of grid `steps` says how many values each column has: the middles of as many
/// equal parts where `in_parts` says so, else from 0 to 1. Preconditions: list has no points of its own, others but
/// grid a column or more; dimensions at most 16 of halton, 21 of sobol, 10 of indices; levels even and positive.
Eigen::MatrixXd design_points(const Sampling& sampling, Index columns, const std::vector<Index>& steps,
                              const std::vector<bool>& in_parts);

/// How many runs design_points would be; as a Real, for it may be more than there are numbers.
Real design_size(const Sampling& sampling, Index columns, const std::vector<Index>& steps);

/// Most columns of a sampling.
Index most_columns(SamplingKind kind);

}  // namespace gracilis
