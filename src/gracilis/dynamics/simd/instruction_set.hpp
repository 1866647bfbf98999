#pragma once

#include <string>
#include <vector>

namespace gracilis {

/// The instruction set in use, e.g. "AVX2": part of a run's manifest, because results differ in the last bits between
/// sets. Strings may use a wider one, with the same bits.
const char* instruction_set();

/// All for which this build has code, the best first.
std::vector<std::string> instruction_sets();

}  // namespace gracilis
