#include <gracilis/methods/tissue/total_energy.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/methods/tissue/bone_contact.hpp>
#include <gracilis/methods/tissue/point_energy.hpp>

#include <algorithm>
#include <limits>

namespace gracilis::tissue {

namespace {

constexpr Index cells_per_task = 32;
/// Keeps parts that nothing holds solvable, as a share of a cell's stiffness.
constexpr Real least_stiffness = 1e-6;

/// All that acts on one point of the surface at `p`.
PointState point_energy(const PreparedTissue& muscle, const Surroundings& around, std::size_t v, const Vec3& p) {
  const SurfacePoint& point = muscle.points[v];
  const TissueSettings& settings = muscle.settings;
  if (point.held_by >= 0)
    return spring(p - around.held.col(static_cast<Index>(v)), settings.attachment_stiffness * point.area);
  PointState sum;
  const auto add = [&](const PointState& state) {
    sum.energy += state.energy;
    sum.gradient += state.gradient;
  };
  for (Index t = point.ties_begin; t < point.ties_end; ++t)
    add(tie(p - around.tied.col(t), around.gliding.col(t), muscle.ties[static_cast<std::size_t>(t)].stiffness,
            settings.fascia_yield));
  for (Index i = around.near_begin[v]; i < around.near_begin[v + 1]; ++i) {
    const BoneGap& bone = muscle.bones[static_cast<std::size_t>(around.near[static_cast<std::size_t>(i)])];
    const auto body = static_cast<std::size_t>(bone.body);
    const BoneDistance found = bone_distance(*bone.field, around.inverses[body] * p);
    if (found.distance < bone.gaps[v])
      add(contact(found.distance, around.bodies[body].linear() * found.gradient, bone.gaps[v],
                  settings.contact_stiffness * point.area));
  }
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

/// The point's place; exact at rest.
Vec3 moved(const SurfacePoint& point, const Corners& corners, const Corners& at_rest) {
  return point.rest + place_of(point.at, corners - at_rest);
}

CellState state_of(const PreparedTissue& muscle, const Surroundings& around, Index c, const Points& nodes) {
  const Lattice& lattice = muscle.lattice;
  const auto index = static_cast<std::size_t>(c);
  const Cell& cell = lattice.cells[index];
  const Corners corners = corners_of(cell, nodes), at_rest = corners_of(cell, lattice.nodes);
  CellState state = cell_energy(cube_cut(cell.parity), lattice.cell_size, cell.fills, around.laws[index], corners);
  if (!(state.least_volume_ratio > 0)) return state;
  for (const Index p : muscle.points_of_cells.with(c)) {
    const auto v = static_cast<std::size_t>(p);
    const SurfacePoint& point = muscle.points[v];
    const PointState acting = point_energy(muscle, around, v, moved(point, corners, at_rest));
    state.energy += acting.energy;
    for (std::size_t k = 0; k < 4; ++k)
      state.gradient.col(point.at.corners[k]) += point.at.weights[static_cast<Index>(k)] * acting.gradient;
  }
  return state;
}

}  // namespace

Surroundings surroundings(const PreparedTissue& muscle, const std::vector<RigidTransform>& bodies,
                          std::vector<CellLaw> laws) {
  Surroundings around;
  around.bodies = bodies;
  around.laws = std::move(laws);
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

Real total_energy(const PreparedTissue& muscle, const Surroundings& around, const Points& nodes, Points& gradient) {
  const Lattice& lattice = muscle.lattice;
  const Index tasks = (lattice.cell_count() + cells_per_task - 1) / cells_per_task;
  std::vector<Real> energies(static_cast<std::size_t>(tasks), 0);
  Eigen::Matrix3Xd by_corner(3, 8 * lattice.cell_count());
  parallel_for(lattice.cell_count(), cells_per_task, [&](Index begin, Index end) {
    Real sum = 0;
    for (Index c = begin; c < end; ++c) {
      const CellState state = state_of(muscle, around, c, nodes);
      sum += state.energy;
      by_corner.middleCols<8>(8 * c) = state.gradient;
    }
    energies[static_cast<std::size_t>(begin / cells_per_task)] = sum;
  });
  Real energy = 0;
  for (const Real each : energies) energy += each;
  gradient.resize(3, lattice.node_count());
  parallel_for(lattice.node_count(), 256, [&](Index begin, Index end) {
    for (Index n = begin; n < end; ++n) {
      Vec3 sum = Vec3::Zero();
      for (const Index corner : muscle.corners_of_nodes.with(n)) sum += by_corner.col(corner);
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
  return moved(each, corners_of(cell, nodes), corners_of(cell, muscle.lattice.nodes));
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
