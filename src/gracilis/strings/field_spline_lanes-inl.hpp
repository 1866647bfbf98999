// The quadratic B-spline of a distance field (field_spline.hpp), asked for one point per lane. Included once per
// instruction set.

#if defined(GRACILIS_FIELD_SPLINE_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRACILIS_FIELD_SPLINE_LANES_INL
#undef GRACILIS_FIELD_SPLINE_LANES_INL
#else
#define GRACILIS_FIELD_SPLINE_LANES_INL
#endif

#include <gracilis/geometry/field_path.hpp>
#include <gracilis/strings/symmetric_lanes-inl.hpp>

HWY_BEFORE_NAMESPACE();
namespace gracilis::HWY_NAMESPACE {

/// A point in cells of a grid, and whether it is within the grid.
struct GridPlace {
  Point cells;
  hn::Mask<D> inside;
};

HWY_INLINE GridPlace grid_place(const FieldGrid& grid, Point cells) {
  const V zero = hn::Zero(D());
  const auto within = [&](V x, std::size_t axis) HWY_ATTR {
    return hn::And(hn::Ge(x, zero), hn::Lt(x, lanes_of(static_cast<float>(grid.nodes[axis] - 1))));
  };
  return {cells, hn::And(hn::And(within(cells.x, 0), within(cells.y, 1)), within(cells.z, 2))};
}

/// A lower bound of the distance of a point beyond the grid, m.
HWY_INLINE V distance_beyond(const BoundedField& field, Point cells) {
  const V zero = hn::Zero(D());
  const auto beyond = [&](V x, std::size_t axis) HWY_ATTR {
    const V last = lanes_of(static_cast<float>(field.grid.nodes[axis] - 1));
    const float cell = 1 / field.grid.cells_per_metre[static_cast<Index>(axis)];
    return hn::Max(hn::Max(zero - x, x - last), zero) * lanes_of(cell);
  };
  const Point away = {beyond(cells.x, 0), beyond(cells.y, 1), beyond(cells.z, 2)};
  return hn::Sqrt(dot<Math>(away, away)) + lanes_of(field.border);
}

/// The three splines that reach a point on one axis, and their derivatives by the axis in cells.
struct SplineLanes {
  hn::Vec<hn::RebindToSigned<D>> first;
  V weight[3], slope[3];
};

/// In the outermost cells the polynomial of the next ones goes on.
HWY_INLINE SplineLanes spline_lanes(V cells, Index nodes) {
  const D d;
  const hn::RebindToSigned<D> di;
  const V half = lanes_of(0.5f);
  const auto nearest = hn::Min(hn::Max(hn::ConvertTo(di, cells + half), hn::Set(di, 1)), hn::Set(di, nodes - 2));
  const V x = cells - hn::ConvertTo(d, nearest), low = half - x, high = half + x;
  return {nearest - hn::Set(di, 1),
          {half * low * low, lanes_of(0.75f) - x * x, half * high * high},
          {hn::Zero(d) - low, lanes_of(-2) * x, high}};
}

/// Four numbers in a row for each lane, the first three of which are asked for.
struct RowLanes {
  V v[3];
};

#if HWY_HAVE_SCALABLE || HWY_TARGET == HWY_SCALAR
HWY_INLINE RowLanes load_rows(const float* values, hn::Vec<hn::RebindToSigned<D>> at) {
  const D d;
  return {{hn::GatherIndex(d, values, at), hn::GatherIndex(d, values + 1, at), hn::GatherIndex(d, values + 2, at)}};
}
#else
/// The row of every fourth lane from the first on, one per block of 128 bits.
template <class Tag>
HWY_INLINE hn::Vec<Tag> load_every_fourth_row(Tag tag, const float* values, const std::int32_t* at) {
  if constexpr (hn::MaxLanes(Tag()) == 4) {
    return hn::LoadU(tag, values + *at);
  } else {
    const hn::Half<Tag> half;
    return hn::Combine(tag, load_every_fourth_row(half, values, at + hn::MaxLanes(Tag()) / 2),
                       load_every_fourth_row(half, values, at));
  }
}

/// Rows are loaded whole and transposed: gathers take several times as long.
HWY_INLINE RowLanes load_rows(const float* values, const std::int32_t* at) {
  const D d;
  const Rows columns = transposed({load_every_fourth_row(d, values, at), load_every_fourth_row(d, values, at + 1),
                                   load_every_fourth_row(d, values, at + 2), load_every_fourth_row(d, values, at + 3)});
  return {{columns.r0, columns.r1, columns.r2}};
}
#endif

/// The splines around each lane's place, and where the numbers that they weight begin.
struct CellLanes {
  SplineLanes x, y, z;
  Index row, slice;  ///< how many numbers further the next row and slice begin
#if HWY_HAVE_SCALABLE || HWY_TARGET == HWY_SCALAR
  hn::Vec<hn::RebindToSigned<D>> first;
#else
  HWY_ALIGN std::int32_t first[group_width];
#endif

