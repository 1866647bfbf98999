#pragma once

#include <gracilis/core/types.hpp>

#include <map>
#include <string>

namespace gracilis::opensim {

using Variables = std::map<std::string, Real>;

/// The value of a formula as OpenSim's expression based forces have it ("-5 * theta_x^3 + exp(q)"): + - * / ^,
/// brackets, numbers, the named variables and the usual functions, `log` natural, among them `square`, `cube`, `recip`
/// and `step`. Throws InputError where it cannot be understood.
Real value(const std::string& formula, const Variables& variables);

}  // namespace gracilis::opensim
