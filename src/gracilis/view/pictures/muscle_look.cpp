#include <gracilis/view/pictures/muscle_look.hpp>

#include <gracilis/core/sort_unique.hpp>
#include <gracilis/geometry/harmonic_field.hpp>
#include <gracilis/geometry/nearest_points.hpp>
#include <gracilis/geometry/principal_axes.hpp>
#include <gracilis/geometry/topology.hpp>
#include <gracilis/view/pictures/muscle_colors.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>

namespace gracilis {
namespace {

constexpr Real middle = 0.5;

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// 0 below `low`, 1 above `high`, smooth in between.
Real smooth_step(Real low, Real high, Real value) {
  const Real t = std::clamp((value - low) / (high - low), Real{0}, Real{1});
  return t * t * (3 - 2 * t);
}

/// The cut of each face by a level, from the side where `left` lies higher; both points of a cut after each other.
std::vector<Vec3> level_cuts(const TriangleMesh& mesh, const Eigen::VectorXd& field, Real level) {
  std::vector<Vec3> points;
  for (const Eigen::Vector3i face : mesh.faces.colwise()) {
    Vec3 ends[2];
    int found = 0;
    for (int k = 0; k < 3; ++k) {
      const int a = face[k], b = face[(k + 1) % 3];
      if ((field[a] < level) == (field[b] < level)) continue;
      const Vec3 point = mesh.vertices.col(a) +
                         (level - field[a]) / (field[b] - field[a]) * Vec3(mesh.vertices.col(b) - mesh.vertices.col(a));
      ends[field[a] < level ? 0 : 1] = point;
      ++found;
    }
    if (found == 2) points.insert(points.end(), {ends[0], ends[1]});
  }
  return points;
}

/// What closed curves enclose, as far as it is flat: the length of their vector area.
Real enclosed_area(const std::vector<Vec3>& cuts) {
  Vec3 area = Vec3::Zero();
  for (std::size_t i = 0; i + 1 < cuts.size(); i += 2)
    area += Vec3(cuts[i] - cuts.front()).cross(Vec3(cuts[i + 1] - cuts.front()));
  return area.norm() / 2;
}

/// Tendon at levels from 0 to 1: from the largest section outwards nothing becomes belly again.
std::vector<Real> tendon_at_levels(const TriangleMesh& mesh, const Eigen::VectorXd& field) {
  constexpr int levels = 40;
  std::vector<Real> areas;
  for (int i = 0; i < levels; ++i) areas.push_back(enclosed_area(level_cuts(mesh, field, (i + 0.5) / levels)));
  const auto peak = std::max_element(areas.begin(), areas.end());
  const Real largest = *peak;
  for (auto area = peak; area + 1 != areas.end(); ++area) area[1] = std::min(area[0], area[1]);
  for (auto area = peak; area != areas.begin(); --area) area[-1] = std::min(area[0], area[-1]);
  std::vector<Real> tendon;
  for (const Real area : areas) tendon.push_back(largest > 0 ? 1 - smooth_step(0.1, 0.3, area / largest) : 0);
  return tendon;
}

Real blended(const std::vector<Real>& values, Real share) {
  const Real place = std::clamp(share * static_cast<Real>(values.size()) - 0.5, Real{0}, Real(values.size() - 1));
  const auto below = static_cast<std::size_t>(std::floor(place));
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return values[below] + (place - static_cast<Real>(below)) * (values[above] - values[below]);
}

/// The direction in which points spread most.
Vec3 widest_direction(const Points& points) {
  if (points.cols() < 2) return Vec3::UnitX();
  return spread_of(points).most();
}

/// Carries a coordinate across the fibers from the middle level to both ends, against the field's gradient vertex by
/// vertex, nearest to the middle first.
struct StripeCarrier {
  const TriangleMesh& mesh;
  const Eigen::VectorXd& field;
  Vec3 across;
  std::vector<std::vector<Index>> faces_of = {};
  std::vector<Real> carried = {};

  /// How far a vertex is from the middle level, on its own side.
  Real height(Index v, Real side) const { return side * (field[v] - middle); }

