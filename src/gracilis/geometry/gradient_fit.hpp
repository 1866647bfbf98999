#pragma once

#include <gracilis/geometry/sparse_ldlt.hpp>
#include <gracilis/geometry/triangle_mesh.hpp>

#include <vector>

namespace gracilis {

/// Finds the surface whose edges come nearest to being turned and stretched as given while its vertices stay near given
/// places: the screened Poisson equation of gradient-based mesh editing (Yu et al. 2004), which smooths what the places
/// say over a length. Vertices that face each other through the body are linked as edges are, so that thin muscles keep
/// their thickness.
///
/// It minimizes Σ w |x_b − x_a − G (r_b − r_a)|² + Σ (A t / l²) |x_v − p_v|², sums over links and vertices: r at rest,
/// G the mean of the gradients at the ends, p the places, A a vertex's area, t how far its place is trusted, l the
/// smoothing length; w is twice the link's area over its squared length, which makes the first sum the energy of
/// Dirichlet.
class GradientFit {
 public:
  /// `is_fixed` and `trust` (0 to 1) per vertex. Surfaces with more free vertices than `largest_factorized` are solved
  /// by conjugate gradients, in a fraction of the memory. Preconditions: at least one face, all coordinates finite;
  /// smoothing > 0 (m). Throws QualityError where the weights leave no solution.
  GradientFit(const TriangleMesh& rest, const std::vector<char>& is_fixed, const Eigen::VectorXd& trust, Real smoothing,
              Index largest_factorized = 30000);

  /// What a surface is to come near to; with six rows two surfaces, one above the other.
  template <int Rows>
  struct AimOf {
    Eigen::Matrix<Real, Rows, Eigen::Dynamic> places;
    std::vector<Eigen::Matrix<Real, Rows, 3>> gradients;  ///< per vertex, of the place now by the place at rest
  };
  using Aim = AimOf<3>;

  /// Fixed vertices are where the places say. Two surfaces take little more time than one: what takes the time is to
  /// read links and factors.
  template <int Rows>
  Eigen::Matrix<Real, Rows, Eigen::Dynamic> fitted(const AimOf<Rows>& aim) const;

 private:
  struct Link {
    Index a = 0, b = 0;
    Real weight = 0;
    Vec3 rest;  ///< from a to b
  };
  std::vector<Link> links_;
  Eigen::VectorXd place_weights_;
  std::vector<Index> numbers_;        ///< of the unknowns; -1: fixed
  Eigen::SparseMatrix<Real> matrix_;  ///< for conjugate gradients
  SparseLdlt factors_;
  Index unknowns_ = 0;
  bool is_factorized_ = true;

  Index number_of(Index vertex) const { return numbers_[static_cast<std::size_t>(vertex)]; }
  Eigen::SparseMatrix<Real> normal_matrix() const;
  template <int Rows>
  Eigen::Matrix<Real, Rows, Eigen::Dynamic> right_side(const AimOf<Rows>& aim) const;
  template <int Rows>
  Eigen::Matrix<Real, Rows, Eigen::Dynamic> iterated(const Eigen::Matrix<Real, Rows, Eigen::Dynamic>& right_side,
                                                     const Eigen::Matrix<Real, Rows, Eigen::Dynamic>& places) const;
};

}  // namespace gracilis
