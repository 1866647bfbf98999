#pragma once

#include <string>

namespace gracilis {

/// Collects the errors and warnings that VTK raises on this thread while it lives, instead of letting VTK print them.
/// VTK reports most failures only this way. One at a time per thread.
class VtkMessages {
 public:
  VtkMessages();
  ~VtkMessages();
  VtkMessages(const VtkMessages&) = delete;
  VtkMessages& operator=(const VtkMessages&) = delete;

  bool has_errors() const { return !errors_.empty(); }  ///< any so far
  /// The first error as one line without VTK's source file, line and addresses; empty when there was none.
  const std::string& first_error() const { return errors_; }
  const std::string& first_warning() const { return warnings_; }  ///< as first_error

  void add_error(const std::string& text);    ///< what VTK calls with an error
  void add_warning(const std::string& text);  ///< and with a warning

 private:
  std::string errors_;
  std::string warnings_;
};

}  // namespace gracilis
