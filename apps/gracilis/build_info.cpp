#include "build_info.hpp"

#include <gracilis/dynamics/simd/instruction_set.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace gracilis {

/// Written anew at every build (cmake/gracilis_build_info.cmake).
extern const char* const build_commit;
extern const char* const build_date;

static std::string compiler_name() {
#if defined(__clang__)
  return fmt::format("Clang {}.{}.{}", __clang_major__, __clang_minor__, __clang_patchlevel__);
#else
  return fmt::format("GCC {}.{}.{}", __GNUC__, __GNUC_MINOR__, __GNUC_PATCHLEVEL__);
#endif
}

BuildInfo build_info() {
  BuildInfo info;
  info.version = GRACILIS_VERSION;
  info.commit = build_commit;
  info.date = build_date;
  info.compiler = compiler_name();
  info.build_type = GRACILIS_BUILD_TYPE;
  info.instruction_sets = instruction_sets();
  info.instruction_set = instruction_set();
#ifdef GRACILIS_WITH_PREPARE
  info.components.emplace_back("prepare");
#else
  info.left_out.emplace_back("prepare");
#endif
  (GRACILIS_HAS_PYTHON ? info.components : info.left_out).emplace_back("python");
  return info;
}

std::string version_text() {
  const BuildInfo info = build_info();
  const auto list = [](const std::vector<std::string>& words) {
    return words.empty() ? std::string("none") : fmt::format("{}", fmt::join(words, ", "));
  };
  std::string text = fmt::format("gracilis {}\n", info.version);
  text += fmt::format("commit            {}{}\n", info.commit, info.date.empty() ? "" : " (" + info.date + ")");
  text += fmt::format("compiler          {}, {}\n", info.compiler, info.build_type);
  text += fmt::format("instruction sets  {}; in use {}\n", list(info.instruction_sets), info.instruction_set);
  text += fmt::format("components        {}; not built: {}", list(info.components), list(info.left_out));
  return text;
}

std::string version_json() {
  const BuildInfo info = build_info();
  const nlohmann::ordered_json json = {{"version", info.version},
                                       {"commit", info.commit},
                                       {"date", info.date},
                                       {"compiler", info.compiler},
                                       {"build_type", info.build_type},
                                       {"instruction_sets", info.instruction_sets},
                                       {"instruction_set", info.instruction_set},
                                       {"components", info.components},
                                       {"not_built", info.left_out}};
  return json.dump(2);
}

}  // namespace gracilis
