#include <gracilis/dynamics/contact/surface/surface_ties.hpp>

#include <gracilis/dynamics/leverage.hpp>
#include <gracilis/geometry/rotations.hpp>

#include <algorithm>

namespace gracilis {

namespace {

/// How the patch has turned since rest (Kabsch 1976).
Eigen::Matrix3f turn_of(const TiedSurfaces& tied, const Particles& host) {
  // The patch at rest is about its mean, so the mean of where it is now drops out of the sum.
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < tied.patch.size(); ++i)
    sum +=
        host.position(tied.patch[i]).cast<Real>() * tied.patch_rest.col(static_cast<Index>(i)).cast<Real>().transpose();
  return nearest_rotation(sum).cast<float>();
}

/// Where the tied particle belongs, in the host's coordinates.
Eigen::Vector3f place_on(const SurfaceTie& tie, const Eigen::Matrix3f& turn, const Particles& host) {
  Eigen::Vector3f place = turn * tie.offset;
  for (int k = 0; k < 3; ++k) place += tie.weights[k] * host.position(tie.corners[static_cast<std::size_t>(k)]);
  return place;
}

void project(const TiedSurfaces& tied, bool guest_moves, bool host_moves, Particles& guest, Particles& host) {
  const Eigen::Matrix3f turn = turn_of(tied, host);
  for (const SurfaceTie& tie : tied.ties) {
    const float of_guest = guest_moves ? guest.inverse_mass(tie.particle) : 0;
    std::array<float, 3> of_corner{};
    float sum = of_guest, largest = of_guest;
    for (std::size_t k = 0; k < 3 && host_moves; ++k) {
      of_corner[k] = tie.weights[static_cast<Index>(k)] * host.inverse_mass(tie.corners[k]);
      sum += tie.weights[static_cast<Index>(k)] * of_corner[k];
      largest = std::max(largest, of_corner[k]);
    }
    if (!(sum > 0)) continue;
    const Eigen::Vector3f pull =
        (guest.position(tie.particle) + tied.shift - place_on(tie, turn, host)) / limit_leverage(sum, largest);
    guest.position(tie.particle) -= of_guest * pull;
    for (std::size_t k = 0; k < 3; ++k) host.position(tie.corners[k]) += of_corner[k] * pull;
  }
}

}  // namespace

void project_ties(const std::vector<TiedSurfaces>& ties, const std::vector<Particles*>& particles,
                  const Movers& movers) {
  for (const TiedSurfaces& tied : ties) {
    const auto guest = static_cast<std::size_t>(tied.guest), host = static_cast<std::size_t>(tied.host);
    if (movers.move(guest) || movers.move(host))
      project(tied, movers.move(guest), movers.move(host), *particles[guest], *particles[host]);
  }
}

void place_on_host(const TiedSurfaces& tied, const Particles& host, Particles& guest) {
  const Eigen::Matrix3f turn = turn_of(tied, host);
  for (const SurfaceTie& tie : tied.ties) guest.position(tie.particle) = place_on(tie, turn, host) - tied.shift;
}

}  // namespace gracilis
