#pragma once

#include <gracilis/geometry/distance_field.hpp>
#include <gracilis/methods/tissue/factored_matrix.hpp>
#include <gracilis/methods/tissue/minimize.hpp>
#include <gracilis/methods/tissue/point_actions.hpp>

#include <shapes.hpp>

#include <chrono>
#include <functional>
#include <memory>

/// Blocks of one material under loads whose answer is known: shared by the tests and benchmarks/tissue_study.cpp.
namespace gracilis::tissue {

/// How a block lies in its lattice: made of whole cells, or anywhere, as a muscle does.
enum class BlockFit { whole, anywhere };

/// A side of the block: the points there, and what they hold on to.
struct BlockSide {
  Index axis = 0;
  bool is_high = false;
  std::size_t begin = 0, end = 0;  ///< in the points
};

/// From (0, 0, 0) to `size`; nothing holds it yet.
struct Block {
  Vec3 size = Vec3::Zero();
  BlockFit fit = BlockFit::whole;
  PreparedTissue muscle;
  std::vector<CellLaw> laws;
  std::vector<BlockSide> sides;
  std::vector<Vec3> held;            ///< per point; of the free ones it means nothing
  std::vector<ContactPlane> planes;  ///< `muscle` is the number of the side
  std::unique_ptr<DistanceField> bone;
};

/// Precondition of a whole fit: the cell divides the size.
inline Block make_block(const Vec3& size, Real cell, BlockFit fit, const CellLaw& law) {
  Block block;
  block.size = size;
  block.fit = fit;
  Lattice& lattice = block.muscle.lattice;
  if (fit == BlockFit::whole) {
    // Lattices begin this much before their surface, and are filled as far as it goes.
    const Vec3 low = Vec3(0.47, 0.53, 0.51) * cell;
    lattice = build_lattice(shapes::box(low, low + size - Vec3::Constant(cell)), cell);
    for (Cell& each : lattice.cells) each.fills = {1, 1, 1, 1, 1}, each.fill = 1;
  } else {
    lattice = build_lattice(shapes::box(Vec3::Zero(), size), cell);
  }
  block.laws.assign(lattice.cells.size(), law);
  // Stiff against the tissue's volume, too: 2 MPa over some millimetres is 1e9 N/m³.
  block.muscle.settings.attachment_stiffness = block.muscle.settings.neighbor_stiffness = 1e12;
  return block;
}

/// Points all over a side: the lattice's nodes there, or the middles of patches half a cell wide.
inline std::vector<SurfacePoint> side_points(const Block& block, Index axis, bool is_high) {
  const Lattice& lattice = block.muscle.lattice;
  const Real cell = lattice.cell_size, level = is_high ? block.size[axis] : 0;
  const Index a = (axis + 1) % 3, b = (axis + 2) % 3;
  std::vector<SurfacePoint> points;
  SurfacePoint point;
  if (block.fit == BlockFit::whole) {
    const auto share = [&](Index along, const Vec3& p) {
      return p[along] < cell / 2 || p[along] > block.size[along] - cell / 2 ? cell / 2 : cell;
    };
    for (Index n = 0; n < lattice.node_count(); ++n) {
      point.rest = lattice.nodes.col(n);
      if (std::abs(point.rest[axis] - level) > cell / 2) continue;
      point.at = {0, {n, n, n, n}, {1, 0, 0, 0}};
      point.area = point.vertex_area = share(a, point.rest) * share(b, point.rest);
      points.push_back(point);
    }
    return points;
  }
  const auto pieces = [&](Index along) { return static_cast<Index>(std::ceil(2 * block.size[along] / cell)); };
  const Index as = pieces(a), bs = pieces(b);
  for (Index i = 0; i < as; ++i)
    for (Index k = 0; k < bs; ++k) {
      point.rest[axis] = level;
      point.rest[a] = block.size[a] * (i + 0.5) / as;
      point.rest[b] = block.size[b] * (k + 0.5) / bs;
      point.at = embed(lattice, point.rest);
      point.area = point.vertex_area = block.size[a] * block.size[b] / (as * bs);
      points.push_back(point);
    }
  return points;
}

inline std::size_t add_side(Block& block, Index axis, bool is_high, Index held_by) {
  BlockSide side{axis, is_high, block.muscle.points.size(), 0};
  for (SurfacePoint& point : side_points(block, axis, is_high)) {
    point.held_by = held_by;
    block.muscle.points.push_back(point);
    block.held.push_back(point.rest);
  }
  side.end = block.muscle.points.size();
  block.sides.push_back(side);
  return block.sides.size() - 1;
}

/// Draws a side's points to where `place` has them. Returns the side's number, as all of these do.
inline std::size_t hold_side(Block& block, Index axis, bool is_high, const std::function<Vec3(const Vec3&)>& place) {
  const std::size_t number = add_side(block, axis, is_high, 0);
  for (std::size_t p = block.sides[number].begin; p < block.sides[number].end; ++p)
    block.held[p] = place(block.muscle.points[p].rest);
  return number;
}

/// Keeps a side's points on normal · x = level, where they slide: a plane from each side.
inline std::size_t slide_side(Block& block, Index axis, bool is_high, const Vec3& normal, Real level) {
  const std::size_t number = add_side(block, axis, is_high, -1);
  for (std::size_t p = block.sides[number].begin; p < block.sides[number].end; ++p) {
    block.planes.push_back({static_cast<Index>(p), static_cast<Index>(number), normal, level});
    block.planes.push_back({static_cast<Index>(p), static_cast<Index>(number), -normal, -level});
  }
  return number;
}

/// Keeps the point of the tissue at `rest` from going along an axis, as a rigid motion would that nothing else stops.
inline void pin(Block& block, const Vec3& rest, Index axis) {
  SurfacePoint point;
  point.rest = rest;
  point.at = embed(block.muscle.lattice, rest);
  point.area = point.vertex_area = std::pow(block.muscle.lattice.cell_size, 2);
  const auto number = static_cast<Index>(block.muscle.points.size());
  block.muscle.points.push_back(point);
  block.held.push_back(rest);
  block.planes.push_back({number, -1, Vec3::Unit(axis), rest[axis]});
  block.planes.push_back({number, -1, -Vec3::Unit(axis), -rest[axis]});
}

/// A flat bone under the whole block that its lower side touches, with the method's own stiffness and gap. To be laid
/// before other sides are added.
inline std::size_t lay_on_bone(Block& block) {
  const Vec3 wide = block.size + Vec3::Constant(0.03);
  const TriangleMesh slab = shapes::box(Vec3(-0.03, -0.03, -0.02), Vec3(wide.x(), wide.y(), 0));
  block.bone = std::make_unique<DistanceField>(build_distance_field(slab, domain_by_cell_size(slab, 0.002, 0.01)));
  return add_side(block, 2, false, -1);
}

/// The scalar stiffness along one axis, with that of the planes and of the bone: they are stiff along their normals
/// only.
inline FactoredMatrix metric_along(const Block& block, Index axis) {
  const PreparedTissue& muscle = block.muscle;
  Eigen::SparseMatrix<Real> matrix = scalar_stiffness(muscle, block.laws);
  std::vector<Eigen::Triplet<Real>> entries;
  const auto add = [&](Index p, Real stiffness) {
    const SurfacePoint& point = muscle.points[static_cast<std::size_t>(p)];
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t k = 0; k < 4; ++k)
        entries.emplace_back(
            point.at.nodes[i], point.at.nodes[k],
            stiffness * point.area * point.at.weights[static_cast<Index>(i)] * point.at.weights[static_cast<Index>(k)]);
  };
  // Of the two planes of a pair one acts at a time.
  for (const ContactPlane& plane : block.planes)
    add(plane.point, muscle.settings.neighbor_stiffness * plane.normal[axis] * plane.normal[axis] / 2);
  if (block.bone && axis == 2)
    for (std::size_t p = block.sides[0].begin; p < block.sides[0].end; ++p)
      add(static_cast<Index>(p), muscle.settings.contact_stiffness);
  Eigen::SparseMatrix<Real> more(matrix.rows(), matrix.cols());
  more.setFromTriplets(entries.begin(), entries.end());
  return FactoredMatrix(matrix + more);
}

