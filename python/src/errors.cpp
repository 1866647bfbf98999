#include "errors.hpp"

#include <gracilis/core/errors.hpp>

#include <filesystem>
#include <system_error>

namespace py = pybind11;

namespace gracilis::python {

static py::list as_list(const std::vector<Problem>& problems) {
  py::list list;
  for (const Problem& problem : problems) {
    py::dict entry;
    entry["file"] = problem.file;
    entry["where"] = problem.where;
    entry["what"] = problem.what;
    entry["remedy"] = problem.remedy;
    list.append(entry);
  }
  return list;
}

static void set_error(const char* name, const std::string& message, ExitCode code,
                      const std::vector<Problem>& problems = {}) {
  const py::object type = py::module_::import("gracilis.errors").attr(name);
  const py::object error = type(message, static_cast<int>(code), as_list(problems));
  PyErr_SetObject(type.ptr(), error.ptr());
}

static void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const ConfigurationError& error) {
    set_error("ConfigurationError", error.what(), error.code(), error.problems());
  } catch (const InputError& error) {
    set_error("InputError", error.what(), error.code(), error.problems());
  } catch (const QualityError& error) {
    set_error("QualityError", error.what(), error.code());
  } catch (const Error& error) {
    set_error("Error", error.what(), error.code());
  } catch (const std::filesystem::filesystem_error& error) {
    set_error("InputError", error.path1().string() + ": " + error.code().message(), ExitCode::unreadable_input);
  } catch (const std::system_error& error) {
    set_error("InputError", std::string("the system refused: ") + error.what(), ExitCode::unreadable_input);
  }
}

void translate_errors() { py::register_exception_translator(translate); }

void refuse(const std::string& argument, const std::string& what, const std::string& remedy) {
  throw InputError({"", argument, what, remedy});
}

}  // namespace gracilis::python
