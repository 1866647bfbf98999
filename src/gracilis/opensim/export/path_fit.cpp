#include <gracilis/opensim/export/path_fit.hpp>

#include <gracilis/opensim/export/legendre_terms.hpp>

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace gracilis::opensim {

namespace {

constexpr Eigen::Index fold_count = 5;  // parts of the samples, left out in turn

/// The normal equations of some rows: terms by terms, terms by what is known, what is known squared.
struct Normal {
  Eigen::MatrixXd matrix;
  Eigen::VectorXd right;
  Real squares = 0;
  Eigen::Index numbers = 0;  ///< how many are known

  explicit Normal(Eigen::Index terms)
      : matrix(Eigen::MatrixXd::Zero(terms, terms)), right(Eigen::VectorXd::Zero(terms)) {}

  void add(const Eigen::MatrixXd& rows, const Eigen::VectorXd& known) {
    matrix.selfadjointView<Eigen::Lower>().rankUpdate(rows.transpose());
    right += rows.transpose() * known;
    squares += known.squaredNorm();
    numbers += known.size();
  }
  void add(const Normal& other, Real weight) {
    matrix += weight * other.matrix;
    right += weight * other.right;
    squares += weight * other.squares;
    numbers += other.numbers;
  }

  /// The least squares of the first `terms`; what cannot be told apart stays small.
  Eigen::VectorXd solution(Eigen::Index terms) const {
    Eigen::MatrixXd block = matrix.topLeftCorner(terms, terms);
    block.diagonal().array() += 1e-13 * std::max(block.diagonal().maxCoeff(), 1e-300);
    return block.selfadjointView<Eigen::Lower>().ldlt().solve(right.head(terms));
  }
  /// The sum of squares that coefficients leave.
  Real left_by(const Eigen::VectorXd& x) const {
    const Eigen::Index terms = x.size();
    const Eigen::VectorXd product = matrix.topLeftCorner(terms, terms).selfadjointView<Eigen::Lower>() * x;
    return std::max(squares - 2 * right.head(terms).dot(x) + x.dot(product), 0.0);
  }
};

}  // namespace

/// The samples' rows, lengths less `offset` and arms, of those in `chosen`.
static void add_samples(const LegendreTerms& terms, const PathSamples& samples, const std::vector<Eigen::Index>& chosen,
                        Real offset, Normal& normal) {
  const std::size_t most = 256;  // rows at a time, for memory
  for (std::size_t begin = 0; begin < chosen.size(); begin += most) {
    const std::vector<Eigen::Index> some(
        chosen.begin() + static_cast<std::ptrdiff_t>(begin),
        chosen.begin() + static_cast<std::ptrdiff_t>(std::min(begin + most, chosen.size())));
    const Eigen::MatrixXd coordinates = samples.coordinates(some, Eigen::all);
    normal.add(terms.rows(coordinates), samples.lengths(some).array() - offset);
    for (Eigen::Index i = 0; i < samples.arms.cols(); ++i)
      normal.add(-samples.scale(i) * terms.rows(coordinates, static_cast<int>(i)),
                 samples.scale(i) * samples.arms(some, i));
  }
}

/// Which samples are left out together.
static std::vector<std::vector<Eigen::Index>> parts_of(Eigen::Index rows, bool consecutive) {
  std::vector<std::vector<Eigen::Index>> parts(fold_count);
  for (Eigen::Index row = 0; row < rows; ++row)
    parts[static_cast<std::size_t>(consecutive ? row * fold_count / rows : row % fold_count)].push_back(row);
  return parts;
}

/// Root mean square of what is left out.
static Real left_out_error(const std::vector<Normal>& parts, const Normal& all, Eigen::Index terms) {
  Real sum = 0;
  Eigen::Index numbers = 0;
  for (const Normal& part : parts) {
    if (part.numbers == 0) continue;
    Normal rest = all;
    rest.add(part, -1);
    sum += part.left_by(rest.solution(terms));
    numbers += part.numbers;
  }
  return std::sqrt(sum / static_cast<Real>(std::max<Eigen::Index>(numbers, 1)));
}

/// Errors of the samples, each by the fit that was made without its part.
static PathErrors held_out_errors(const LegendreTerms& terms, const PathSamples& samples,
                                  const std::vector<std::vector<Eigen::Index>>& rows, const std::vector<Normal>& parts,
                                  const Normal& all, Eigen::Index count, Real offset) {
  PathErrors errors;
  for (std::size_t part = 0; part < parts.size(); ++part) {
    if (rows[part].empty()) continue;
    Normal rest = all;
    rest.add(parts[part], -1);
    const Eigen::VectorXd x = rest.solution(count);
    const Eigen::MatrixXd coordinates = samples.coordinates(rows[part], Eigen::all);
    const Eigen::VectorXd off =
        (terms.rows(coordinates).leftCols(count) * x).array() + offset - samples.lengths(rows[part]).array();
    errors.length_root_mean_square += off.squaredNorm();
    errors.length_largest = std::max(errors.length_largest, off.lpNorm<Eigen::Infinity>());
    for (Eigen::Index i = 0; i < samples.arms.cols(); ++i) {
      const Eigen::VectorXd arms = terms.rows(coordinates, static_cast<int>(i)).leftCols(count) * x;
      const Eigen::VectorXd arms_off = samples.scale(i) * (arms + samples.arms(rows[part], i));
      errors.arm_root_mean_square += arms_off.squaredNorm();
      errors.arm_largest = std::max(errors.arm_largest, arms_off.lpNorm<Eigen::Infinity>());
    }
  }
  const auto root = [](Real sum, Eigen::Index n) { return n > 0 ? std::sqrt(sum / static_cast<Real>(n)) : 0; };
  errors.length_root_mean_square = root(errors.length_root_mean_square, samples.lengths.size());
  errors.arm_root_mean_square = root(errors.arm_root_mean_square, samples.arms.size());
  return errors;
}

/// The largest order whose terms the known numbers can tell.
static int told_order(const LegendreTerms& terms, int largest, Eigen::Index numbers) {
  int order = 1;
  while (order < largest && 2 * terms.count(order + 1) <= numbers) ++order;
  return order;
}

PathFit fit_path(const PathSamples& samples, const PathFitSettings& settings) {
  const Real enough = 1e-6;  // m
  Eigen::VectorXd least = samples.coordinates.colwise().minCoeff(), most = samples.coordinates.colwise().maxCoeff();
  const bool drawn = settings.towards.lengths.size() > 0;
  if (drawn) {
    least = least.cwiseMin(settings.towards.coordinates.colwise().minCoeff().transpose());
    most = most.cwiseMax(settings.towards.coordinates.colwise().maxCoeff().transpose());
  }
  const auto known = static_cast<Eigen::Index>(samples.lengths.size() + samples.arms.size());
  const int order = told_order(LegendreTerms(least, most, settings.largest_order), settings.largest_order, known);
  const LegendreTerms terms(least, most, order);
  const Eigen::Index count = terms.count(order);
  const Real offset = samples.lengths.mean();

  const auto rows = parts_of(samples.lengths.size(), settings.consecutive_parts);
  std::vector<Normal> parts(rows.size(), Normal(count));
  for (std::size_t part = 0; part < rows.size(); ++part) add_samples(terms, samples, rows[part], offset, parts[part]);
  Normal towards(count);
  if (drawn) {
    std::vector<Eigen::Index> all(static_cast<std::size_t>(settings.towards.lengths.size()));
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<Eigen::Index>(i);
    add_samples(terms, settings.towards, all, offset, towards);
  }
  PathFit best;
  Normal chosen(count);
  bool found = false;
  for (const Real ridge : settings.ridges) {
    Normal all(count);
    for (const Normal& part : parts) all.add(part, 1);
    if (drawn) all.add(towards, ridge * static_cast<Real>(known) / static_cast<Real>(towards.numbers));
    for (int n = 1; n <= order; ++n) {
      const Real error = left_out_error(parts, all, terms.count(n));
      if (found && error > 0.99 * best.left_out - enough) continue;
      found = true;
      best.left_out = error;
      best.ridge = ridge;
      best.function.order = n;
      chosen = all;
    }
  }
  const Eigen::Index used = terms.count(best.function.order);
  best.held_out = held_out_errors(terms, samples, rows, parts, chosen, used, offset);
  Eigen::VectorXd solution = chosen.solution(used);
  solution[0] += offset;  // the first term is 1
  best.function = terms.in_powers(solution, best.function.order);
  return best;
}

}  // namespace gracilis::opensim
