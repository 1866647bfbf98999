#pragma once

#include <gracilis/view/session/run_plan.hpp>

namespace gracilis {

/// Asks on a terminal whether a run that takes more than `asking_bytes` shall begin. Throws Error (exit code 2) where
/// the answer is no, or where there is no terminal to ask and `yes` was not given; its text has the ways out.
void confirm_size(const RunPlan& plan, const SessionOptions& options);

}  // namespace gracilis
