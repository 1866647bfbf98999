#pragma once

#include <gracilis/study/outcomes.hpp>
#include <gracilis/view/charts/line_chart.hpp>

namespace gracilis {

/// How many runs have an outcome within each of equal parts of its range: at most 20, about the square root of their
/// number. Precondition: at least one run has it.
LineChart distribution_chart(const OutcomeValues& outcome);

/// An outcome against a parameter of numbers, a mark per run; no series where its values are none.
LineChart scatter_chart(const Study& study, std::size_t parameter, const OutcomeValues& outcome);

}  // namespace gracilis
