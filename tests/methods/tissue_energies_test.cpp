#include <gracilis/geometry/field_spline.hpp>
#include <gracilis/methods/tissue/cell_energy.hpp>
#include <gracilis/methods/tissue/point_energy.hpp>

#include <shapes.hpp>

#include <gtest/gtest.h>

#include <functional>
#include <random>

namespace gracilis::tissue {
namespace {

/// Central differences with this step of the quantities below are good to six digits.
constexpr Real h = 1e-6, digits = 2e-6;

const MatrixLaw matrix = {5e3, 1e5};
const FiberLaw fibers = {2e4, 5e4, 1.5e5, 1.1};
const Vec3 along = Vec3(0.3, -0.5, 0.8).normalized();

/// Somewhat stretched, sheared and rotated.
Matrix3 deformed(unsigned seed, Real size = 0.3) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<Real> uniform(-size, size);
  Matrix3 f = Matrix3::Identity();
  for (Index i = 0; i < 9; ++i) f.data()[i] += uniform(generator);
  return Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()) * f;
}

/// The larger of both, to compare derivatives with.
Real scale(const auto& a, const auto& b) { return std::max(a.norm(), b.norm()); }

void expect_derivatives(const MatrixLaw& matrix_law, const FiberLaw& fiber_law, const Matrix3& f) {
  Matrix3 stress, differences, ignored;
  tissue_energy(matrix_law, fiber_law, along, f, stress);
  const Matrix9 hessian = tissue_hessian(matrix_law, fiber_law, along, f);
  Matrix9 second;
  for (Index i = 0; i < 9; ++i) {
    Matrix3 up = f, down = f, stress_up, stress_down;
    up.data()[i] += h, down.data()[i] -= h;
    differences.data()[i] = (tissue_energy(matrix_law, fiber_law, along, up, stress_up) -
                             tissue_energy(matrix_law, fiber_law, along, down, stress_down)) /
                            (2 * h);
    second.col(i) = (stress_up - stress_down).reshaped() / (2 * h);
  }
  EXPECT_LT((stress - differences).norm(), digits * scale(stress, differences));
  EXPECT_LT((hessian - second).norm(), digits * scale(hessian, second));
}

TEST(TissueEnergies, stress_and_its_derivatives_of_the_matrix_are_those_of_its_energy) {
  for (unsigned seed = 1; seed < 6; ++seed) expect_derivatives(matrix, {}, deformed(seed));
}

TEST(TissueEnergies, stress_and_its_derivatives_are_those_of_the_energy_of_a_matrix_that_stiffens) {
  const MatrixLaw stiffening = {5e3, 1e5, 0.5};
  for (unsigned seed = 1; seed < 6; ++seed) expect_derivatives(stiffening, {}, deformed(seed, 0.6));
}

TEST(TissueEnergies, a_matrix_that_stiffens_resists_as_much_at_first_and_ten_times_as_much_at_three_times_its_length) {
  const MatrixLaw even = {5e3, 1e5, 0}, stiffening = {5e3, 1e5, 0.2};
  const auto stress_at = [](const MatrixLaw& law, Real stretch) {
    Matrix3 stress;
    const Real across = 1 / std::sqrt(stretch);
    tissue_energy(law, {}, Vec3::Zero(), Vec3(across, across, stretch).asDiagonal(), stress);
    return stress(2, 2) - stress(0, 0) * across / stretch;  // with the pressure that frees the sides
  };
  EXPECT_NEAR(stress_at(stiffening, 1.1) / stress_at(even, 1.1), 1, 0.001);
  EXPECT_NEAR(stress_at(stiffening, 2) / stress_at(even, 2), 1.8, 1e-6);
  EXPECT_NEAR(stress_at(stiffening, 3) / stress_at(even, 3), 1 + 0.2 * 400.0 / 9, 1e-6);
  EXPECT_EQ(shear_curve(stiffening, 2.9).slope, even.shear) << "squeezed";
}

TEST(TissueEnergies, stress_and_its_derivatives_of_the_fibers_are_those_of_their_energy) {
  for (unsigned seed = 1; seed < 6; ++seed) expect_derivatives({1, 0}, fibers, deformed(seed));
}

TEST(TissueEnergies, stress_and_its_derivatives_are_those_of_the_energy_where_little_volume_is_left) {
  for (const Real left : {0.02, 0.1, 0.25})
    expect_derivatives(matrix, fibers, deformed(3, 0.1) * Vec3(1, 1, left).asDiagonal());
}

