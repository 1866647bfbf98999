#include <gracilis/dynamics/simd/instruction_set.hpp>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "gracilis/dynamics/simd/instruction_set.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, as Highway asks.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace gracilis::HWY_NAMESPACE {

const char* instruction_set() { return hwy::TargetName(HWY_TARGET); }

}  // namespace gracilis::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gracilis {

HWY_EXPORT(instruction_set);

const char* instruction_set() { return HWY_DYNAMIC_DISPATCH(instruction_set)(); }

std::vector<std::string> instruction_sets() {
  std::vector<std::string> names;
  constexpr std::int64_t targets = HWY_TARGETS;
  for (std::int64_t left = targets; left != 0; left &= left - 1) names.emplace_back(hwy::TargetName(left & -left));
  return names;
}

}  // namespace gracilis
#endif
