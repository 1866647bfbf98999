#pragma once

#include <gracilis/core/group_by_key.hpp>
#include <gracilis/geometry/polylines.hpp>
#include <gracilis/geometry/topology.hpp>
#include <gracilis/geometry/triangle_mesh.hpp>

#include <array>
#include <vector>

namespace gracilis::pbd {

/// An edge keeps its length.
struct EdgeConstraint {
  Index a = 0, b = 0;
  Real length = 0;      ///< m, at rest
  Real anisotropy = 1;  ///< factor on C alone: on its gradient, too, it would cancel
};

/// Two triangles keep their angle; the edge first, then the apexes.
struct DihedralConstraint {
  std::array<Index, 4> vertices{};
  Real angle = 0;        ///< rad, at rest
  Real edge_length = 0;  ///< m, at rest
};

/// Constraints in the order of their colors: those of color i are begins[i] ... begins[i + 1] - 1 and share no vertex.
template <class Constraint>
struct Colored {
  std::vector<Constraint> constraints;
  std::vector<Index> begins = {0};
};

/// The constraints of one muscle's surface; never changes.
struct Surface {
  Colored<EdgeConstraint> edges;
  Colored<DihedralConstraint> dihedrals;
  Eigen::Matrix3Xi faces;
  GroupedByKey corners;      ///< by vertex: where in `faces` it stands, as 3 × face + row
  Real volume = 0;           ///< m³, at rest
  std::vector<Real> weight;  ///< per vertex: 1, or 0 where it is held
};

/// `fixed_body` is -1 for free vertices. Along `fibers` edges are softer; without any all are alike. Precondition: the
/// surface is closed.
Surface build_surface(const TriangleMesh& mesh, const MeshTopology& topology, const std::vector<Index>& fixed_body,
                      const Polylines& fibers);

/// What stiffnesses (0 to 1) one iteration has, and how far one angle may move a vertex, as a share of its edge's
/// length; 0: any way.
struct Stiffness {
  Real edges = 1, angles = 1, volume = 1, dihedral_limit = 0;
};

/// One projection of all edges, then all angles, color after color. Returns how many angles had no gradient.
Index project_edges_and_angles(const Surface& surface, const Stiffness& stiffness, Points& points);

/// Eq. 3 with a volume's factor: \f$C = \frac{1}{6} \sum a \cdot (b \times c) - V^0\f$. `gradient`: by every vertex.
Real volume_constraint(const Surface& surface, const Points& points, Points& gradient);

/// One projection of the volume onto its rest.
void project_volume(const Surface& surface, Real stiffness, Points& points);

}  // namespace gracilis::pbd
