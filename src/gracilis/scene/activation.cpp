#include <gracilis/scene/activation.hpp>

#include <algorithm>

namespace gracilis {

bool drives(const ActivationPlan& plan, const std::string& muscle) {
  const auto is_it = [&](const auto& way) { return way.muscle == muscle; };
  return std::any_of(plan.signals.begin(), plan.signals.end(), is_it) ||
         std::any_of(plan.functions.begin(), plan.functions.end(), is_it) ||
         std::any_of(plan.units.begin(), plan.units.end(), [&](const JointControlUnit& unit) {
           return std::find(unit.muscles.begin(), unit.muscles.end(), muscle) != unit.muscles.end();
         });
}

}  // namespace gracilis
