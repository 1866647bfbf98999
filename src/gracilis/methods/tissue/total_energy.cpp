#include <gracilis/methods/tissue/total_energy.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/methods/tissue/point_actions.hpp>

#include <algorithm>
#include <limits>
#include <numeric>

namespace gracilis::tissue {

namespace {

constexpr Index groups_per_task = 8;
/// Keeps parts that nothing holds solvable, as a share of a cell's stiffness.
constexpr Real least_stiffness = 1e-6;
constexpr Real infinity = std::numeric_limits<Real>::infinity();

/// All that acts on one point of the surface at `p`.
PointState point_energy(const PreparedTissue& muscle, const Surroundings& around, std::size_t v, const Vec3& p) {
  PointState sum;
  for_each_action(muscle, around, v, p, [&](PointActor, Index, const PointState& acting) {
    sum.energy += acting.energy;
    sum.gradient += acting.gradient;
  });
  return sum;
}

/// A third of the trace of the second derivatives of what acts on a point at rest, N/m.
Real point_stiffness(const PreparedTissue& muscle, const SurfacePoint& point) {
  const TissueSettings& settings = muscle.settings;
  if (point.held_by >= 0) return settings.attachment_stiffness * point.area;
  Real sum = 0;
  for (Index t = point.ties_begin; t < point.ties_end; ++t) {
    const Tie& each = muscle.ties[static_cast<std::size_t>(t)];
    sum += tie_hessian(Vec3::Zero(), each.along, each.stiffness, settings.fascia_yield).trace() / 3;
  }
  return sum;
}

/// What acts on the points of some groups of cells (J); its derivatives are added to those of the corners.
Real point_energies(const PreparedTissue& muscle, const Surroundings& around, Index begin_group, Index end_group,
                    const Points& nodes, CornerForces& forces) {
  Real energy = 0;
  const auto width = static_cast<std::size_t>(cells_in_group);
  for (std::size_t at = static_cast<std::size_t>(begin_group) * width; at < static_cast<std::size_t>(end_group) * width; ++at) {
    const Index cell = muscle.cells.cells[at];
    if (cell < 0) continue;
    const std::size_t slot = muscle.cells.slot[static_cast<std::size_t>(cell)];
    for (const Index p : muscle.points_of_cells.with(cell)) {
      const auto v = static_cast<std::size_t>(p);
      const SurfacePoint& point = muscle.points[v];
      const PointState acting = point_energy(muscle, around, v, point_at(muscle, v, nodes));
      energy += acting.energy;
      for (std::size_t k = 0; k < 4; ++k)
        for (std::size_t axis = 0; axis < 3; ++axis)
          forces[axis][slot + static_cast<std::size_t>(point.at.corners[k]) * width] +=
              point.at.weights[static_cast<Index>(k)] * acting.gradient[static_cast<Index>(axis)];
    }
  }
  return energy;
}

}  // namespace

Surroundings surroundings(const PreparedTissue& muscle, const std::vector<RigidTransform>& bodies,
                          const std::vector<CellLaw>& laws) {
  Surroundings around;
  around.bodies = bodies;
  around.laws = law_lanes(muscle.cells, laws);
  for (const RigidTransform& body : bodies) around.inverses.push_back(body.inverse());
  around.held = Points::Zero(3, static_cast<Index>(muscle.points.size()));
  around.tied.resize(3, static_cast<Index>(muscle.ties.size()));
  around.gliding.resize(3, static_cast<Index>(muscle.ties.size()));
  for (std::size_t v = 0; v < muscle.points.size(); ++v) {
    const SurfacePoint& point = muscle.points[v];
    if (point.held_by >= 0)
      around.held.col(static_cast<Index>(v)) = bodies[static_cast<std::size_t>(point.held_by)] * point.rest;
    for (Index t = point.ties_begin; t < point.ties_end; ++t) {
      const Tie& each = muscle.ties[static_cast<std::size_t>(t)];
      const RigidTransform& body = bodies[static_cast<std::size_t>(each.body)];
      around.tied.col(t) = body * point.rest;
      around.gliding.col(t) = body.linear() * each.along;
    }
  }
  around.near_begin.assign(muscle.points.size() + 1, 0);
  return around;
}

void find_near_bones(const PreparedTissue& muscle, const Points& nodes, Surroundings& around) {
  around.near.clear();
  for (std::size_t v = 0; v < muscle.points.size(); ++v) {
    const SurfacePoint& point = muscle.points[v];
    around.near_begin[v] = static_cast<Index>(around.near.size());
    if (point.held_by >= 0) continue;
    const Vec3 p = point_at(muscle, v, nodes);
    for (std::size_t b = 0; b < muscle.bones.size(); ++b) {
      const BoneGap& bone = muscle.bones[b];
      const Vec3 there = around.inverses[static_cast<std::size_t>(bone.body)] * p;
      if (bone_distance(*bone.field, there).distance < bone.gaps[v] + near_bones)
        around.near.push_back(static_cast<Index>(b));
    }
  }
  around.near_begin.back() = static_cast<Index>(around.near.size());
}

Real total_energy(const PreparedTissue& muscle, const Surroundings& around, const Points& nodes,
                  CornerForces& forces, Points& gradient) {
  const Index groups = muscle.cells.group_count();
  std::vector<Real> energies(static_cast<std::size_t>((groups + groups_per_task - 1) / groups_per_task), 0);
  for (std::vector<Real>& axis : forces) axis.resize(muscle.cells.corner_count());
  parallel_for(groups, groups_per_task, [&](Index begin, Index end) {
    Real& sum = energies[static_cast<std::size_t>(begin / groups_per_task)];
    sum = cell_lane_energy(muscle.cells, around.laws, begin, end, nodes, forces);
    if (sum < infinity) sum += point_energies(muscle, around, begin, end, nodes, forces);
  });
  const Real energy = std::accumulate(energies.begin(), energies.end(), Real{0});
  gradient.resize(3, muscle.lattice.node_count());
  if (!(energy < infinity)) return energy;
  parallel_for(muscle.lattice.node_count(), 256, [&](Index begin, Index end) {
    for (Index n = begin; n < end; ++n) {
      Vec3 sum = Vec3::Zero();
      for (const Index corner : muscle.corners_of_nodes.with(n)) {
        const auto c = static_cast<std::size_t>(corner);
        sum += Vec3(forces[0][c], forces[1][c], forces[2][c]);
      }
      gradient.col(n) = sum;
    }
  });
  return energy;
}

Eigen::SparseMatrix<Real> scalar_stiffness(const PreparedTissue& muscle, const std::vector<CellLaw>& laws) {
  const Lattice& lattice = muscle.lattice;
  std::vector<Eigen::Triplet<Real>> entries;
  for (std::size_t c = 0; c < lattice.cells.size(); ++c) {
    const Cell& cell = lattice.cells[c];
    const Matrix24 h =
        cell_hessian(cube_cut(cell.parity), lattice.cell_size, cell.fills, laws[c], corners_of(cell, lattice.nodes));
    Eigen::Matrix<Real, 8, 8> scalar;
    for (Index i = 0; i < 8; ++i)
      for (Index k = 0; k < 8; ++k) scalar(i, k) = h.block<3, 3>(3 * i, 3 * k).trace() / 3;
    for (const Index p : muscle.points_of_cells.with(static_cast<Index>(c))) {
      const auto v = static_cast<std::size_t>(p);
      const EmbeddedPoint& at = muscle.points[v].at;
      const Real stiffness = point_stiffness(muscle, muscle.points[v]);
      for (std::size_t a = 0; a < 4; ++a)
        for (std::size_t b = 0; b < 4; ++b)
          scalar(at.corners[a], at.corners[b]) +=
              stiffness * at.weights[static_cast<Index>(a)] * at.weights[static_cast<Index>(b)];
    }
    for (std::size_t i = 0; i < 8; ++i)
      for (std::size_t k = 0; k < 8; ++k)
        entries.emplace_back(cell.nodes[i], cell.nodes[k], scalar(static_cast<Index>(i), static_cast<Index>(k)));
  }
  for (Index n = 0; n < lattice.node_count(); ++n)
    entries.emplace_back(n, n, least_stiffness * muscle.settings.matrix_shear_modulus * lattice.cell_size);
  Eigen::SparseMatrix<Real> matrix(lattice.node_count(), lattice.node_count());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

Vec3 point_at(const PreparedTissue& muscle, std::size_t point, const Points& nodes) {
  const SurfacePoint& each = muscle.points[point];
  const Cell& cell = muscle.lattice.cells[static_cast<std::size_t>(each.at.cell)];
  // By what the corners have moved: exact at rest.
  Vec3 place = each.rest;
  for (std::size_t k = 0; k < 4; ++k) {
    const Index node = cell.nodes[static_cast<std::size_t>(each.at.corners[k])];
    place += each.at.weights[static_cast<Index>(k)] * (nodes.col(node) - muscle.lattice.nodes.col(node));
  }
  return place;
}

Points surface_at(const PreparedTissue& muscle, const Points& nodes) {
  Points surface(3, muscle.vertex_count);
  for (Index v = 0; v < muscle.vertex_count; ++v) surface.col(v) = point_at(muscle, static_cast<std::size_t>(v), nodes);
  return surface;
}

Real least_volume_ratio(const Lattice& lattice, const Points& nodes) {
  Real least = std::numeric_limits<Real>::infinity();
  for (const Cell& cell : lattice.cells) {
    const CubeCut& cut = cube_cut(cell.parity);
    const Corners corners = corners_of(cell, nodes);
    for (std::size_t t = 0; t < 5; ++t) {
      Eigen::Matrix<Real, 3, 4> x;
      for (std::size_t k = 0; k < 4; ++k) x.col(static_cast<Index>(k)) = corners.col(cut.tetrahedra[t][k]);
      least = std::min(least, (x * cut.shape_gradients[t].transpose() / lattice.cell_size).determinant());
    }
  }
  return least;
}

}  // namespace gracilis::tissue
