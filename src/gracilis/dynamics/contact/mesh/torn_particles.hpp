#pragma once

#include <gracilis/dynamics/contact/mesh/contact_surface.hpp>
#include <gracilis/dynamics/particles.hpp>

#include <vector>

namespace gracilis {

/// How often its length at rest an edge may have before its ends count as torn.
inline constexpr float torn_stretch = 2.75f;

/// Marks the particles that are torn between their neighbors and what keeps them from these: the ends of edges that are
/// longer than `torn_stretch` times their length at rest. `rest`: their places at rest, m.
void add_torn(const ContactSurface& surface, const Eigen::Matrix3Xf& rest, const Particles& particles,
              std::vector<char>& torn);

}  // namespace gracilis
