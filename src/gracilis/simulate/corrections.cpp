#include <gracilis/simulate/corrections.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/methods/pass_tracing.hpp>

#include <utility>

namespace gracilis {

void require_passes(DeformationMethod& method) {
  if (!method.pass_tracing())
    throw ConfigurationError({"--corrections", "", "the scene's method tells nothing of what its constraints move",
                              "run it with --set method=xpbd, or without --corrections"});
}

CorrectionSum::CorrectionSum(DeformationMethod& method, std::size_t muscle_count)
    : method_(method), muscles_(muscle_count) {
  require_passes(method);
  method.pass_tracing()->trace_passes([this](const SolverPass& pass) {
    const auto [sum, is_first] = muscles_[pass.muscle].try_emplace(std::string(pass.kind), pass.moved);
    if (!is_first) sum->second += pass.moved;
  });
}

CorrectionSum::~CorrectionSum() { method_.pass_tracing()->trace_passes({}); }

std::vector<Corrections> CorrectionSum::take() {
  return std::exchange(muscles_, std::vector<Corrections>(muscles_.size()));
}

}  // namespace gracilis
