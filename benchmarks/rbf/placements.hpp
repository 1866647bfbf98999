#pragma once

#include <gracilis/geometry/radial_fit.hpp>
#include <gracilis/geometry/rbf_feature_centers.hpp>

#include <functional>
#include <limits>
#include <string>
#include <vector>

/// Height fields on which placements of centers are compared (Cervenka 2024, sections 5.1, 5.3 and 5.6).
namespace gracilis {

struct NamedField {
  std::string name;
  HeightField field;
};
std::vector<NamedField> height_fields();

/// Where so many centers go, a square number of them.
struct Placement {
  std::string name;
  std::function<Points(const HeightField&, Index count)> centers;
};
/// All but the greedy one, which chooses reaches, too. Features give some centers, at most half of them; the Halton
/// sequence fills the rest.
std::vector<Placement> placements();

struct FieldFit {
  RadialFit fit;
  Real error = std::numeric_limits<Real>::infinity();  ///< mean squared, at all nodes
};

/// Gaussians at these centers and a linear polynomial, with the best of some reaches for all of them.
FieldFit best_fit(const HeightField& field, const Points& centers);
/// The same, greedily placed with a reach each.
FieldFit greedy_fit(const HeightField& field, Index count);

}  // namespace gracilis
