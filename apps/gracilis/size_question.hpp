#pragma once

#include <gracilis/view/session/run_plan.hpp>

#include <string>

namespace gracilis {

/// Asks on a terminal whether a run that takes more than `asking_bytes` shall begin. Throws Error (exit code 2) where
/// the answer is no, or where there is no terminal to ask and `yes` was not given; its text has the ways out. For
/// commands with all options of add_session_options.
void confirm_size(const RunPlan& plan, const SessionOptions& options);

/// The same for a command that has of these --yes alone; `fewer` says what else makes it write less.
void confirm_size(const RunPlan& plan, const SessionOptions& options, const std::string& fewer);

}  // namespace gracilis