/// One factored matrix per axis, or one for all where they are the same.
struct AxisMetrics {
  std::vector<FactoredMatrix> axes;
  explicit AxisMetrics(const Block& block) {
    const Index count = block.planes.empty() && !block.bone ? 1 : 3;
    for (Index axis = 0; axis < count; ++axis) axes.push_back(metric_along(block, axis));
  }
  void operator()(std::span<Points> gradients) const {
    if (axes.size() == 1) return axes[0].solve(gradients);
    std::vector<Points> sums(gradients.begin(), gradients.end());
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::vector<Points> solved(gradients.begin(), gradients.end());
      axes[axis].solve(solved);
      for (std::size_t i = 0; i < sums.size(); ++i)
        sums[i].row(static_cast<Index>(axis)) = solved[i].row(static_cast<Index>(axis));
    }
    std::copy(sums.begin(), sums.end(), gradients.begin());
  }
};

struct SettledBlock {
  Surroundings around;
  Points nodes;
  Minimized done;
  Real seconds = 0;  ///< of preparing the metric and of minimizing
};

/// To the least of its energy; begins where `from` has the nodes. `residual` in N.
inline SettledBlock settle(Block& block, Real residual, const std::function<Vec3(const Vec3&)>& from = {}) {
  PreparedTissue& muscle = block.muscle;
  if (block.bone) {
    // Points of other sides slide on planes, and touch nothing else.
    BoneGap bone{0, bounded(*block.bone), std::vector<Real>(muscle.points.size(), -1), {}, {}};
    for (std::size_t p = block.sides[0].begin; p < block.sides[0].end; ++p)
      bone.gaps[p] =
          std::min(muscle.settings.contact_gap, sample_spline_precise(bone.field.grid, muscle.points[p].rest).distance);
    muscle.bones = {bone};
  }
  sort_by_nodes(muscle);

  SettledBlock settled{surroundings(muscle, {RigidTransform::Identity()}, block.laws), muscle.lattice.nodes, {}, 0};
  Surroundings& around = settled.around;
  for (std::size_t p = 0; p < block.held.size(); ++p) around.held.col(static_cast<Index>(p)) = block.held[p];
  set_planes(muscle, block.planes, around);
  for (Index n = 0; n < muscle.lattice.node_count() && from; ++n)
    settled.nodes.col(n) = from(muscle.lattice.nodes.col(n));
  if (block.bone) find_near_bones(muscle, settled.nodes, around);
  const auto begin = std::chrono::steady_clock::now();
  const AxisMetrics metric(block);
  EnergyWorkspace workspace;
  settled.done =
      minimize([&](const Points& x, Points& g) { return total_energy(muscle, around, x, workspace, g); },
               [&](std::span<Points> g) { metric(g); }, {20000, residual, muscle.lattice.cell_size / 2}, settled.nodes);
  settled.seconds = std::chrono::duration<Real>(std::chrono::steady_clock::now() - begin).count();
  return settled;
}

