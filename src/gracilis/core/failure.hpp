#pragma once

#include <gracilis/core/errors.hpp>

#include <string>

namespace gracilis {

/// What a process that ends by an exception says, and its exit code.
struct Failure {
  ExitCode code = ExitCode::internal;
  std::string text;  ///< a line per problem
};

/// Of the exception that is being handled. Precondition: one is, a std::exception.
Failure current_failure();

}  // namespace gracilis