TEST(TissueEnergies, tension_is_the_slope_of_the_fibers_energy_at_any_stretch_and_never_negative) {
  for (Real stretch = 0.2; stretch < 2.2; stretch += 0.0137) {
    const Curve curve = fiber_curve(fibers, stretch);
    const Real above = fiber_curve(fibers, stretch + h).energy, below = fiber_curve(fibers, stretch - h).energy;
    EXPECT_NEAR(curve.slope, (above - below) / (2 * h), 1e-5 * fibers.active_tension) << stretch;
    EXPECT_GT(curve.slope, 0) << stretch;
  }
}

TEST(TissueEnergies, active_fibers_pull_hardest_at_their_optimal_stretch_and_not_at_all_beyond_its_ends) {
  const FiberLaw active = {0, 0, 1e5, 1.2};
  EXPECT_DOUBLE_EQ(fiber_curve(active, 1.2).slope, 1e5);
  EXPECT_NEAR(fiber_curve(active, 0.6 * 1.2).slope, 0.36e5, 1);  // by the formula of either side
  for (const Real end : {0.39, 1.61}) EXPECT_EQ(fiber_curve(active, end * 1.2).slope, 0);
}

TEST(TissueEnergies, the_matrix_has_no_stress_at_rest_and_infinite_energy_without_volume) {
  Matrix3 stress;
  EXPECT_EQ(tissue_energy(matrix, {}, along, Matrix3::Identity(), stress), 0);
  EXPECT_LT(stress.norm(), 1e-9);
  EXPECT_GT(volume_curve(matrix, 1e-300).energy, 1e6);
}

TEST(TissueEnergies, what_resists_shear_more_resists_being_squeezed_to_nothing_more) {
  const MatrixLaw soft = {5e3, 1e5}, stiff = {5e4, 1e5};
  constexpr Real nearly_nothing = 1e-3;
  EXPECT_NEAR(volume_curve(stiff, nearly_nothing).slope / volume_curve(soft, nearly_nothing).slope, 10, 0.2);
  EXPECT_EQ(volume_curve(stiff, 0.31).curvature, volume_curve(soft, 0.31).curvature) << "no barrier yet";
}

const std::array<Real, 5> fills = {0.6, 0.2, 1, 0.05, 0.7}, full = {1, 1, 1, 1, 1};

Corners moved_corners(unsigned seed, Real cell_size) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<Real> uniform(-0.1, 0.1);
  Corners corners;
  for (Index c = 0; c < 8; ++c)
    for (Index axis = 0; axis < 3; ++axis) corners(axis, c) = cell_size * (((c >> axis) & 1) + uniform(generator));
  return deformed(seed, 0.1) * corners;
}

TEST(TissueEnergies, forces_on_a_cells_corners_and_their_derivatives_are_those_of_its_energy) {
  const Real size = 0.008;
  const CellLaw law = {matrix, 5e5, fibers, along};
  for (const int parity : {0, 1}) {
    const CubeCut& cut = cube_cut(parity);
    const Corners corners = moved_corners(7, size);
    const CellState state = cell_energy(cut, size, fills, law, corners);
    const Matrix24 hessian = cell_hessian(cut, size, fills, law, corners);
    EXPECT_GT(state.least_volume_ratio, 0);
    Corners differences;
    Matrix24 second;
    for (Index i = 0; i < 24; ++i) {
      Corners up = corners, down = corners;
      up.data()[i] += h * size, down.data()[i] -= h * size;
      const CellState above = cell_energy(cut, size, fills, law, up), below = cell_energy(cut, size, fills, law, down);
      differences.data()[i] = (above.energy - below.energy) / (2 * h * size);
      second.col(i) = (above.gradient - below.gradient).reshaped() / (2 * h * size);
    }
    EXPECT_LT((state.gradient - differences).norm(), digits * scale(state.gradient, differences));
    EXPECT_LT((hessian - second).norm(), digits * scale(hessian, second));
  }
}

TEST(TissueEnergies, a_cell_moved_rigidly_feels_no_force_and_one_turned_inside_out_has_infinite_energy) {
  const CellLaw law = {matrix, 5e5, {}, along};
  Corners corners = moved_corners(1, 0);
  for (Index c = 0; c < 8; ++c) corners.col(c) = 0.008 * Vec3(c & 1, (c >> 1) & 1, c >> 2);
  const RigidTransform by = Eigen::Translation3d(1, 2, 3) * Eigen::AngleAxisd(2, Vec3(1, -1, 2).normalized());
  const Corners moved = (by.linear() * corners).colwise() + by.translation();
  // Forces of a cell squeezed by a hundredth are some 0.01 N.
  EXPECT_LT(cell_energy(cube_cut(0), 0.008, full, law, moved).gradient.norm(), 1e-9);
  EXPECT_GT(cell_energy(cube_cut(0), 0.008, full, law, 1.01 * moved).gradient.norm(), 0.01);
  EXPECT_TRUE(std::isinf(cell_energy(cube_cut(0), 0.008, full, law, -moved).energy));
}

