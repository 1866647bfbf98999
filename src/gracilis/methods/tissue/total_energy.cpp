#include <gracilis/methods/tissue/total_energy.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/methods/tissue/point_actions.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace gracilis::tissue {

namespace {

constexpr Index groups_per_task = 16, points_per_task = 512, nodes_per_task = 512;
/// Keeps parts that nothing holds solvable, as a share of a cell's stiffness.
constexpr Real least_stiffness = 1e-6;

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
  Real sum = point.joined_stiffness;
  if (point.held_by >= 0) return sum + settings.attachment_stiffness * point.area;
  for (Index t = point.ties_begin; t < point.ties_end; ++t) {
    const Tie& each = muscle.ties[static_cast<std::size_t>(t)];
    sum += tie_hessian(Vec3::Zero(), each.along, each.stiffness, settings.fascia_yield).trace() / 3;
  }
  return sum;
}

/// The distance within the grid, a lower bound beyond it.
Real distance_at_least(const BoundedField& field, const Vec3& p) {
  const Real distance = sample_spline_precise(field.grid, p).distance;
  return std::isfinite(distance) ? distance : static_cast<Real>(sample_bounded(field, p.cast<float>()).distance);
}

/// The energy (J) of what acts on points [begin, end), and its derivatives.
Real act_on_points(const PreparedTissue& muscle, const Surroundings& around, Index begin, Index end,
                   EnergyWorkspace& workspace) {
  Real energy = 0;
  for (Index p = begin; p < end; ++p) {
    const auto v = static_cast<std::size_t>(p);
    const SurfacePoint& point = muscle.points[v];
    const PointState acting = point_energy(muscle, around, v, point.rest + mean_at(point.at, workspace.moved));
    energy += acting.energy;
    workspace.point_forces.col(p) = acting.gradient;
  }
  return energy;
}

Vec3 force_on_node(const PreparedTissue& muscle, const EnergyWorkspace& workspace, Index node) {
  Vec3 sum = Vec3::Zero();
  for (const Index corner : muscle.corners_of_nodes.with(node)) {
    const auto c = static_cast<std::size_t>(corner);
    sum += Vec3(workspace.corners[0][c], workspace.corners[1][c], workspace.corners[2][c]);
  }
  for (const Index at : muscle.points_of_nodes.with(node))
    sum += muscle.point_weights[static_cast<std::size_t>(at)] * workspace.point_forces.col(at / 4);
  return sum;
}

/// Adds what each chunk of the work gives, in their order.
template <class Part>
Real sum_of_parts(Index count, Index grain, const Part& part) {
  std::vector<Real> sums(static_cast<std::size_t>((count + grain - 1) / grain), 0);
  parallel_for(count, grain,
               [&](Index begin, Index end) { sums[static_cast<std::size_t>(begin / grain)] = part(begin, end); });
  return std::accumulate(sums.begin(), sums.end(), Real{0});
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
  around.planes_begin = around.near_begin;
  return around;
}

void set_planes(const PreparedTissue& muscle, std::vector<ContactPlane> planes, Surroundings& around) {
  around.planes = std::move(planes);
  auto next = around.planes.begin();
  for (std::size_t v = 0; v <= muscle.points.size(); ++v) {
    next = std::find_if(next, around.planes.end(),
                        [&](const ContactPlane& plane) { return plane.point >= static_cast<Index>(v); });
    around.planes_begin[v] = static_cast<Index>(next - around.planes.begin());
  }
}

void find_near_bones(const PreparedTissue& muscle, const Points& nodes, Surroundings& around) {
  around.seen = points_at(muscle, nodes);
  const auto count = static_cast<Index>(muscle.points.size());
  if (around.queries.empty()) {
    const Real never = -std::numeric_limits<Real>::infinity();
    around.queries.assign(muscle.bones.size(), {Points::Zero(3, count), Eigen::VectorXd::Constant(count, never)});
  }
  around.near.clear();
  for (Index v = 0; v < count; ++v) {
    const auto point = static_cast<std::size_t>(v);
    around.near_begin[point] = static_cast<Index>(around.near.size());
    if (muscle.points[point].held_by >= 0) continue;
    for (std::size_t b = 0; b < muscle.bones.size(); ++b) {
      const BoneGap& bone = muscle.bones[b];
      CachedBoneQuery& query = around.queries[b];
      const Vec3 there = around.inverses[static_cast<std::size_t>(bone.body)] * around.seen.col(v);
      const Real reach = bone.gaps[point] + near_bones;
      if (query.distances[v] - largest_slope * (there - query.places.col(v)).norm() >= reach) continue;
      query.places.col(v) = there;
      query.distances[v] = distance_at_least(bone.field, there);
      const Real beyond = query.distances[v] - bone.gaps[point];
      if (beyond < near_bones) around.near.push_back({static_cast<Index>(b), std::max(0.0, beyond / largest_slope)});
    }
  }
  around.near_begin.back() = static_cast<Index>(around.near.size());
}