  /// Where the fiber through the vertex comes from, in this face; nothing where it comes from elsewhere.
  bool comes_through(Index face, Index v, Real side, Real& value) const {
    const Eigen::Vector3i corners = mesh.faces.col(face);
    int k = 0;
    while (corners[k] != v) ++k;
    const Index a = corners[(k + 1) % 3], b = corners[(k + 2) % 3];
    const Vec3 to_a = mesh.vertices.col(a) - mesh.vertices.col(v), to_b = mesh.vertices.col(b) - mesh.vertices.col(v);
    // The steepest way down: a combination of both edges.
    const Real aa = to_a.squaredNorm(), ab = to_a.dot(to_b), bb = to_b.squaredNorm(), det = aa * bb - ab * ab;
    if (!(det > 1e-12 * aa * bb)) return false;
    const Real down_a = side * (field[v] - field[a]), down_b = side * (field[v] - field[b]);
    const Real share_a = (bb * down_a - ab * down_b) / det, share_b = (aa * down_b - ab * down_a) / det;
    // A fiber along an edge comes through both faces there, not through none of them by rounding.
    const Real rounding = 1e-6 * (std::abs(share_a) + std::abs(share_b));
    if (share_a < -rounding || share_b < -rounding || !(share_a + share_b > 0)) return false;
    const Real of_b = std::clamp(share_b / (share_a + share_b), Real{0}, Real{1});
    const Real below = (1 - of_b) * height(a, side) + of_b * height(b, side), here = height(v, side);
    if (!(below < here)) return false;
    if (below <= 0) {
      const Vec3 way = (1 - of_b) * to_a + of_b * to_b;
      value = across.dot(mesh.vertices.col(v) + here / (here - below) * way);
      return true;
    }
    const Real w_a = carried[at(a)], w_b = carried[at(b)];
    if (std::isnan(w_a) && std::isnan(w_b)) return false;
    value = std::isnan(w_a) ? w_b : std::isnan(w_b) ? w_a : (1 - of_b) * w_a + of_b * w_b;
    return true;
  }

  /// Of the neighbor to which it goes down most steeply, where no face says it.
  Real from_neighbor(Index v, Real side) const {
    Real steepest = -std::numeric_limits<Real>::infinity(), value = across.dot(mesh.vertices.col(v));
    for (const Index face : faces_of[at(v)])
      for (const Index other : mesh.faces.col(face)) {
        if (other == v || std::isnan(carried[at(other)])) continue;
        const Real way = (mesh.vertices.col(other) - mesh.vertices.col(v)).norm();
        const Real slope = (height(v, side) - height(other, side)) / std::max(way, Real{1e-9});
        if (slope > steepest) steepest = slope, value = carried[at(other)];
      }
    return value;
  }

