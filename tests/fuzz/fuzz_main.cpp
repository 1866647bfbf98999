#include "targets.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

/// The target that the environment names, for libFuzzer.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace gracilis::fuzz;
  static const Target* const target = [] {
    const char* const name = std::getenv("GRACILIS_FUZZ_TARGET");
    for (const Target& each : targets())
      if (name != nullptr && each.name == name) return &each;
    std::fputs("GRACILIS_FUZZ_TARGET names no target\n", stderr);
    std::abort();
  }();
  run(*target, {reinterpret_cast<const char*>(data), size});
  return 0;
}
