#pragma once

namespace gracilis {

/// The instruction set in use, e.g. "AVX3": part of a run's manifest, because results differ in the last bits between
/// sets.
const char* instruction_set();

}  // namespace gracilis
