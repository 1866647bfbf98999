#include <gracilis/io/mesh/vtk_messages.hpp>

#include <vtkLogger.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>

#include <algorithm>
#include <iostream>
#include <mutex>

namespace gracilis {

static thread_local VtkMessages* listener = nullptr;

namespace {

/// Hands VTK's messages to the listener of the thread they are raised on.
class RoutingWindow : public vtkOutputWindow {
 public:
  static RoutingWindow* New();
  vtkTypeMacro(RoutingWindow, vtkOutputWindow)

      void DisplayErrorText(const char* text) override {
    route(&VtkMessages::add_error, text);
  }
  void DisplayWarningText(const char* text) override { route(&VtkMessages::add_warning, text); }
  void DisplayGenericWarningText(const char* text) override { route(&VtkMessages::add_warning, text); }
  void DisplayDebugText(const char*) override {}
  void DisplayText(const char* text) override { route(&VtkMessages::add_warning, text); }

 private:
  static void route(void (VtkMessages::*add)(const std::string&), const char* text) {
    if (listener) {
      (listener->*add)(text);
    } else {
      std::cerr << text;
    }
  }
};

vtkStandardNewMacro(RoutingWindow)

}  // namespace

/// "ERROR: In file.cxx, line 1\nvtkReader (0x5581): text\n\n" becomes "text".
static std::string plain(std::string text) {
  if (const auto line_end = text.find('\n'); text.find(": In ") < line_end && line_end != std::string::npos) {
    text = text.substr(line_end + 1);
  }
  if (text.starts_with("vtk")) {
    if (const auto head = text.find("): "); head != std::string::npos) text = text.substr(head + 3);
  }
  std::replace(text.begin(), text.end(), '\n', ' ');
  text.erase(text.find_last_not_of(' ') + 1);
  return text;
}

VtkMessages::VtkMessages() {
  static std::once_flag installed;
  std::call_once(installed, [] {
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);  // would print what the window collects
    vtkOutputWindow* window = RoutingWindow::New();
    vtkOutputWindow::SetInstance(window);
    window->Delete();
  });
  listener = this;
}

VtkMessages::~VtkMessages() { listener = nullptr; }

void VtkMessages::add_error(const std::string& text) {
  if (errors_.empty()) errors_ = plain(text);
}

void VtkMessages::add_warning(const std::string& text) {
  if (warnings_.empty()) warnings_ = plain(text);
}

}  // namespace gracilis