Real total_energy(const PreparedTissue& muscle, const Surroundings& around, const Points& nodes,
                  EnergyWorkspace& workspace, Points& gradient) {
  workspace.moved = nodes - muscle.lattice.nodes;
  workspace.point_forces.resize(3, static_cast<Index>(muscle.points.size()));
  for (std::vector<Real>& axis : workspace.corners) axis.resize(muscle.cells.corner_count());
  gradient.resize(3, muscle.lattice.node_count());
  const Real of_cells = sum_of_parts(muscle.cells.group_count(), groups_per_task, [&](Index begin, Index end) {
    return cell_lane_energy(muscle.cells, around.laws, begin, end, nodes, workspace.corners);
  });
  if (!(of_cells < std::numeric_limits<Real>::infinity())) return of_cells;
  const Real of_points =
      sum_of_parts(static_cast<Index>(muscle.points.size()), points_per_task,
                   [&](Index begin, Index end) { return act_on_points(muscle, around, begin, end, workspace); });
  parallel_for(muscle.lattice.node_count(), nodes_per_task, [&](Index begin, Index end) {
    for (Index n = begin; n < end; ++n) gradient.col(n) = force_on_node(muscle, workspace, n);
  });
  return of_cells + of_points;
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
    for (std::size_t i = 0; i < 8; ++i)
      for (std::size_t k = 0; k < 8; ++k)
        entries.emplace_back(cell.nodes[i], cell.nodes[k], scalar(static_cast<Index>(i), static_cast<Index>(k)));
  }
  for (const SurfacePoint& point : muscle.points) {
    const Real stiffness = point_stiffness(muscle, point);
    for (std::size_t a = 0; a < 4; ++a)
      for (std::size_t b = 0; b < 4; ++b)
        entries.emplace_back(
            point.at.nodes[a], point.at.nodes[b],
            stiffness * point.at.weights[static_cast<Index>(a)] * point.at.weights[static_cast<Index>(b)]);
  }
  for (Index n = 0; n < lattice.node_count(); ++n)
    entries.emplace_back(n, n, least_stiffness * muscle.settings.matrix_shear_modulus * lattice.cell_size);
  Eigen::SparseMatrix<Real> matrix(lattice.node_count(), lattice.node_count());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

Vec3 point_at(const PreparedTissue& muscle, const Points& nodes, Index point) {
  const SurfacePoint& of = muscle.points[static_cast<std::size_t>(point)];
  // By what the nodes have moved: exact at rest.
  Vec3 moved = Vec3::Zero();
  for (std::size_t k = 0; k < 4; ++k) {
    const Index node = of.at.nodes[k];
    moved += of.at.weights[static_cast<Index>(k)] * (nodes.col(node) - muscle.lattice.nodes.col(node));
  }
  return of.rest + moved;
}

/// Where the first points are.
static Points first_points_at(Index count, const PreparedTissue& muscle, const Points& nodes) {
  Points places(3, count);
  for (Index p = 0; p < count; ++p) places.col(p) = point_at(muscle, nodes, p);
  return places;
}

Points points_at(const PreparedTissue& muscle, const Points& nodes) {
  return first_points_at(static_cast<Index>(muscle.points.size()), muscle, nodes);
}

Points surface_at(const PreparedTissue& muscle, const Points& nodes) {
  return first_points_at(muscle.vertex_count, muscle, nodes);
}

Real least_volume_ratio(const Lattice& lattice, const Points& nodes) {
  Real least = std::numeric_limits<Real>::infinity();
  for_each_volume_ratio(lattice, nodes, [&](const Cell&, std::size_t, Real ratio) { least = std::min(least, ratio); });
  return least;
}

}  // namespace gracilis::tissue