void expect_point_derivatives(const std::function<PointState(const Vec3&)>& state_at, const Matrix3& hessian,
                              const Vec3& p, Real step) {
  const PointState state = state_at(p);
  Vec3 differences;
  Matrix3 second;
  for (Index axis = 0; axis < 3; ++axis) {
    const PointState above = state_at(p + step * Vec3::Unit(axis)), below = state_at(p - step * Vec3::Unit(axis));
    differences[axis] = (above.energy - below.energy) / (2 * step);
    second.col(axis) = (above.gradient - below.gradient) / (2 * step);
  }
  EXPECT_GT(state.gradient.norm(), 0);
  EXPECT_LT((state.gradient - differences).norm(), 1e-5 * state.gradient.norm());
  EXPECT_LT((hessian - second).norm(), 1e-5 * hessian.norm());
}

TEST(TissueEnergies, forces_of_springs_and_fascia_and_their_derivatives_are_those_of_their_energies) {
  const Vec3 place(0.1, 0.2, 0.3), p = place + Vec3(0.001, -0.002, 0.003);
  expect_point_derivatives([&](const Vec3& x) { return spring(x - place, 2000); }, spring_hessian(2000), p, 1e-7);
  expect_point_derivatives([&](const Vec3& x) { return tie(x - place, along, 30, 0.002); },
                           tie_hessian(p - place, along, 30, 0.002), p, 1e-7);
}

TEST(TissueEnergies, forces_of_contact_with_a_plane_and_their_derivatives_are_those_of_their_energy) {
  const Vec3 normal = Vec3(1, 2, -2) / 3;
  expect_point_derivatives([&](const Vec3& x) { return contact(normal.dot(x), normal, 0.004, 3000); },
                           contact_hessian(0.001, normal, 0.004, 3000), 0.001 * normal, 1e-7);
  EXPECT_EQ(contact(0.005, normal, 0.004, 3000).energy, 0);
  EXPECT_EQ(contact_hessian(0.005, normal, 0.004, 3000), Matrix3::Zero());
}

TEST(TissueEnergies, fascia_lets_glide_along_the_fibers_and_yields_across_them) {
  EXPECT_LT(tie(0.05 * along, along, 30, 0.002).gradient.norm(), 1e-12);
  const Vec3 across = along.unitOrthogonal();
  EXPECT_NEAR(tie(1e-5 * across, along, 30, 0.002).gradient.norm(), 30 * 1e-5, 1e-8);
  const Real far = tie(0.1 * across, along, 30, 0.002).gradient.norm();
  EXPECT_LT(far, 30 * 0.002);
  EXPECT_GT(far, 0.99 * 30 * 0.002);
}

TEST(TissueEnergies, the_force_of_contact_is_that_of_its_energy_in_the_field_of_a_bone) {
  const TriangleMesh ball = shapes::sphere(Vec3::Zero(), 0.02, 4);
  const DistanceField field = build_distance_field(ball, domain_by_cell_size(ball, 0.001, 0.012));
  const auto energy = [&](const Vec3& p) {
    const PreciseSample found = sample_spline_precise(grid_of(field), p);
    return contact(found.distance, found.gradient, 0.004, 3000);
  };
  const Vec3 p(0.0122, 0.0131, 0.0117);  // 1.4 mm off the ball and inside of a cell of the field
  const PointState state = energy(p);
  Vec3 differences;
  for (Index axis = 0; axis < 3; ++axis)
    differences[axis] =
        (energy(p + 1e-7 * Vec3::Unit(axis)).energy - energy(p - 1e-7 * Vec3::Unit(axis)).energy) / 2e-7;
  EXPECT_GT(state.gradient.norm(), 1);
  EXPECT_LT((state.gradient - differences).norm(), 1e-6 * state.gradient.norm());
  EXPECT_EQ(energy(Vec3(0.03, 0, 0)).energy, 0) << "further off than the gap";
  EXPECT_EQ(energy(Vec3(1, 0, 0)).energy, 0) << "outside of the field";
}

}  // namespace
}  // namespace gracilis::tissue
