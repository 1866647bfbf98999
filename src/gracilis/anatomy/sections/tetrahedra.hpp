#pragma once

#include <gracilis/anatomy/sections/section_rings.hpp>

#include <vector>

namespace gracilis {

/// A muscle of sections as tetrahedra: each triangular frustum between two sections is three of them (Laclé 2014,
/// section 6.1.4).

enum class Compartment { muscle, tendon };

/// kg/m³: mammalian muscle (Dorn 2014, as Laclé cites it) and tendon (Ker 1981).
inline constexpr Real muscle_density = 1059.7, tendon_density = 1120;

struct Tetrahedra {
  Points points;                          ///< m
  Eigen::Matrix4Xi cells;                 ///< positively oriented
  std::vector<Compartment> compartments;  ///< of each cell
};

/// Divides a muscle's sections; `places` (m, ascending) say how far along the line each lies. Where a tendon, of these
/// lengths at its origin and insertion (m), ends between two sections, one interpolated between them is put in.
Tetrahedra tetrahedra_of(const SectionRings& rings, const std::vector<Real>& places, Real origin_tendon, Real tendon);

/// A cell's volume, m³ (eq. 6.1, signed).
Real cell_volume(const Tetrahedra& tetrahedra, Eigen::Index cell);

/// Sum of the volumes of a compartment, m³.
Real compartment_volume(const Tetrahedra& tetrahedra, Compartment compartment);

/// A section's shape (Laclé 2014, section 3.5.2).
struct SectionShape {
  Real area = 0;       ///< m², of the polygon seen along its normal
  Real perimeter = 0;  ///< m
  Real quotient = 0;   ///< isoperimetric, \f$4 \pi A / P^2\f$: 1 for a circle
  bool convex = false;
};

/// Of one section's ring of corners, seen along its normal. Precondition: 0 <= section < the number of sections.
SectionShape section_shape(const SectionRings& rings, Index section);

/// Physiological cross-section, m²: \f$V \cos\alpha / l\f$, α the pennation, l the optimal fiber length (eq. 6.2).
Real physiological_area(Real muscle_volume, Real pennation, Real optimal_fiber);

/// The sections of a surface that was made of them, in any pose: centers lie in their rings as they did in the rings
/// of `rest` about `rest_centers`, by the turn and size that fit best (Umeyama 1991).
SectionRings rings_of(const Points& vertices, Index rays, const Points& rest, const Points& rest_centers);

}  // namespace gracilis