  std::vector<Real> carry() {
    faces_of.resize(at(mesh.vertex_count()));
    for (Index f = 0; f < mesh.face_count(); ++f)
      for (const Index v : mesh.faces.col(f)) faces_of[at(v)].push_back(f);
    carried.assign(at(mesh.vertex_count()), std::numeric_limits<Real>::quiet_NaN());
    std::vector<Index> order(at(mesh.vertex_count()));
    std::iota(order.begin(), order.end(), Index{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](Index a, Index b) { return std::abs(field[a] - middle) < std::abs(field[b] - middle); });
    for (const Index v : order) {
      const Real side = field[v] < middle ? -1 : 1;
      Real value = 0;
      const auto& faces = faces_of[at(v)];
      const bool found =
          std::any_of(faces.begin(), faces.end(), [&](Index face) { return comes_through(face, v, side, value); });
      carried[at(v)] = found ? value : from_neighbor(v, side);
    }
    return std::move(carried);
  }
};

/// A number from 0 to 1 that follows from another.
Real hashed(std::uint64_t value) {
  value = (value ^ (value >> 31)) * 0x7fb5d329728ea185ull;
  value = (value ^ (value >> 27)) * 0x81dadef4bc2dd44dull;
  return static_cast<Real>((value ^ (value >> 33)) >> 11) / static_cast<Real>(1ull << 53);
}

std::vector<Index> extreme_vertices(const Eigen::VectorXd& along, bool high) {
  const Real low_end = along.minCoeff(), high_end = along.maxCoeff(), reach = 0.03 * (high_end - low_end);
  std::vector<Index> found;
  for (Index v = 0; v < along.size(); ++v)
    if (high ? along[v] >= high_end - reach : along[v] <= low_end + reach) found.push_back(v);
  return found;
}

}  // namespace

MuscleLook muscle_look(const TriangleMesh& rest, const std::vector<Index>& origin,
                       const std::vector<Index>& insertion) {
  std::vector<Index> fixed;
  std::vector<Real> values;
  std::vector<char> is_fixed(at(rest.vertex_count()), 0);
  for (const auto& [end, value] : {std::pair{&origin, 0.0}, {&insertion, 1.0}})
    for (const Index v : *end)
      if (std::exchange(is_fixed[at(v)], 1) == 0) fixed.push_back(v), values.push_back(value);
  const MeshTopology topology = build_topology(rest.faces, rest.vertex_count());
  const Eigen::VectorXd field = harmonic_fields(rest.vertices, topology, fixed,
                                                Eigen::VectorXd::Map(values.data(), static_cast<Index>(values.size())));

  MuscleLook look;
  const std::vector<Real> levels = tendon_at_levels(rest, field);
  for (Index v = 0; v < rest.vertex_count(); ++v) look.tendon.push_back(blended(levels, field[v]));
  const std::vector<Vec3> section = level_cuts(rest, field, middle);
  Points points(3, static_cast<Index>(section.size()));
  for (std::size_t i = 0; i < section.size(); ++i) points.col(static_cast<Index>(i)) = section[i];
  look.stripes = StripeCarrier{rest, field, widest_direction(points)}.carry();
  return look;
}

MuscleLook muscle_look(const TriangleMesh& rest, const Polylines& fibers) {
  std::vector<Index> ends[2];
  if (fibers.count() > 0) {
    const NearestPoints nearest(rest.vertices);
    for (Index i = 0; i < fibers.count(); ++i) {
      ends[0].push_back(nearest.nearest(fibers.points.col(fibers.offsets[at(i)])));
      ends[1].push_back(nearest.nearest(fibers.points.col(fibers.offsets[at(i + 1)] - 1)));
    }
    for (std::vector<Index>& each : ends) {
      sort_unique(each);
    }
  } else {
    const Eigen::VectorXd along = rest.vertices.transpose() * widest_direction(rest.vertices);
    for (const int high : {0, 1}) ends[high] = extreme_vertices(along, high);
  }
  return muscle_look(rest, ends[0], ends[1]);
}

MuscleLook muscle_look(const Muscle& muscle) {
  std::vector<Index> ends[2];
  for (const Attachment& attachment : muscle.attachments) {
    std::vector<Index>& end = ends[attachment.end == AttachmentEnd::origin ? 0 : 1];
    end.insert(end.end(), attachment.vertices.begin(), attachment.vertices.end());
  }
  if (ends[0].empty() || ends[1].empty()) return muscle_look(muscle.surface, Polylines{});
  return muscle_look(muscle.surface, ends[0], ends[1]);
}

Color fiber_paint(std::string_view name) {
  const Real lightness = muscle_color(name).dot(Color(0.30, 0.59, 0.11));
  return Color(0.70, 0.24, 0.20) * (0.8 + 0.5 * lightness);
}

Color tendon_paint() { return {0.97, 0.95, 0.90}; }

Points natural_colors(const MuscleLook& look, std::string_view name) {
  const Color belly = fiber_paint(name), tendon = tendon_paint();
  Points colors(3, static_cast<Index>(look.tendon.size()));
  for (Index v = 0; v < colors.cols(); ++v) colors.col(v) = belly + look.tendon[at(v)] * (tendon - belly);
  return colors;
}

std::vector<Real> stripe_brightness(std::size_t count) {
  // Bundles of three widths; each is smooth noise that repeats.
  std::vector<Real> bright(count, 1);
  for (const auto& [bundles, depth] : {std::pair{8, 0.10}, {19, 0.12}, {43, 0.10}})
    for (std::size_t i = 0; i < count; ++i) {
      const Real place = static_cast<Real>(i) * bundles / static_cast<Real>(count);
      const auto below = static_cast<std::uint64_t>(place), above = (below + 1) % static_cast<std::uint64_t>(bundles);
      const auto salt = static_cast<std::uint64_t>(bundles) << 32;
      const Real t = smooth_step(0, 1, place - std::floor(place));
      bright[i] -= depth * ((1 - t) * hashed(below + salt) + t * hashed(above + salt));
    }
  return bright;
}

}  // namespace gracilis
