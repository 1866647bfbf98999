#pragma once

#include <gracilis/strings/force_rates.hpp>

#include <vector>

namespace gracilis::strings {

/// Solves for the places of a muscle's free nodes: all strings together, which hold each other's places. Each string's
/// own part is eliminated exactly (block tridiagonal, Thomas); what goes from string to string by GMRES (Saad and
/// Schultz 1986) on top of that.
class CoupledSolver {
 public:
  /// Strings that are `left_out` stay where they are for all others. All must outlive this.
  CoupledSolver(const MuscleStrings& muscle, const ForceRates& rates, const std::vector<char>& left_out);

  /// How free nodes move so that forces change by `forces` (3 × nodes; others stay).
  Points moves(const Points& forces) const;
  /// The transposed: weights of forces from weights of free nodes.
  Points transposed(const Points& weights) const;

  /// Whether a string's own equilibrium is stable where all others stay: no pivot of its elimination is negative.
  bool is_stable(Index string) const { return stable_[static_cast<std::size_t>(string)] != 0; }

 private:
  bool moves_freely(Index string, Index i) const {
    return !left_out_[static_cast<std::size_t>(string)] && body_holding(muscle_, string, i) < 0;
  }
  Points free_part(Points columns) const;
  Points own_moves(Points forces) const;
  Points own_transposed(Points weights) const;
  template <class Operator>
  Points solved(const Operator& preconditioned, const Points& right, Real tolerance) const;

  const MuscleStrings& muscle_;
  const ForceRates& rates_;
  const std::vector<char>& left_out_;
  std::vector<Eigen::Matrix3d> inverse_, upper_;  ///< per node, of the elimination
  std::vector<char> stable_;
};

}  // namespace gracilis::strings
