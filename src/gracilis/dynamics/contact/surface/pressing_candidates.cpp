#include <gracilis/dynamics/contact/surface/pressing_candidates.hpp>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "gracilis/dynamics/contact/surface/pressing_candidates.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, as Highway asks.
#include <gracilis/dynamics/simd/particle_lanes-inl.hpp>

HWY_BEFORE_NAMESPACE();
namespace gracilis::HWY_NAMESPACE {

/// What rounding may have changed: of shares along an edge, and m.
constexpr float share_rounding = 1e-4f, rounding = 1e-6f;
/// m, more than any distance.
constexpr float always = 1e6f;
constexpr std::size_t lanes = hn::MaxLanes(D());

HWY_INLINE Point all_lanes(const Eigen::Vector3f& v) {
  const D d;
  return {hn::Set(d, v.x()), hn::Set(d, v.y()), hn::Set(d, v.z())};
}

HWY_INLINE PressingBits bits_of(const hn::Mask<D>& mask) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(D(), mask, bytes);
  return bytes[0] | static_cast<PressingBits>(bytes[1]) << 8;
}

HWY_INLINE Point place_of(const Particles& particles, const Index* indices) {
  return load_particles(particles.xyzw.data(), indices).x;
}

/// Edges, one per lane; what lanes without one hold crosses nothing.
struct EdgeLanes {
  Index first_from[lanes], first_to[lanes], second_from[lanes], second_to[lanes];
  HWY_ALIGN float outward_x[lanes] = {}, outward_y[lanes] = {}, outward_z[lanes] = {}, most[lanes] = {};
};

/// As edge_gap tells distances.
HWY_INLINE hn::Mask<D> pressing(const EdgeLanes& edges, const Point& shift, const Particles& of_first,
                                const Particles& of_second) {
  const D d;
  const Point from = place_of(of_first, edges.first_from) + shift, other_from = place_of(of_second, edges.second_from);
  const Point a = place_of(of_first, edges.first_to) + shift - from,
              b = place_of(of_second, edges.second_to) - other_from;
  const Point outward = {hn::Load(d, edges.outward_x), hn::Load(d, edges.outward_y), hn::Load(d, edges.outward_z)};
  const Point between = from - other_from, perpendicular = cross(a, b);
  const V across2 = dot<Math>(perpendicular, perpendicular), apart = dot<Math>(perpendicular, between);
  const V low = hn::Set(d, -share_rounding) * across2, high = hn::Set(d, 1 + share_rounding) * across2;
  const V s = dot<Math>(cross(b, between), perpendicular), t = dot<Math>(cross(a, between), perpendicular);
  const auto is_between = [&](const V& share) HWY_ATTR { return hn::And(hn::Ge(share, low), hn::Le(share, high)); };
  const hn::Mask<D> faces_inward = hn::Lt(dot<Math>(perpendicular, outward), hn::Zero(d));
  const V distance = hn::IfThenElse(faces_inward, hn::Neg(apart), apart);
  const V most = hn::Load(d, edges.most) + hn::Set(d, rounding);
  return hn::And(hn::Lt(distance, most * hn::Sqrt(across2)), hn::And(is_between(s), is_between(t)));
}

PressingBits pressing_edges(std::span<const EdgeEdgeCandidate> block, const ContactSurface& first,
                            const ContactSurface& second, const Eigen::Vector3f& shift, const Particles& of_first,
                            const Particles& of_second) {
  PressingBits bits = 0;
  for (std::size_t at = 0; at < block.size(); at += lanes) {
    EdgeLanes edges;
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      edges.first_from[lane] = edges.first_to[lane] = of_first.count();  // the idle one
      edges.second_from[lane] = edges.second_to[lane] = of_second.count();
      if (at + lane >= block.size()) continue;
      const EdgeEdgeCandidate& candidate = block[at + lane];
      const auto& ends = first.edges[static_cast<std::size_t>(candidate.first)].ends;
      const auto& other_ends = second.edges[static_cast<std::size_t>(candidate.second)].ends;
      edges.first_from[lane] = ends[0], edges.first_to[lane] = ends[1];
      edges.second_from[lane] = other_ends[0], edges.second_to[lane] = other_ends[1];
      edges.outward_x[lane] = candidate.outward.x(), edges.outward_y[lane] = candidate.outward.y();
      edges.outward_z[lane] = candidate.outward.z(), edges.most[lane] = candidate.most_gap;
    }
    bits |= bits_of(pressing(edges, all_lanes(shift), of_first, of_second)) << at;
  }
  return bits;
}

PressingBits pressing_points(std::span<const VertexFaceCandidate> block, const ContactSurface& target,
                             const Eigen::Vector3f& shift, const Particles& of_probe, const Particles& of_target) {
  const D d;
  PressingBits bits = 0;
  for (std::size_t at = 0; at < block.size(); at += lanes) {
    Index particles[lanes], corners[3][lanes];
    HWY_ALIGN float side[lanes] = {}, most[lanes] = {};
    const std::size_t count = std::min(lanes, block.size() - at);
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const VertexFaceCandidate& candidate = block[at + std::min(lane, count - 1)];
      particles[lane] = candidate.particle;
      for (int corner = 0; corner < 3; ++corner) corners[corner][lane] = target.faces(corner, candidate.face);
      side[lane] = candidate.side;
      most[lane] = candidate.distance > 0 ? candidate.most_gap : always;
    }
    const Point corner = place_of(of_target, corners[0]);
    const Point away = place_of(of_probe, particles) + all_lanes(shift) - corner;
    const Point area = cross(place_of(of_target, corners[1]) - corner, place_of(of_target, corners[2]) - corner);
    const V height = hn::Load(d, side) * dot<Math>(area, away);
    const V bound = (hn::Load(d, most) + hn::Set(d, rounding)) * hn::Sqrt(dot<Math>(area, area));
    const PressingBits filled = (PressingBits{1} << count) - 1;
    bits |= (bits_of(hn::Le(height, bound)) & filled) << at;
  }
  return bits;
}

}  // namespace gracilis::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gracilis {

HWY_EXPORT(pressing_edges);
HWY_EXPORT(pressing_points);

PressingBits pressing_edges(std::span<const EdgeEdgeCandidate> block, const ContactSurface& first,
                            const ContactSurface& second, const Eigen::Vector3f& shift, const Particles& of_first,
                            const Particles& of_second) {
  return HWY_DYNAMIC_DISPATCH(pressing_edges)(block, first, second, shift, of_first, of_second);
}

PressingBits pressing_points(std::span<const VertexFaceCandidate> block, const ContactSurface& target,
                             const Eigen::Vector3f& shift, const Particles& of_probe, const Particles& of_target) {
  return HWY_DYNAMIC_DISPATCH(pressing_points)(block, target, shift, of_probe, of_target);
}

}  // namespace gracilis
#endif
