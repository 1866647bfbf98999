#include <gracilis/methods/tissue/cell_energy.hpp>

#include <algorithm>
#include <limits>

namespace gracilis::tissue {

namespace {

using Tetrahedron = Eigen::Matrix<Real, 3, 4>;

Tetrahedron corners_of(const std::array<Index, 4>& tetrahedron, const Corners& corners) {
  Tetrahedron x;
  for (std::size_t k = 0; k < 4; ++k) x.col(static_cast<Index>(k)) = corners.col(tetrahedron[k]);
  return x;
}

void add(const Tetrahedron& gradient, const std::array<Index, 4>& tetrahedron, Corners& sum) {
  for (std::size_t k = 0; k < 4; ++k) sum.col(tetrahedron[k]) += gradient.col(static_cast<Index>(k));
}

}  // namespace

CellWeights cell_weights(const CubeCut& cut, Real cell_size, const std::array<Real, 5>& fills) {
  // So little that a cell which samples found empty has a mean, too.
  constexpr Real trace = 1e-3;
  CellWeights weights;
  Real sum = 0;
  for (std::size_t t = 0; t < 5; ++t) {
    weights.volumes[t] = std::max(least_fill, fills[t]) * cut.shares[t] * cell_size * cell_size * cell_size;
    weights.volume += weights.volumes[t];
    sum += weights.shares[t] = std::max(trace, fills[t]) * cut.shares[t];
  }
  for (Real& share : weights.shares) share /= sum;
  return weights;
}

CellState cell_energy(const CubeCut& cut, Real cell_size, const std::array<Real, 5>& fills, const CellLaw& law,
                      const Corners& corners) {
  CellState state;
  Real mean_j = 0;
  Corners mean_gradient = Corners::Zero();
  const CellWeights weights = cell_weights(cut, cell_size, fills);
  const Real volume = weights.volume;
  for (std::size_t t = 0; t < 5; ++t) {
    const Tetrahedron gradients = cut.shape_gradients[t] / cell_size;
    const Matrix3 f = corners_of(cut.tetrahedra[t], corners) * gradients.transpose();
    const Matrix3 cofactor = cofactors(f);
    const Real j = f.col(0).dot(cofactor.col(0));
    state.least_volume_ratio = std::min(state.least_volume_ratio, j);
    if (!(j > 0)) {
      state.energy = std::numeric_limits<Real>::infinity();
      return state;
    }
    Matrix3 stress;
    state.energy += weights.volumes[t] * tissue_energy(law.matrix, law.fibers, law.direction, f, stress);
    add(weights.volumes[t] * stress * gradients, cut.tetrahedra[t], state.gradient);
    mean_j += weights.shares[t] * j;
    add(weights.shares[t] * cofactor * gradients, cut.tetrahedra[t], mean_gradient);
  }
  state.energy += volume * law.bulk / 2 * (mean_j - 1) * (mean_j - 1);
  state.gradient += volume * law.bulk * (mean_j - 1) * mean_gradient;
  return state;
}

Matrix24 cell_hessian(const CubeCut& cut, Real cell_size, const std::array<Real, 5>& fills, const CellLaw& law,
                      const Corners& corners) {
  const CellWeights weights = cell_weights(cut, cell_size, fills);
  const Real volume = weights.volume;
  Real mean_j = 0;
  Corners mean_gradient = Corners::Zero();
  for (std::size_t t = 0; t < 5; ++t) {
    const Tetrahedron gradients = cut.shape_gradients[t] / cell_size;
    const Matrix3 f = corners_of(cut.tetrahedra[t], corners) * gradients.transpose();
    mean_j += weights.shares[t] * f.determinant();
    add(weights.shares[t] * cofactors(f) * gradients, cut.tetrahedra[t], mean_gradient);
  }
  // What holds the mean volume acts on each tetrahedron as a pressure.
  const Real force = volume * law.bulk * (mean_j - 1);
  const Eigen::Map<const Eigen::Matrix<Real, 24, 1>> m(mean_gradient.data());
  Matrix24 h = volume * law.bulk * m * m.transpose();
  for (std::size_t t = 0; t < 5; ++t) {
    const Tetrahedron gradients = cut.shape_gradients[t] / cell_size;
    const Matrix3 f = corners_of(cut.tetrahedra[t], corners) * gradients.transpose();
    Matrix9 by_f = tissue_hessian(law.matrix, law.fibers, law.direction, f);
    const Real pressure = force * weights.shares[t] / weights.volumes[t];
    for (Index a = 0; a < 3; ++a)
      for (Index sign : {1, 2}) {
        const Index b = (a + sign) % 3;
        const Vec3 v = f.col(3 - a - b);
        const Matrix3 cross{{0, -v.z(), v.y()}, {v.z(), 0, -v.x()}, {-v.y(), v.x(), 0}};
        by_f.block<3, 3>(3 * a, 3 * b) += (sign == 1 ? -pressure : pressure) * cross;
      }
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t k = 0; k < 4; ++k) {
        Matrix3 block = Matrix3::Zero();
        for (Index a = 0; a < 3; ++a)
          for (Index b = 0; b < 3; ++b)
            block += gradients(a, static_cast<Index>(i)) * gradients(b, static_cast<Index>(k)) *
                     by_f.block<3, 3>(3 * a, 3 * b);
        h.block<3, 3>(3 * cut.tetrahedra[t][i], 3 * cut.tetrahedra[t][k]) += weights.volumes[t] * block;
      }
  }
  return h;
}

}  // namespace gracilis::tissue
