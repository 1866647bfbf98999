#pragma once

#include <gracilis/dynamics/contact/surface/contact_world.hpp>

#include <cstdint>
#include <span>

namespace gracilis {

/// So many candidates are asked at once whether they press: few listed ones do, and asking the others one by one is
/// what contact would take its time with.
inline constexpr std::size_t candidates_per_block = 16;
/// One bit per candidate of a block.
using PressingBits = std::uint32_t;

/// Which of up to a block of edges may be nearer to each other than they are asked to keep; rounding never takes one
/// away.
PressingBits pressing_edges(std::span<const EdgeEdgeCandidate> block, const ContactSurface& first,
                            const ContactSurface& second, const Eigen::Vector3f& shift, const Particles& of_first,
                            const Particles& of_second);

/// The same for points. By the plane of the face, which is no farther than the face; a point that was behind it when it
/// was last looked at always may be.
PressingBits pressing_points(std::span<const VertexFaceCandidate> block, const ContactSurface& target,
                             const Eigen::Vector3f& shift, const Particles& of_probe, const Particles& of_target);

}  // namespace gracilis
