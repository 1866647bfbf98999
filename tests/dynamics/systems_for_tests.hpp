#pragma once

#include <gracilis/dynamics/solver/solver.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/topology.hpp>

#include <shapes.hpp>

#include <random>

namespace gracilis {

/// Of the size of a thin muscle, beside the origin.
inline const TriangleMesh& off_center_ball() {
  static const TriangleMesh mesh = shapes::sphere({0.01, -0.02, 0.005}, 0.03, 3);
  return mesh;
}

/// How a closed surface becomes a system to solve.
struct SystemOptions {
  Real distance_stiffness = 50;    ///< N/m
  Real dihedral_stiffness = 1e-5;  ///< N·m
  Real smallest_mass = 0.5e-4;     ///< kg; masses are drawn between this and three times this
  Real fixed_share = 0;            ///< of the particles
  unsigned seed = 5;
};

/// Edges, dihedrals and volume of `mesh` with random masses.
inline SurfaceSystem system_of(const TriangleMesh& mesh, const SystemOptions& options = {}) {
  std::mt19937 generator(options.seed);
  std::uniform_real_distribution<Real> uniform(0, 1);
  const Points& x = mesh.vertices;
  Eigen::VectorXd inverse_masses(mesh.vertex_count());
  for (Real& w : inverse_masses) {
    const bool fixed = uniform(generator) < options.fixed_share;
    w = fixed ? 0 : 1 / (options.smallest_mass * (1 + 2 * uniform(generator)));
  }
  std::vector<DistanceConstraint> distances;
  std::vector<DihedralConstraint> dihedrals;
  for (const MeshEdge& e : build_topology(mesh.faces, mesh.vertex_count()).edges) {
    const Real length = (x.col(e.a) - x.col(e.b)).norm();
    distances.push_back({e.a, e.b, length, 1 / options.distance_stiffness});
    const Real angle = dihedral_angle(x.col(e.a), x.col(e.b), x.col(e.left_apex), x.col(e.right_apex));
    dihedrals.push_back({{e.a, e.b, e.left_apex, e.right_apex}, angle, 1 / options.dihedral_stiffness, length});
  }
  SurfaceSystem system;
  system.rest = make_particles(x, inverse_masses);
  system.distances = build_distance_set(distances, mesh.vertex_count());
  system.dihedrals = build_dihedral_set(dihedrals, mesh.vertex_count());
  system.volume = build_volume_set(mesh.faces, mesh.vertex_count(), enclosed_volume(x, mesh.faces), 0);
  return system;
}

/// Where a set's dihedrals are, ascending; padding has edges without length.
inline std::vector<Index> slots_of(const DihedralSet& set) {
  std::vector<Index> slots;
  for (std::size_t at = 0; at < set.edge_length.size(); ++at)
    if (set.edge_length[at] > 0) slots.push_back(static_cast<Index>(at));
  return slots;
}

/// Moves every particle that can move by up to `amount` (m) along each axis.
inline void shake(Particles& particles, float amount, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<float> uniform(-amount, amount);
  for (Index i = 0; i < particles.count(); ++i) {
    const Eigen::Vector3f by(uniform(generator), uniform(generator), uniform(generator));
    if (particles.inverse_mass(i) > 0) particles.position(i) += by;
  }
}

inline Points real_positions_of(const Particles& particles) { return positions_of(particles).cast<Real>(); }

/// The exact distance to a ball about the origin, at so many nodes a side, one every millimetre.
inline DistanceField field_of_ball(Real radius, Index nodes) {
  constexpr Real cell = 0.001;
  DistanceField field;
  field.origin = Vec3::Constant(-cell * (nodes - 1) / 2);
  field.cell_size = Vec3::Constant(cell);
  field.nodes = {nodes, nodes, nodes};
  for (Index k = 0; k < nodes; ++k)
    for (Index j = 0; j < nodes; ++j)
      for (Index i = 0; i < nodes; ++i)
        field.values.push_back(static_cast<float>((field.origin + cell * Vec3(i, j, k)).norm() - radius));
  return field;
}

}  // namespace gracilis
