#include "fast_preset.hpp"

/// Smaller motions, whose default runs are held to the same gates in hip_motions_test.cpp.
namespace gracilis {

INSTANTIATE_TEST_SUITE_P(Motions, FastPreset, ::testing::Values("extension", "abduction"),
                         [](const auto& motion) { return motion.param; });

}  // namespace gracilis
