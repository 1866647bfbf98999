#include <gracilis/study/sensitivity.hpp>

#include <gracilis/io/value_reader.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace gracilis {

static constexpr Real unknown = std::numeric_limits<Real>::quiet_NaN();

/// Campolongo's mean of absolute effects, and the deviation of the effects.
static Sensitivity effect_statistics(const std::vector<Real>& effects) {
  Sensitivity result{unknown, unknown, static_cast<int>(effects.size())};
  if (effects.empty()) return result;
  const auto count = static_cast<Real>(effects.size());
  Real sum = 0, absolute = 0, squares = 0;
  for (const Real effect : effects) sum += effect, absolute += std::abs(effect);
  for (const Real effect : effects) squares += (effect - sum / count) * (effect - sum / count);
  result.first = absolute / count;
  result.second = effects.size() > 1 ? std::sqrt(squares / (count - 1)) : unknown;
  return result;
}

static std::vector<Sensitivity> elementary_effects(const Eigen::MatrixXd& points, const std::vector<Real>& values) {
  const Index columns = points.cols();
  std::vector<std::vector<Real>> effects(static_cast<std::size_t>(columns));
  for (Index row = 0; row + 1 < points.rows(); ++row) {
    if ((row + 1) % (columns + 1) == 0) continue;  // the next way begins
    Index column = 0;
    (points.row(row + 1) - points.row(row)).cwiseAbs().maxCoeff(&column);
    const Real effect = (values[static_cast<std::size_t>(row + 1)] - values[static_cast<std::size_t>(row)]) /
                        (points(row + 1, column) - points(row, column));
    if (std::isfinite(effect)) effects[static_cast<std::size_t>(column)].push_back(effect);
  }
  std::vector<Sensitivity> results;
  for (const std::vector<Real>& each : effects) results.push_back(effect_statistics(each));
  return results;
}

static std::vector<Sensitivity> variance_shares(Index columns, const std::vector<Real>& values) {
  const std::size_t width = static_cast<std::size_t>(columns) + 2;
  std::vector<std::size_t> whole;  // samples all of whose runs have the outcome
  for (std::size_t begin = 0; begin + width <= values.size(); begin += width)
    if (std::all_of(values.begin() + static_cast<std::ptrdiff_t>(begin),
                    values.begin() + static_cast<std::ptrdiff_t>(begin + width),
                    [](Real v) { return std::isfinite(v); }))
      whole.push_back(begin);
  const auto count = static_cast<Real>(whole.size());
  Real sum = 0, squares = 0;
  for (const std::size_t begin : whole) sum += values[begin] + values[begin + 1];
  const Real mean = sum / (2 * count);
  for (const std::size_t begin : whole)
    for (const std::size_t half : {begin, begin + 1}) squares += (values[half] - mean) * (values[half] - mean);
  const Real variance = squares / (2 * count);
  std::vector<Sensitivity> results;
  for (std::size_t column = 0; column < width - 2; ++column) {
    Real first = 0, total = 0;
    for (const std::size_t begin : whole) {
      const Real a = values[begin], b = values[begin + 1], mixed = values[begin + 2 + column];
      first += (b - mean) * (mixed - a);
      total += (a - mixed) * (a - mixed);
    }
    const bool is_known = whole.size() > 1 && variance > 0;
    results.push_back({is_known ? first / count / variance : unknown,
                       is_known ? total / (2 * count) / variance : unknown, static_cast<int>(whole.size())});
  }
  return results;
}

/// Ranks from 0; equal values share the mean of theirs.
static std::vector<Real> ranks_of(const std::vector<Real>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  std::vector<Real> ranks(values.size());
  for (std::size_t i = 0; i < order.size();) {
    std::size_t end = i;
    while (end < order.size() && values[order[end]] == values[order[i]]) ++end;
    for (std::size_t k = i; k < end; ++k) ranks[order[k]] = 0.5 * static_cast<Real>(i + end - 1);
    i = end;
  }
  return ranks;
}

static Real correlation(const std::vector<Real>& a, const std::vector<Real>& b) {
  const Eigen::Map<const Eigen::ArrayXd> x(a.data(), static_cast<Index>(a.size())),
      y(b.data(), static_cast<Index>(b.size()));
  const Eigen::ArrayXd from_x = x - x.mean(), from_y = y - y.mean();
  const Real scale = std::sqrt(from_x.square().sum() * from_y.square().sum());
  return scale > 0 ? (from_x * from_y).sum() / scale : unknown;
}

static Sensitivity rank_correlation(const Study& study, std::size_t parameter, const std::vector<Real>& values) {
  std::vector<Real> given, found;
  for (std::size_t run = 0; run < values.size(); ++run) {
    double number = 0;
    if (!std::isfinite(values[run]) || !parse_number(study.runs[run].values[parameter], number)) continue;
    given.push_back(number);
    found.push_back(values[run]);
  }
  const auto count = static_cast<int>(given.size());
  if (count < 3) return {unknown, unknown, count};
  return {correlation(ranks_of(given), ranks_of(found)), unknown, count};
}

std::vector<Sensitivity> sensitivities(const Study& study, const std::vector<Real>& values) {
  const bool is_designed = study.points.rows() == static_cast<Index>(values.size());
  if (is_designed && study.sampling.kind == SamplingKind::morris) return elementary_effects(study.points, values);
  if (is_designed && study.sampling.kind == SamplingKind::indices) return variance_shares(study.points.cols(), values);
  std::vector<Sensitivity> results;
  for (std::size_t parameter = 0; parameter < study.parameters.size(); ++parameter)
    results.push_back(rank_correlation(study, parameter, values));
  return results;
}

}  // namespace gracilis
