// Distance fields asked for one point per lane. Included once per instruction set.

#if defined(GRACILIS_FIELD_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRACILIS_FIELD_LANES_INL
#undef GRACILIS_FIELD_LANES_INL
#else
#define GRACILIS_FIELD_LANES_INL
#endif

#include <gracilis/dynamics/contact/field/near_field.hpp>
#include <gracilis/dynamics/simd/particle_lanes-inl.hpp>

HWY_BEFORE_NAMESPACE();
namespace gracilis::HWY_NAMESPACE {

using Mask = hn::Mask<D>;

HWY_INLINE V number(float x) { return hn::Set(D(), x); }

HWY_INLINE Point to_obstacle(const FieldPlacement& placement, const Point& x) {
  const Eigen::Matrix3f& r = placement.rotation;
  const auto row = [&](Index i) HWY_ATTR {
    return hn::MulAdd(
        number(r(i, 0)), x.x,
        hn::MulAdd(number(r(i, 1)), x.y, hn::MulAdd(number(r(i, 2)), x.z, number(placement.translation[i]))));
  };
  return {row(0), row(1), row(2)};
}

/// A direction in the obstacle's frame, seen from the particles'.
HWY_INLINE Point turned_back(const FieldPlacement& placement, const Point& direction) {
  const Eigen::Matrix3f& r = placement.rotation;
  const auto column = [&](Index i) HWY_ATTR {
    return hn::MulAdd(number(r(0, i)), direction.x,
                      hn::MulAdd(number(r(1, i)), direction.y, number(r(2, i)) * direction.z));
  };
  return {column(0), column(1), column(2)};
}

struct SampledField {
  V distance;
  Point gradient;
};

/// Like sample(grid, point), for lanes in `asked`. Outside of the grid the distance is infinite and the gradient zero.
HWY_INLINE SampledField sample(const FieldGrid& grid, const Point& p, Mask asked) {
  const D d;
  const hn::RebindToSigned<D> di;
  const V zero = hn::Zero(d);
  const auto inside_axis = [&](const V& f, std::size_t axis) HWY_ATTR {
    return hn::And(hn::Ge(f, zero), hn::Lt(f, number(static_cast<float>(grid.nodes[axis] - 1))));
  };
  const V fx = (p.x - number(grid.origin.x())) * number(grid.cells_per_metre.x()),
          fy = (p.y - number(grid.origin.y())) * number(grid.cells_per_metre.y()),
          fz = (p.z - number(grid.origin.z())) * number(grid.cells_per_metre.z());
  const Mask inside = hn::And(hn::And(inside_axis(fx, 0), inside_axis(fy, 1)), hn::And(inside_axis(fz, 2), asked));
  const auto cell = [&](const V& f) HWY_ATTR { return hn::ConvertTo(di, hn::IfThenElseZero(inside, f)); };
  const auto i = cell(fx), j = cell(fy), k = cell(fz);
  const V x = fx - hn::ConvertTo(d, i), y = fy - hn::ConvertTo(d, j), z = fz - hn::ConvertTo(d, k);
  const std::int32_t row = grid.nodes[0], slice = grid.nodes[0] * grid.nodes[1];
  const auto at = i + hn::Set(di, row) * j + hn::Set(di, slice) * k;
  const auto value = [&](std::int32_t offset) HWY_ATTR { return hn::GatherIndex(d, grid.values + offset, at); };
  const V v000 = value(0), v100 = value(1), v010 = value(row), v110 = value(row + 1), v001 = value(slice),
          v101 = value(slice + 1), v011 = value(slice + row), v111 = value(slice + row + 1);
  const V d00 = v100 - v000, d10 = v110 - v010, d01 = v101 - v001, d11 = v111 - v011;
  const V v00 = hn::MulAdd(x, d00, v000), v10 = hn::MulAdd(x, d10, v010), v01 = hn::MulAdd(x, d01, v001),
          v11 = hn::MulAdd(x, d11, v011);
  const V v0 = hn::MulAdd(y, v10 - v00, v00), v1 = hn::MulAdd(y, v11 - v01, v01);
  const V dx0 = hn::MulAdd(y, d10 - d00, d00), dx1 = hn::MulAdd(y, d11 - d01, d01);
  const auto slope = [&](const V& per_cell, float cells_per_metre)
                         HWY_ATTR { return hn::IfThenElseZero(inside, per_cell * number(cells_per_metre)); };
  SampledField sampled;
  sampled.distance = hn::IfThenElse(inside, hn::MulAdd(z, v1 - v0, v0), hn::Inf(d));
  sampled.gradient.x = slope(hn::MulAdd(z, dx1 - dx0, dx0), grid.cells_per_metre.x());
  sampled.gradient.y = slope(hn::MulAdd(z, (v11 - v01) - (v10 - v00), v10 - v00), grid.cells_per_metre.y());
  sampled.gradient.z = slope(v1 - v0, grid.cells_per_metre.z());
  return sampled;
}

}  // namespace gracilis::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
