#include <gracilis/dynamics/contact/mesh/torn_particles.hpp>

namespace gracilis {

void add_torn(const ContactSurface& surface, const Eigen::Matrix3Xf& rest, const Particles& particles,
              std::vector<char>& torn) {
  for (const ContactSurface::Edge& edge : surface.edges) {
    const auto [a, b] = edge.ends;
    const float length2 = (particles.position(a) - particles.position(b)).squaredNorm();
    if (length2 <= torn_stretch * torn_stretch * (rest.col(a) - rest.col(b)).squaredNorm()) continue;
    torn[static_cast<std::size_t>(a)] = torn[static_cast<std::size_t>(b)] = 1;
  }
}

}  // namespace gracilis
