#pragma once

/// Where the build that these tests belong to has its sources and programs.
namespace build_paths {

extern const char* const source_folder;        ///< the checkout
extern const char* const program;              ///< `gracilis`
extern const char* const failing_calls;        ///< the library that makes calls fail
extern const char* const failing_allocations;  ///< the one for allocations

}  // namespace build_paths
