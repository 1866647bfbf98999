#pragma once

#include <gracilis/geometry/surface_shape.hpp>
#include <gracilis/geometry/topology.hpp>
#include <gracilis/geometry/triangle_mesh.hpp>
#include <gracilis/simulate/gates.hpp>

#include <vector>

namespace gracilis {

/// What eyes see of a muscle's surface and its volume and mean edge do not tell: spikes, places that have become much
/// thicker or thinner than they are at rest (a rim like a mushroom's), and edges that are drawn out.
class SurfaceFlaws {
 public:
  SurfaceFlaws() = default;  ///< of nothing
  /// Precondition: at least one face, all coordinates finite.
  explicit SurfaceFlaws(const TriangleMesh& rest);
  /// The same where the surface's topology is known.
  SurfaceFlaws(const TriangleMesh& rest, const MeshTopology& topology);

  struct Worst {
    Real spike = 0;       ///< largest of spike_at
    Real thickening = 1;  ///< largest of thickness_at
    Real thinning = 1;    ///< largest of its inverse
  };
  /// Of all vertices. Precondition here and below: as many points as at rest, all finite.
  Worst worst(const Points& points) const;

  /// How much farther a vertex lies from the mean of its neighbors than at rest, over the length of its edges at rest.
  Real spike_at(Index vertex, const Points& points) const;
  /// Thickness over that at rest: the distance to the vertex that this one faces through the muscle. What is thinner
  /// than an edge is not resolved, so the surface's mean edge is added to both. 1 where it faces none.
  Real thickness_at(Index vertex, const Points& points) const;

  /// Per vertex how near it comes to the gates of shape: the largest of its spike, its thickness and its edges, each as
  /// far as it exceeds rest over how far the bar does; 0 at rest, 1 at a bar. An edge has the bar near attachments
  /// where one of its ends is `near` them (see near_attachments), the other bar elsewhere.
  std::vector<Real> shares_of_gates(const Points& points, const std::vector<char>& near,
                                    const QualityGates& gates) const;

  /// Of an edge whose end is `vertex`: its length over that at rest. What is shorter than half the surface's mean edge
  /// counts as that long: how much a needle's edge is drawn out cannot be seen.
  Real edge_ratio(Real length, Real rest_length) const;

 private:
  std::vector<MeshEdge> edges_;
  std::vector<Real> edge_lengths_;  ///< at rest, m
  SurfaceShape shape_;              ///< at rest
};

}  // namespace gracilis
