#pragma once

#include <gracilis/dynamics/constraints/sliver_groups.hpp>

#include <cstdint>

namespace gracilis {

/// One bit per member: whether its tip may have to be moved; rounding never takes one away.
std::uint32_t lost_tips(const SliverGroup& group, const Particles& particles);

}  // namespace gracilis
