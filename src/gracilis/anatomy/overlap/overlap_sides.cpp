#include <gracilis/anatomy/overlap/overlap_sides.hpp>

#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/topology.hpp>

#include <algorithm>

namespace gracilis {

namespace {

/// Length of the mean of unit ways out from which on they lead the same way: on average 60 degrees from it at most.
constexpr Real same_way = 0.5;

/// Numbers the parts into which the vertices with `wanted` hang together, from 0; -1 elsewhere. Returns how many.
int number_parts(const VertexStars& stars, const std::vector<char>& wanted, std::vector<int>& part) {
  part.assign(wanted.size(), -1);
  int count = 0;
  std::vector<Index> open;
  for (std::size_t seed = 0; seed < wanted.size(); ++seed) {
    if (!wanted[seed] || part[seed] >= 0) continue;
    part[seed] = count;
    open.push_back(static_cast<Index>(seed));
    while (!open.empty()) {
      const auto v = static_cast<std::size_t>(open.back());
      open.pop_back();
      for (Index i = stars.offsets[v]; i < stars.offsets[v + 1]; ++i) {
        const Index neighbor = stars.neighbors[static_cast<std::size_t>(i)];
        const auto at = static_cast<std::size_t>(neighbor);
        if (!wanted[at] || part[at] >= 0) continue;
        part[at] = count;
        open.push_back(neighbor);
      }
    }
    ++count;
  }
  return count;
}

struct Side {
  std::vector<Real> astray;
  Points ways;
  bool is_clear = true;
};

Side side_of(const InsideVertices& inside, const OverlappingSurface& surface) {
  const TriangleMesh& mesh = surface.mesh;
  const auto count = static_cast<std::size_t>(mesh.vertex_count());
  Side side{std::vector<Real>(count, 0), Points::Zero(3, static_cast<Eigen::Index>(count)), true};
  if (inside.vertices.empty()) return side;
  const VertexStars stars = build_topology(mesh.faces, mesh.vertex_count()).stars;
  const Eigen::VectorXd areas = vertex_areas(mesh.vertices, mesh.faces);
  std::vector<char> is_inside(count, 0), is_outside(count, 1);
  for (const Index v : inside.vertices)
    is_inside[static_cast<std::size_t>(v)] = 1, is_outside[static_cast<std::size_t>(v)] = 0;
  std::vector<int> region, piece;
  const auto regions = static_cast<std::size_t>(number_parts(stars, is_inside, region));
  const auto pieces = static_cast<std::size_t>(number_parts(stars, is_outside, piece));

  std::vector<Vec3> way(regions, Vec3::Zero());
  std::vector<Real> region_area(regions, 0), region_depth(regions, 0), belly_area(regions, 0), piece_area(pieces, 0);
  for (std::size_t i = 0; i < inside.vertices.size(); ++i) {
    const Index v = inside.vertices[i];
    const auto at = static_cast<std::size_t>(region[static_cast<std::size_t>(v)]);
    way[at] += areas[v] * inside.outward.col(static_cast<Eigen::Index>(i));
    region_area[at] += areas[v];
    region_depth[at] = std::max(region_depth[at], inside.depths[i]);
    if (surface.in_tendon.empty() || !surface.in_tendon[static_cast<std::size_t>(v)]) belly_area[at] += areas[v];
  }
  std::size_t largest = 0;
  for (std::size_t v = 0; v < count; ++v)
    if (piece[v] >= 0) piece_area[static_cast<std::size_t>(piece[v])] += areas[static_cast<Index>(v)];
  for (std::size_t p = 1; p < pieces; ++p)
    if (piece_area[p] > piece_area[largest]) largest = p;

  // A region that borders on a piece larger than itself, other than the largest, cuts the surface in two.
  std::vector<char> clear(regions);
  for (std::size_t r = 0; r < regions; ++r) clear[r] = way[r].norm() >= same_way * region_area[r];
  const auto for_each_border = [&](const auto& act) {
    for (std::size_t v = 0; v < count; ++v) {
      if (region[v] < 0) continue;
      for (Index i = stars.offsets[v]; i < stars.offsets[v + 1]; ++i)
        if (const int other = piece[static_cast<std::size_t>(stars.neighbors[static_cast<std::size_t>(i)])];
            other >= 0 && static_cast<std::size_t>(other) != largest)
          act(static_cast<std::size_t>(region[v]), static_cast<std::size_t>(other));
    }
  };
  for_each_border([&](std::size_t r, std::size_t p) {
    if (piece_area[p] > region_area[r]) clear[r] = 0;
  });
  std::vector<Real> cut_off(pieces, 0);  // by regions without a side: their depth
  for_each_border([&](std::size_t r, std::size_t p) {
    if (!clear[r]) cut_off[p] = std::max(cut_off[p], region_depth[r]);
  });

  Real clear_area = 0, area = 0;
  for (std::size_t r = 0; r < regions; ++r) area += belly_area[r], clear_area += clear[r] ? belly_area[r] : 0;
  side.is_clear = 2 * clear_area >= area;
  for (const Index v : inside.vertices)
    if (const auto r = static_cast<std::size_t>(region[static_cast<std::size_t>(v)]); clear[r])
      side.ways.col(v) = way[r].normalized();
  for (std::size_t v = 0; v < count; ++v) {
    const auto r = static_cast<std::size_t>(region[v]);
    if (region[v] < 0)
      side.astray[v] = cut_off[static_cast<std::size_t>(piece[v])];
    else if (!clear[r])
      side.astray[v] = region_depth[r];
  }
  return side;
}

}  // namespace

OverlapSides overlap_sides(const RestOverlap& overlap, const OverlappingSurface& first,
                           const OverlappingSurface& second) {
  Side of_first = side_of(overlap.of_first, first), of_second = side_of(overlap.of_second, second);
  OverlapSides sides;
  sides.is_through = (overlap.of_first.vertices.empty() || !of_first.is_clear) &&
                     (overlap.of_second.vertices.empty() || !of_second.is_clear);
  sides.first_astray = std::move(of_first.astray);
  sides.second_astray = std::move(of_second.astray);
  sides.first_ways = std::move(of_first.ways);
  sides.second_ways = std::move(of_second.ways);
  return sides;
}

}  // namespace gracilis
