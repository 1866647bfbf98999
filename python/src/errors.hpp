#pragma once

#include <pybind11/pybind11.h>

#include <string>

namespace gracilis::python {

/// Lets C++ errors arrive as the exceptions of gracilis/errors.py, with the program's messages.
void translate_errors();

/// What a caller got wrong in an argument: InputError with this message.
[[noreturn]] void refuse(const std::string& argument, const std::string& what, const std::string& remedy = "");

}  // namespace gracilis::python
