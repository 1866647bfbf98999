#include <gracilis/core/failure.hpp>

#include <filesystem>
#include <ios>
#include <new>
#include <system_error>

namespace gracilis {

Failure current_failure() {
  try {
    throw;
  } catch (const Error& error) {
    return {error.code(), error.what()};
  } catch (const std::filesystem::filesystem_error& error) {
    return {ExitCode::unreadable_input, error.path1().string() + ": " + error.code().message()};
  } catch (const std::ios_base::failure& error) {  // as a system_error it is not always caught
    return {ExitCode::unreadable_input, std::string("the system refused: ") + error.what()};
  } catch (const std::system_error& error) {
    return {ExitCode::unreadable_input, std::string("the system refused: ") + error.what()};
  } catch (const std::bad_alloc&) {
    return {ExitCode::internal, "out of memory"};
  } catch (const std::exception& error) {
    return {ExitCode::internal, std::string("internal error: ") + error.what()};
  }
}

}  // namespace gracilis
