#pragma once

#include <gracilis/core/types.hpp>
#include <gracilis/dynamics/movers.hpp>
#include <gracilis/dynamics/particles.hpp>

#include <array>
#include <vector>

/// Particles of one surface that stay where they lay on another: what pulls at one pulls at the other.
namespace gracilis {

/// A particle of the guest and its place at rest on the host.
struct SurfaceTie {
  Index particle = 0;
  std::array<Index, 3> corners = {};                  ///< of the host's triangle
  Eigen::Vector3f weights = Eigen::Vector3f::Zero();  ///< of the corners, sum 1
  Eigen::Vector3f offset = Eigen::Vector3f::Zero();   ///< m, from there to the particle; turns with the patch
};

/// One surface on another, and the patch of the other that says how it turns.
struct TiedSurfaces {
  Index guest = 0, host = 0;
  Eigen::Vector3f shift = Eigen::Vector3f::Zero();  ///< from the guest's coordinates to the host's, m
  std::vector<SurfaceTie> ties;
  std::vector<Index> patch;     ///< particles of the host
  Eigen::Matrix3Xf patch_rest;  ///< about their mean, m
};

/// Moves both sides of every tie, by their inverse masses, until it holds: x_guest = Σ w x_corner + R offset, R the
/// turn of the patch. Surfaces that are no movers stay. The ties of a list act one after the other.
void project_ties(const std::vector<TiedSurfaces>& ties, const std::vector<Particles*>& particles,
                  const Movers& movers);

/// Puts guests where their hosts are, whatever they weigh. A host that is a guest itself stands before its own guests.
void place_on_host(const TiedSurfaces& tied, const Particles& host, Particles& guest);

}  // namespace gracilis
