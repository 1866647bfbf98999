#pragma once

#include <string>
#include <vector>

namespace gracilis {

/// The instruction set in use, e.g. "AVX3": part of a run's manifest, because results differ in the last bits between
/// sets.
const char* instruction_set();

/// All for which this build has code, the best first.
std::vector<std::string> instruction_sets();

}  // namespace gracilis
