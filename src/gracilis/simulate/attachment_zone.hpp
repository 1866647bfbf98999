#pragma once

#include <gracilis/core/types.hpp>

#include <vector>

namespace gracilis {

/// m. Edges that begin or end this near to an attachment, at rest, are judged by the looser bar of their own
/// (QualityGates::near_edge_ratio).
inline constexpr Real attachment_zone = 0.015;

/// Per vertex at rest (3 × n, m): 1 where it lies in the zone around one of the `attached` vertices.
std::vector<char> near_attachments(const Points& rest, const std::vector<Index>& attached);

}  // namespace gracilis
