#include "targets.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

/// One target, chosen when this is compiled, for libFuzzer.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace gracilis::fuzz;
  static const Target* const target = [] {
    for (const Target& each : targets())
      if (each.name == GRACILIS_FUZZ_TARGET) return &each;
    std::fputs("there is no target " GRACILIS_FUZZ_TARGET "\n", stderr);
    std::abort();
  }();
  run(*target, {reinterpret_cast<const char*>(data), size});
  return 0;
}
