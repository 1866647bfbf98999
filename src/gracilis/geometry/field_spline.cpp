#include <gracilis/geometry/field_spline.hpp>

#include <cmath>
#include <utility>

namespace gracilis {

namespace {

/// Where a point is on one axis: its nearest node, and the three values of the B-splines that reach it, with their
/// derivatives by the axis in cells.
template <class Number>
struct SplineAxis {
  SplineAxis(Number cells, Index nodes) {
    const auto nearest = static_cast<Index>(std::floor(cells + Number(0.5)));
    inside = nearest >= 1 && nearest + 1 < nodes;
    first = nearest - 1;
    const Number x = cells - static_cast<Number>(nearest), low = Number(0.5) - x, high = Number(0.5) + x;
    weight[0] = low * low / 2, weight[1] = Number(0.75) - x * x, weight[2] = high * high / 2;
    slope[0] = -low, slope[1] = -2 * x, slope[2] = high;
  }
  bool inside = false;
  Index first = 0;
  Number weight[3], slope[3];
};

template <class Number>
struct SplinePlace {
  using Vector = Eigen::Matrix<Number, 3, 1>;
  SplinePlace(const FieldGrid& grid, const Vector& p)
      : cells((p - grid.origin.cast<Number>()).cwiseProduct(grid.cells_per_metre.cast<Number>())),
        x(cells.x(), grid.nodes[0]),
        y(cells.y(), grid.nodes[1]),
        z(cells.z(), grid.nodes[2]) {}
  bool inside() const { return x.inside && y.inside && z.inside; }
  Vector cells;
  SplineAxis<Number> x, y, z;
};

const float* first_value(const FieldGrid& grid, Index x, Index y, Index z) {
  const auto row = static_cast<std::size_t>(grid.nodes[0]), slice = row * static_cast<std::size_t>(grid.nodes[1]);
  return grid.values + static_cast<std::size_t>(x) + row * static_cast<std::size_t>(y) +
         slice * static_cast<std::size_t>(z);
}

/// Value and, by the axes in cells, gradient. Precondition: inside.
template <class Number>
std::pair<Number, Eigen::Matrix<Number, 3, 1>> sum_splines(const FieldGrid& grid, const SplinePlace<Number>& at) {
  Number value = 0, by_x = 0, by_y = 0, by_z = 0;
  for (Index k = 0; k < 3; ++k) {
    Number plane = 0, plane_by_x = 0, plane_by_y = 0;
    for (Index j = 0; j < 3; ++j) {
      const float* v = first_value(grid, at.x.first, at.y.first + j, at.z.first + k);
      const Number a = v[0], b = v[1], c = v[2];
      const Number row = at.x.weight[0] * a + at.x.weight[1] * b + at.x.weight[2] * c;
      plane += at.y.weight[j] * row, plane_by_y += at.y.slope[j] * row;
      plane_by_x += at.y.weight[j] * (at.x.slope[0] * a + at.x.slope[1] * b + at.x.slope[2] * c);
    }
    value += at.z.weight[k] * plane, by_z += at.z.slope[k] * plane;
    by_x += at.z.weight[k] * plane_by_x, by_y += at.z.weight[k] * plane_by_y;
  }
  return {value, {by_x, by_y, by_z}};
}

}  // namespace

FieldSample sample_spline(const FieldGrid& grid, const Eigen::Vector3f& p) {
  const SplinePlace<float> at(grid, p);
  if (!at.inside()) return sample(grid, p);
  const auto [value, gradient] = sum_splines(grid, at);
  return {value, gradient.cwiseProduct(grid.cells_per_metre)};
}

PreciseSample sample_spline_precise(const FieldGrid& grid, const Vec3& p) {
  const SplinePlace<Real> at(grid, p);
  if (!at.inside()) {
    const FieldSample flat = sample(grid, p.cast<float>());
    return {static_cast<Real>(flat.distance), flat.gradient.cast<Real>()};
  }
  const auto [value, gradient] = sum_splines(grid, at);
  return {value, gradient.cwiseProduct(grid.cells_per_metre.cast<Real>())};
}

CurvedSample sample_spline_curved(const FieldGrid& grid, const Vec3& p) {
  const SplinePlace<Real> at(grid, p);
  if (!at.inside()) {
    const FieldSample flat = sample(grid, p.cast<float>());
    return {static_cast<Real>(flat.distance), flat.gradient.cast<Real>()};
  }
  static constexpr Real bend[3] = {1, -2, 1};
  Real value = 0;
  Vec3 gradient = Vec3::Zero();
  Eigen::Matrix3d curvature = Eigen::Matrix3d::Zero();
  for (Index k = 0; k < 3; ++k)
    for (Index j = 0; j < 3; ++j) {
      const float* values = first_value(grid, at.x.first, at.y.first + j, at.z.first + k);
      for (Index i = 0; i < 3; ++i) {
        const Real v = static_cast<Real>(values[i]);
        const Real x = at.x.weight[i], y = at.y.weight[j], z = at.z.weight[k];
        const Real dx = at.x.slope[i], dy = at.y.slope[j], dz = at.z.slope[k];
        value += v * x * y * z;
        gradient += v * Vec3(dx * y * z, x * dy * z, x * y * dz);
        curvature.diagonal() += v * Vec3(bend[i] * y * z, x * bend[j] * z, x * y * bend[k]);
        curvature(0, 1) += v * dx * dy * z, curvature(0, 2) += v * dx * y * dz, curvature(1, 2) += v * x * dy * dz;
      }
    }
  curvature(1, 0) = curvature(0, 1), curvature(2, 0) = curvature(0, 2), curvature(2, 1) = curvature(1, 2);
  const Vec3 scale = grid.cells_per_metre.cast<Real>();
  return {value, gradient.cwiseProduct(scale), scale.asDiagonal() * curvature * scale.asDiagonal()};
}

FieldSample sample_spline_bounded(const BoundedField& bounded, const Eigen::Vector3f& p) {
  const FieldSample answer = sample_spline(bounded.grid, p);
  return answer.distance < std::numeric_limits<float>::infinity() ? answer : sample_bounded(bounded, p);
}

}  // namespace gracilis