/// Calls act(rest, place, force) for all points of a side: what it is held there with, N.
template <class Act>
void for_each_force(const Block& block, const SettledBlock& settled, std::size_t side, const Act& act) {
  const Points places = points_at(block.muscle, settled.nodes);
  for (std::size_t p = block.sides[side].begin; p < block.sides[side].end; ++p) {
    const Vec3 place = places.col(static_cast<Index>(p));
    Vec3 force = Vec3::Zero();
    for_each_action(block.muscle, settled.around, p, place,
                    [&](PointActor, Index, const PointState& acting) { force -= acting.gradient; });
    act(block.muscle.points[p].rest, place, force);
  }
}

inline Vec3 force_on(const Block& block, const SettledBlock& settled, std::size_t side) {
  Vec3 sum = Vec3::Zero();
  for_each_force(block, settled, side, [&](const Vec3&, const Vec3&, const Vec3& force) { sum += force; });
  return sum;
}

/// The mean first Piola-Kirchhoff stress (Pa) by all forces from outside: Σ force ⊗ rest over the volume.
inline Matrix3 mean_stress(const Block& block, const SettledBlock& settled) {
  Matrix3 sum = Matrix3::Zero();
  for (std::size_t side = 0; side < block.sides.size(); ++side)
    for_each_force(block, settled, side,
                   [&](const Vec3& rest, const Vec3&, const Vec3& force) { sum += force * rest.transpose(); });
  return sum / block.size.prod();
}

/// How far apart two opposite sides are over that at rest, by the means of their points.
inline Real stretch_between(const Block& block, const SettledBlock& settled, std::size_t low, std::size_t high) {
  const Index axis = block.sides[low].axis;
  const auto mean = [&](std::size_t side) {
    Real sum = 0;
    for_each_force(block, settled, side, [&](const Vec3&, const Vec3& place, const Vec3&) { sum += place[axis]; });
    return sum / static_cast<Real>(block.sides[side].end - block.sides[side].begin);
  };
  return (mean(high) - mean(low)) / block.size[axis];
}

}  // namespace gracilis::tissue
