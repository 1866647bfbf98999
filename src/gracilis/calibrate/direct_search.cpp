#include <gracilis/calibrate/direct_search.hpp>

#include <gracilis/core/errors.hpp>

#include <nlopt.hpp>

#include <algorithm>
#include <exception>

namespace gracilis {

namespace {

/// First steps, as a share of the bounds.
constexpr Real first_step = 0.15;
constexpr Real all_met = 1e-8;

struct DirectSearch {
  const ResidualFunction& residuals;
  Eigen::VectorXd best;
  Real objective, worst;
  std::exception_ptr thrown = nullptr;  ///< NLopt hands on only what it knows
};

double value_of_point(const std::vector<double>& point, std::vector<double>&, void* data) {
  DirectSearch& search = *static_cast<DirectSearch*>(data);
  const Eigen::VectorXd place = Eigen::Map<const Eigen::VectorXd>(point.data(), static_cast<Index>(point.size()));
  std::optional<Eigen::VectorXd> seen;
  try {
    seen = search.residuals({place}).front();
  } catch (...) {
    search.thrown = std::current_exception();
    throw nlopt::forced_stop();
  }
  if (!seen) return 2 * search.worst + 1;
  const Real value = seen->squaredNorm();
  search.worst = std::max(search.worst, value);
  if (value < search.objective) search.objective = value, search.best = place;
  return value;
}

nlopt::algorithm algorithm_of(SearchMethod method) {
  if (method == SearchMethod::bobyqa) return nlopt::LN_BOBYQA;
  if (method == SearchMethod::cobyla) return nlopt::LN_COBYLA;
  return nlopt::LN_SBPLX;
}

std::string words_of(nlopt::result result) {
  switch (result) {
    case nlopt::STOPVAL_REACHED:
      return "the targets are met";
    case nlopt::FTOL_REACHED:
      return "the objective changes no more";
    case nlopt::XTOL_REACHED:
      return "the parameters change no more";
    case nlopt::MAXEVAL_REACHED:
      return "the number of evaluations is spent";
    default:
      return "nothing lowers the objective";
  }
}

}  // namespace

SearchEnd direct_search(SearchMethod method, const ResidualFunction& residuals, const Eigen::VectorXd& start,
                        const LeastSquaresOptions& options) {
  const auto count = static_cast<unsigned>(start.size());
  DirectSearch search{residuals, start, 0, 0};
  const std::optional<Eigen::VectorXd> first = residuals({start}).front();
  if (!first) throw QualityError("nothing can be evaluated where the search begins");
  search.objective = search.worst = first->squaredNorm();
  nlopt::opt optimizer(algorithm_of(method), count);
  optimizer.set_lower_bounds(0);
  optimizer.set_upper_bounds(1);
  optimizer.set_min_objective(value_of_point, &search);
  optimizer.set_initial_step(first_step);
  optimizer.set_xtol_abs(options.stop);
  optimizer.set_ftol_rel(options.stop);
  optimizer.set_stopval(all_met);
  optimizer.set_maxeval(static_cast<int>(std::min<Index>(options.most_points, 1'000'000)));
  std::vector<double> place(start.begin(), start.end());
  std::string stopped;
  try {
    double value = 0;
    stopped = words_of(optimizer.optimize(place, value));
  } catch (const nlopt::roundoff_limited&) {
    stopped = "rounding lets nothing lower the objective";
  } catch (const std::exception&) {
    if (search.thrown) std::rethrow_exception(search.thrown);
    throw;
  }
  return {search.best, search.objective, stopped};
}

}  // namespace gracilis
