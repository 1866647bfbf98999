#include <gracilis/view/pictures/egl_context.hpp>

#include <gracilis/core/errors.hpp>

#include <fmt/format.h>

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>
#include <utility>

namespace gracilis {

namespace fs = std::filesystem;

static void require_step(bool ok, const char* step) {
  if (ok) return;
  throw Error(ExitCode::unsupported,
              fmt::format("no picture can be drawn on this machine: {} failed (EGL error 0x{:x}; install libegl1 and "
                          "libgl1-mesa-dri for software rendering)",
                          step, eglGetError()));
}

/// Where Mesa keeps compiled shaders: as it chooses it.
static fs::path shader_cache() {
  for (const auto& [variable, below] :
       {std::pair{"MESA_SHADER_CACHE_DIR", ""}, {"XDG_CACHE_HOME", ""}, {"HOME", ".cache"}})
    if (const char* folder = std::getenv(variable)) return fs::path(folder) / below;
  return {};
}

/// Mesa maps a file of its cache into memory and writes to it, which on a full disk ends the program by SIGBUS.
static void leave_out_full_shader_cache() {
  constexpr std::uintmax_t enough = 64 << 20;  // bytes; the file has 1.3 MB
  std::error_code failed;
  fs::path folder = shader_cache();
  while (!folder.empty() && !fs::exists(folder, failed) && folder.has_relative_path()) folder = folder.parent_path();
  const fs::space_info room = fs::space(folder, failed);
  if (!failed && room.available < enough) setenv("MESA_SHADER_CACHE_DISABLE", "true", 0);
}

/// Mesa's surfaceless platform needs neither a display server nor a graphics card.
static EGLDisplay surfaceless_display() {
  leave_out_full_shader_cache();
  const auto get_platform_display =
      reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(eglGetProcAddress("eglGetPlatformDisplayEXT"));
  require_step(get_platform_display != nullptr, "eglGetPlatformDisplayEXT");
  const EGLDisplay display = get_platform_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  require_step(display != EGL_NO_DISPLAY, "eglGetPlatformDisplay");
  require_step(eglInitialize(display, nullptr, nullptr) == EGL_TRUE, "eglInitialize");
  return display;
}

static EGLContext core_profile_context(EGLDisplay display) {
  require_step(eglBindAPI(EGL_OPENGL_API) == EGL_TRUE, "eglBindAPI");
  const EGLint config_attributes[] = {EGL_SURFACE_TYPE, EGL_DONT_CARE, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  require_step(eglChooseConfig(display, config_attributes, &config, 1, &count) == EGL_TRUE && count > 0,
               "eglChooseConfig");
  // VTK needs at least OpenGL 3.2.
  const EGLint context_attributes[] = {
      EGL_CONTEXT_MAJOR_VERSION,           3,       EGL_CONTEXT_MINOR_VERSION, 2, EGL_CONTEXT_OPENGL_PROFILE_MASK,
      EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
  const EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, context_attributes);
  require_step(context != EGL_NO_CONTEXT, "eglCreateContext");
  return context;
}

EglContext::EglContext() : display_(surfaceless_display()) {
  context_ = core_profile_context(display_);
  require_step(eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_TRUE, "eglMakeCurrent");
}

// The display stays initialized: Mesa shares one per process, and ending it would end every other context.
EglContext::~EglContext() {
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(display_, context_);
}

}  // namespace gracilis
