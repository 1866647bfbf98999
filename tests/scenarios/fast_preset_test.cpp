#include "fast_preset.hpp"

namespace gracilis {

INSTANTIATE_TEST_SUITE_P(Motions, FastPreset, ::testing::Values("flexion", "rotation"),
                         [](const auto& motion) { return motion.param; });

}  // namespace gracilis
