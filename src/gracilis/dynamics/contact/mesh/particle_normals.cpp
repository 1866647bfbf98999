#include <gracilis/dynamics/contact/mesh/particle_normals.hpp>

#include <gracilis/core/parallel.hpp>

#include <algorithm>
#include <numeric>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "gracilis/dynamics/contact/mesh/particle_normals.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, as Highway asks.
#include <gracilis/dynamics/simd/particle_lanes-inl.hpp>

HWY_BEFORE_NAMESPACE();
namespace gracilis::HWY_NAMESPACE {

/// One over the length of v, 0 where it has none.
HWY_INLINE V inverse_length(const Point& v) {
  const D d;
  const V length2 = dot<Math>(v, v), least = hn::Set(d, 1e-37f);
  return hn::IfThenElseZero(hn::Gt(length2, least), Math::inverse_sqrt(hn::Max(length2, least)));
}

/// The normal of one particle per lane.
HWY_INLINE Point normals_of(const ContactSurface& surface, const Particles& particles, const Index* listed) {
  const D d;
  constexpr std::size_t lanes = hn::MaxLanes(D());
  const float* xyzw = particles.xyzw.data();
  const Point own = load_particles(xyzw, listed).x;
  Index begin[lanes], end[lanes], most = 0;
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const auto at = static_cast<std::size_t>(listed[lane]);
    const bool is_idle = listed[lane] >= particles.count();
    begin[lane] = is_idle ? 0 : surface.vertex_faces.offsets[at];
    end[lane] = is_idle ? 0 : surface.vertex_faces.offsets[at + 1];
    most = std::max(most, end[lane] - begin[lane]);
  }
  Point sum = {hn::Zero(d), hn::Zero(d), hn::Zero(d)};
  for (Index k = 0; k < most; ++k) {
    Index next[lanes], last[lanes];
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const bool has_face = begin[lane] + k < end[lane];
      next[lane] = has_face ? surface.vertex_faces.ends(0, begin[lane] + k) : listed[lane];
      last[lane] = has_face ? surface.vertex_faces.ends(1, begin[lane] + k) : listed[lane];
    }
    const Point along = load_particles(xyzw, next).x - own, back = load_particles(xyzw, last).x - own;
    const Point normal = cross(along, back);
    const V inverse = inverse_length(normal), length = inverse * dot<Math>(normal, normal);
    sum = sum + scaled(atan2<Math>(length, dot<Math>(along, back)) * inverse, normal);
  }
  return scaled(inverse_length(sum), sum);
}

void make_normals(const ContactSurface& surface, const Particles& particles, const Index* listed, Index count,
                  Eigen::Matrix3Xf& normals) {
  const D d;
  constexpr auto lanes = static_cast<Index>(hn::MaxLanes(D()));
  for (Index at = 0; at < count; at += lanes) {
    const Index here = std::min(lanes, count - at);
    Index group[lanes];
    for (Index lane = 0; lane < lanes; ++lane) group[lane] = lane < here ? listed[at + lane] : particles.count();
    const Point normal = normals_of(surface, particles, group);
    HWY_ALIGN float xyz[3][lanes];
    hn::Store(normal.x, d, xyz[0]), hn::Store(normal.y, d, xyz[1]), hn::Store(normal.z, d, xyz[2]);
    for (Index lane = 0; lane < here; ++lane)
      normals.col(group[lane]) = Eigen::Vector3f(xyz[0][lane], xyz[1][lane], xyz[2][lane]);
  }
}

}  // namespace gracilis::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gracilis {

HWY_EXPORT(make_normals);

void particle_normals(const ContactSurface& surface, const Particles& particles, const std::vector<Index>& listed,
                      Eigen::Matrix3Xf& normals) {
  constexpr Index chunk = 16 * group_width;
  parallel_for(static_cast<Index>(listed.size()), chunk, [&](Index begin, Index end) {
    HWY_DYNAMIC_DISPATCH(make_normals)(surface, particles, listed.data() + begin, end - begin, normals);
  });
}

void particle_normals(const ContactSurface& surface, const Particles& particles, Eigen::Matrix3Xf& normals) {
  normals.resize(3, particles.count());
  std::vector<Index> all(static_cast<std::size_t>(particles.count()));
  std::iota(all.begin(), all.end(), 0);
  particle_normals(surface, particles, all, normals);
}

}  // namespace gracilis
#endif
