// The ends of edges, one edge per lane: loaded, moved, counted. Included once per instruction set.

#if defined(GRACILIS_EDGE_ENDS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRACILIS_EDGE_ENDS_INL
#undef GRACILIS_EDGE_ENDS_INL
#else
#define GRACILIS_EDGE_ENDS_INL
#endif

#include <gracilis/dynamics/constraints/distance.hpp>
#include <gracilis/dynamics/constraints/multiplier-inl.hpp>
#include <gracilis/dynamics/simd/particle_lanes-inl.hpp>

HWY_BEFORE_NAMESPACE();
namespace gracilis::HWY_NAMESPACE {

/// The ends of the edges in the slots from `at` on, one edge per lane.
struct LoadedEdges {
  const Index *ia, *ib;
  LoadedParticles a, b;

  HWY_INLINE V weight() const { return a.w + b.w; }
};

HWY_INLINE LoadedEdges load_edges(const DistanceSet& set, std::size_t at, const Particles& particles) {
  const Index *ia = set.a.data() + at, *ib = set.b.data() + at;
  return {ia, ib, load_particles(particles.xyzw.data(), ia), load_particles(particles.xyzw.data(), ib)};
}

/// How much longer each has become since the particles were at `start`, to first order: ∇C·(x - xⁿ).
HWY_INLINE V motion_of(const LoadedEdges& edges, Point direction, const Particles& start) {
  return motion_along(direction, edges.b.x, start.xyzw.data(), edges.ib) -
         motion_along(direction, edges.a.x, start.xyzw.data(), edges.ia);
}

/// Moves the second end by `share` of `along` times its inverse mass, the first the other way by its own.
HWY_INLINE void move_ends(const LoadedEdges& edges, V share, Point along, Particles& particles) {
  const LoadedParticles &a = edges.a, &b = edges.b;
  store_particles(particles.xyzw.data(), edges.ia, a.x - scaled(a.w * share, along), a.w);
  store_particles(particles.xyzw.data(), edges.ib, b.x + scaled(b.w * share, along), b.w);
}

/// How many of the edges have ends that coincide, so that nothing tells where to, though one could move.
HWY_INLINE Index count_without_direction(const V& length, const V& weight) {
  const D d;
  return static_cast<Index>(hn::CountTrue(d, hn::And(hn::Lt(length, hn::Set(d, 1e-12f)), hn::Gt(weight, hn::Zero(d)))));
}

}  // namespace gracilis::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
