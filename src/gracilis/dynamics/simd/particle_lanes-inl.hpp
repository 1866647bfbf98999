// One particle per lane: loads and stores of particles wherever they are. Included once per instruction set.

#if defined(GRACILIS_PARTICLE_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRACILIS_PARTICLE_LANES_INL
#undef GRACILIS_PARTICLE_LANES_INL
#else
#define GRACILIS_PARTICLE_LANES_INL
#endif

#include <gracilis/core/types.hpp>
#include <gracilis/dynamics/simd/group_width.hpp>
#include <gracilis/dynamics/simd/number_lanes-inl.hpp>

#include <bit>
#include <cstdint>
#include <cstring>

HWY_BEFORE_NAMESPACE();
namespace gracilis::HWY_NAMESPACE {

using D = hn::CappedTag<float, group_width>;
using V = hn::Vec<D>;
using Math = Lanes<D>;
using Point = Vector3<V>;

struct LoadedParticles {
  Point x;
  V w;
};

#if HWY_HAVE_SCALABLE || HWY_TARGET == HWY_SCALAR

/// Positions and inverse masses of one particle per lane.
HWY_INLINE LoadedParticles load_particles(const float* xyzw, const Index* indices) {
  HWY_ALIGN float lanes[4 * group_width];
  for (std::size_t lane = 0; lane < hn::Lanes(D()); ++lane)
    std::memcpy(lanes + 4 * lane, xyzw + 4 * static_cast<std::size_t>(indices[lane]), 4 * sizeof(float));
  LoadedParticles loaded;
  hn::LoadInterleaved4(D(), lanes, loaded.x.x, loaded.x.y, loaded.x.z, loaded.w);
  return loaded;
}

HWY_INLINE void store_particles(float* xyzw, const Index* indices, Point x, V w) {
  HWY_ALIGN float lanes[4 * group_width];
  hn::StoreInterleaved4(x.x, x.y, x.z, w, D(), lanes);
  for (std::size_t lane = 0; lane < hn::Lanes(D()); ++lane)
    std::memcpy(xyzw + 4 * static_cast<std::size_t>(indices[lane]), lanes + 4 * lane, 4 * sizeof(float));
}

#else

/// Four rows of a 4 × 4 matrix per block of 128 bits; transposing them never leaves the registers, where a way through
/// memory would wait for every store.
struct Rows {
  V r0, r1, r2, r3;
};

HWY_INLINE Rows transposed(const Rows& rows) {
  const D d;
  const V a = hn::InterleaveLower(d, rows.r0, rows.r2), b = hn::InterleaveLower(d, rows.r1, rows.r3);
  const V c = hn::InterleaveUpper(d, rows.r0, rows.r2), e = hn::InterleaveUpper(d, rows.r1, rows.r3);
  return {hn::InterleaveLower(d, a, b), hn::InterleaveUpper(d, a, b), hn::InterleaveLower(d, c, e),
          hn::InterleaveUpper(d, c, e)};
}

/// Every fourth particle from the first index on, one per block.
template <class Tag>
HWY_INLINE hn::Vec<Tag> load_every_fourth(Tag tag, const float* xyzw, const Index* indices) {
  if constexpr (hn::MaxLanes(Tag()) == 4) {
    return hn::Load(tag, xyzw + 4 * static_cast<std::size_t>(*indices));
  } else {
    const hn::Half<Tag> half;
    return hn::Combine(tag, load_every_fourth(half, xyzw, indices + hn::MaxLanes(Tag()) / 2),
                       load_every_fourth(half, xyzw, indices));
  }
}

template <class Tag>
HWY_INLINE void store_every_fourth(Tag tag, hn::Vec<Tag> rows, float* xyzw, const Index* indices) {
  if constexpr (hn::MaxLanes(Tag()) == 4) {
    hn::Store(rows, tag, xyzw + 4 * static_cast<std::size_t>(*indices));
  } else {
    const hn::Half<Tag> half;
    store_every_fourth(half, hn::LowerHalf(half, rows), xyzw, indices);
    store_every_fourth(half, hn::UpperHalf(half, rows), xyzw, indices + hn::MaxLanes(Tag()) / 2);
  }
}

/// Positions and inverse masses of one particle per lane.
HWY_INLINE LoadedParticles load_particles(const float* xyzw, const Index* indices) {
  const D d;
  const Rows columns = transposed({load_every_fourth(d, xyzw, indices), load_every_fourth(d, xyzw, indices + 1),
                                   load_every_fourth(d, xyzw, indices + 2), load_every_fourth(d, xyzw, indices + 3)});
  return {{columns.r0, columns.r1, columns.r2}, columns.r3};
}

HWY_INLINE void store_particles(float* xyzw, const Index* indices, Point x, V w) {
  const D d;
  const Rows rows = transposed({x.x, x.y, x.z, w});
  store_every_fourth(d, rows.r0, xyzw, indices);
  store_every_fourth(d, rows.r1, xyzw, indices + 1);
  store_every_fourth(d, rows.r2, xyzw, indices + 2);
  store_every_fourth(d, rows.r3, xyzw, indices + 3);
}

#endif

static_assert(group_width <= 16);

/// Calls act(lane) for the lanes of the mask, in order.
template <class Act>
HWY_INLINE void for_each_lane(hn::Mask<D> mask, const Act& act) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(D(), mask, bytes);
  unsigned bits = bytes[0] | static_cast<unsigned>(bytes[1]) << 8;
  for (; bits != 0; bits &= bits - 1) act(static_cast<std::size_t>(std::countr_zero(bits)));
}

}  // namespace gracilis::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
