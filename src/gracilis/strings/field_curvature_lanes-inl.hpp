// The quadratic B-spline of a distance field with its second derivatives, one point per lane. Included once per
// instruction set.

#if defined(GRACILIS_FIELD_CURVATURE_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRACILIS_FIELD_CURVATURE_LANES_INL
#undef GRACILIS_FIELD_CURVATURE_LANES_INL
#else
#define GRACILIS_FIELD_CURVATURE_LANES_INL
#endif

#include <gracilis/strings/field_spline_lanes-inl.hpp>

HWY_BEFORE_NAMESPACE();
namespace gracilis::HWY_NAMESPACE {

struct CurvedSplineSample {
  V distance;
  Point gradient;            ///< by the point in cells
  SymmetricLanes curvature;  ///< the same twice
};

/// Sums of three numbers along an axis: by its splines, their derivatives and their second derivatives.
struct CurvedSum {
  V value, slope, bend;
};

HWY_INLINE CurvedSum curved_sum(const SplineLanes& axis, V a, V b, V c) {
  return {hn::MulAdd(axis.weight[0], a, hn::MulAdd(axis.weight[1], b, axis.weight[2] * c)),
          hn::MulAdd(axis.slope[0], a, hn::MulAdd(axis.slope[1], b, axis.slope[2] * c)),
          hn::NegMulAdd(lanes_of(2), b, a + c)};
}

/// Preconditions: as sample_spline_lanes.
HWY_INLINE CurvedSplineSample sample_curved_lanes(const FieldGrid& grid, const GridPlace& place) {
  const CellLanes cells = cell_lanes(grid, place);
  const SplineLanes &x = cells.x, &y = cells.y, &z = cells.z;
  CurvedSum plane[3], by_x[3];
  V by_xx[3];
  for (int k = 0; k < 3; ++k) {
    CurvedSum rows[3];
    for (int j = 0; j < 3; ++j) {
      const RowLanes at_row = cells.values(grid, j, k);
      rows[j] = curved_sum(x, at_row.v[0], at_row.v[1], at_row.v[2]);
    }
    plane[k] = curved_sum(y, rows[0].value, rows[1].value, rows[2].value);
    by_x[k] = curved_sum(y, rows[0].slope, rows[1].slope, rows[2].slope);
    by_xx[k] = curved_sum(y, rows[0].bend, rows[1].bend, rows[2].bend).value;
  }
  const CurvedSum value = curved_sum(z, plane[0].value, plane[1].value, plane[2].value);
  const CurvedSum along_y = curved_sum(z, plane[0].slope, plane[1].slope, plane[2].slope);
  const CurvedSum along_x = curved_sum(z, by_x[0].value, by_x[1].value, by_x[2].value);
  return {value.value,
          {along_x.value, along_y.value, value.slope},
          {curved_sum(z, by_xx[0], by_xx[1], by_xx[2]).value,
           curved_sum(z, by_x[0].slope, by_x[1].slope, by_x[2].slope).value, along_x.slope,
           curved_sum(z, plane[0].bend, plane[1].bend, plane[2].bend).value, along_y.slope, value.bend}};
}

}  // namespace gracilis::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