  /// Of the row j and the slice k, from 0 to 2.
  HWY_INLINE RowLanes values(const FieldGrid& grid, int j, int k) const {
    return load_rows(grid.values + (j * row + k * slice), first);
  }
};

/// Preconditions: as sample_spline_lanes.
HWY_INLINE CellLanes cell_lanes(const FieldGrid& grid, const GridPlace& place) {
  const hn::RebindToSigned<D> di;
  const auto inside = [&](V x) HWY_ATTR { return hn::IfThenElseZero(place.inside, x); };
  CellLanes cells;
  cells.x = spline_lanes(inside(place.cells.x), grid.nodes[0]);
  cells.y = spline_lanes(inside(place.cells.y), grid.nodes[1]);
  cells.z = spline_lanes(inside(place.cells.z), grid.nodes[2] - 1);  // rows are read one number too far
  cells.row = grid.nodes[0], cells.slice = grid.nodes[0] * grid.nodes[1];
  const auto first = cells.x.first + hn::Set(di, cells.row) * cells.y.first + hn::Set(di, cells.slice) * cells.z.first;
#if HWY_HAVE_SCALABLE || HWY_TARGET == HWY_SCALAR
  cells.first = first;
#else
  hn::Store(first, di, cells.first);
#endif
  return cells;
}

struct SplineSample {
  V distance;
  Point gradient;  ///< by the point in cells
};

/// Preconditions: inside, at least four nodes along each axis. Other lanes get anything.
HWY_INLINE SplineSample sample_spline_lanes(const FieldGrid& grid, const GridPlace& place) {
  const D d;
  const CellLanes cells = cell_lanes(grid, place);
  const SplineLanes &x = cells.x, &y = cells.y, &z = cells.z;
  const V zero = hn::Zero(d);
  SplineSample sum{zero, {zero, zero, zero}};
  for (int k = 0; k < 3; ++k) {
    V plane = zero, plane_by_x = zero, plane_by_y = zero;
    for (int j = 0; j < 3; ++j) {
      const RowLanes at_row = cells.values(grid, j, k);
      const V* v = at_row.v;
      const V along = hn::MulAdd(x.weight[0], v[0], hn::MulAdd(x.weight[1], v[1], x.weight[2] * v[2]));
      const V along_by_x = hn::MulAdd(x.slope[0], v[0], hn::MulAdd(x.slope[1], v[1], x.slope[2] * v[2]));
      plane = hn::MulAdd(y.weight[j], along, plane);
      plane_by_y = hn::MulAdd(y.slope[j], along, plane_by_y);
      plane_by_x = hn::MulAdd(y.weight[j], along_by_x, plane_by_x);
    }
    sum.distance = hn::MulAdd(z.weight[k], plane, sum.distance);
    sum.gradient.x = hn::MulAdd(z.weight[k], plane_by_x, sum.gradient.x);
    sum.gradient.y = hn::MulAdd(z.weight[k], plane_by_y, sum.gradient.y);
    sum.gradient.z = hn::MulAdd(z.slope[k], plane, sum.gradient.z);
  }
  return sum;
}

}  // namespace gracilis::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
