#include "build_paths.hpp"

namespace build_paths {

const char* const source_folder = GRACILIS_SOURCE_DIR;
const char* const program = GRACILIS_PROGRAM;
const char* const failing_calls = GRACILIS_FAILING_CALLS;
const char* const failing_allocations = GRACILIS_FAILING_ALLOCATIONS;

}  // namespace build_paths
