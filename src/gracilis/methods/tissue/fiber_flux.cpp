#include <gracilis/methods/tissue/fiber_flux.hpp>

#include <gracilis/geometry/disjoint_sets.hpp>
#include <gracilis/methods/tissue/lattice_field.hpp>

#include <algorithm>
#include <map>
#include <tuple>

namespace gracilis::tissue {

namespace {

/// The relative tension stays within its inverse and this: where an attachment is a few points, nothing pulls without
/// end.
constexpr Real largest_relative_tension = 60;
/// Of the mean gradient: less is no direction.
constexpr Real least_gradient = 1e-3;

Real value_at(const EmbeddedPoint& point, const Eigen::VectorXd& field) {
  Real value = 0;
  for (std::size_t k = 0; k < 4; ++k) value += point.weights[static_cast<Index>(k)] * field[point.nodes[k]];
  return value;
}

/// How firmly an attached point is drawn to the value of its end, m.
Real grip_of(const PreparedTissue& prepared, const SurfacePoint& point) {
  return attachment_grip * point.area / prepared.lattice.cell_size;
}

bool has(const PreparedTissue& prepared, AttachmentEnd end) {
  return std::any_of(prepared.points.begin(), prepared.points.end(),
                     [&](const SurfacePoint& point) { return point.held_by >= 0 && point.end == end; });
}

bool is_insertion(const SurfacePoint& point) { return point.end == AttachmentEnd::insertion; }

/// Drawn to 0 at origins and to 1 at insertions: how much flows through each attachment depends on the muscle's shape.
Eigen::VectorXd drawn_field(const PreparedTissue& prepared) {
  std::vector<FieldGrip> grips;
  for (const SurfacePoint& point : prepared.points)
    if (point.held_by >= 0) grips.push_back({point.at, grip_of(prepared, point), is_insertion(point) ? 0 : -1});
  return harmonic_lattice_fields(prepared.lattice, grips, 1).col(0);
}

/// A number for each node that tells which part of the lattice it belongs to.
std::vector<Index> parts_of_nodes(const Lattice& lattice) {
  DisjointSets joined(lattice.node_count());
  for (const Cell& cell : lattice.cells)
    for (const Index node : cell.nodes) joined.join(node, cell.nodes[0]);
  std::vector<Index> parts;
  for (Index n = 0; n < lattice.node_count(); ++n) parts.push_back(joined.find(n));
  return parts;
}

/// What flows through each attachment in each part of the lattice, spread evenly over its area. At the rim of a surface
/// that is drawn to one value a field is steep without end.
std::vector<FieldSource> even_sources(const PreparedTissue& prepared, const Eigen::VectorXd& drawn) {
  struct Sum {
    Real flow = 0, area = 0, held_area = 0;
  };
  const std::vector<Index> parts = parts_of_nodes(prepared.lattice);
  std::map<std::tuple<Index, Index, AttachmentEnd>, Sum> sums;
  const auto sum_of = [&](const SurfacePoint& point) -> Sum& {
    return sums[{parts[static_cast<std::size_t>(point.at.nodes[0])], point.held_by, point.end}];
  };
  for (const SurfacePoint& point : prepared.points) {
    if (point.held_by < 0) continue;
    Sum& sum = sum_of(point);
    sum.flow += grip_of(prepared, point) * ((is_insertion(point) ? 1 : 0) - value_at(point.at, drawn));
    sum.area += point.area;
    sum.held_area += point.held_area;
  }
  std::vector<FieldSource> sources;
  for (const SurfacePoint& point : prepared.points) {
    if (point.held_by < 0) continue;
    const Sum& sum = sum_of(point);
    // Vertices at a rim stand for a part of what is not held. Where there are single ones, for nothing else.
    const Real share = sum.held_area > 0 ? point.held_area / sum.held_area : point.area / sum.area;
    if (share > 0) sources.push_back({point.at, share * sum.flow});
  }
  return sources;
}

/// The mean size of the gradients by filled volume. Cells with attachments count only where there are no others: in
/// them fibers end, so that a part of each has none.
Real mean_of_belly(const PreparedTissue& prepared, const Points& gradients) {
  std::vector<char> holds(prepared.lattice.cells.size());
  for (const SurfacePoint& point : prepared.points)
    if (point.held_by >= 0) holds[static_cast<std::size_t>(point.at.cell)] = 1;
  std::array<Real, 2> sum{}, filled{};
  for (std::size_t c = 0; c < holds.size(); ++c) {
    const std::size_t which = holds[c] ? 1 : 0;
    sum[which] += prepared.lattice.cells[c].fill * gradients.col(static_cast<Index>(c)).norm();
    filled[which] += prepared.lattice.cells[c].fill;
  }
  return filled[0] > 0 ? sum[0] / filled[0] : sum[1] / filled[1];
}

}  // namespace

void lay_fibers(PreparedTissue& prepared) {
  const Lattice& lattice = prepared.lattice;
  prepared.directions = Points::Zero(3, lattice.cell_count());
  prepared.relative_tension.assign(lattice.cells.size(), 1);
  prepared.fiber_density.assign(lattice.cells.size(), 0);
  if (!has(prepared, AttachmentEnd::origin) || !has(prepared, AttachmentEnd::insertion)) return;
  const std::vector<FieldSource> sources = even_sources(prepared, drawn_field(prepared));
  Real flux = 0;  // into insertions; the same goes through every section
  for (const FieldSource& source : sources) flux += std::max(source.flow, 0.0);
  const Points gradients = cell_gradients(lattice, fed_lattice_field(lattice, sources));
  const Real mean = mean_of_belly(prepared, gradients);
  prepared.mean_section = flux / mean;
  Real squares = 0;
  for (Index c = 0; c < lattice.cell_count(); ++c) {
    const Real size = gradients.col(c).norm();
    if (!(size > least_gradient * mean)) continue;
    prepared.directions.col(c) = gradients.col(c) / size;
    prepared.relative_tension[static_cast<std::size_t>(c)] =
        std::clamp(size / mean, 1 / largest_relative_tension, largest_relative_tension);
    prepared.fiber_density[static_cast<std::size_t>(c)] = size;
    squares += filled_volume(lattice, lattice.cells[static_cast<std::size_t>(c)]) * size * size;
  }
  // So that its product with a tension, over all sections, is the mean of the tension's integrals over them.
  for (Real& density : prepared.fiber_density) density *= flux / squares;
}

}  // namespace gracilis::tissue
