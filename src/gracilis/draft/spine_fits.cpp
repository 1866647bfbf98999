#include <gracilis/draft/spine_fits.hpp>

#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/nearest_triangle.hpp>
#include <gracilis/geometry/symmetry_plane.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gracilis {
namespace {

constexpr Real highest_gap = 0.02;            // m, of a grown person: no disc is as high
constexpr Real touching = 0.002;              // m: surfaces as near may run through each other
constexpr Real masses_spread = 0.004;         // m, by which the gap between the joints' surfaces on both sides varies
constexpr Real farthest_right = radians(25);  // of a bone's own symmetry from the body's
constexpr Real worst_symmetry = 0.004;        // m

/// What of the lower bone faces the upper one across the gap.
struct Gap {
  SurfaceSamples lower;
  Points middles, upper_normals;  ///< halfway across, and of the upper bone there, 3 × n
  Eigen::VectorXd heights;        ///< m

  Index count() const { return lower.count(); }
  Gap kept(const std::function<bool(Index)>& keep) const {
    std::vector<Index> numbers;
    for (Index i = 0; i < count(); ++i)
      if (keep(i)) numbers.push_back(i);
    return {lower.kept(keep), middles(Eigen::all, numbers), upper_normals(Eigen::all, numbers), heights(numbers)};
  }
  Real area() const { return lower.areas.sum(); }
  Vec3 middle() const { return middles * lower.areas / area(); }
  Real height() const { return heights.dot(lower.areas) / area(); }
  Vec3 up() const { return (lower.normals * lower.areas - upper_normals * lower.areas).normalized(); }
};

/// Parts that face each other within an angle of up.
Gap gap_between(const TriangleMesh& lower, const TriangleMesh& upper, const NearestTriangle& tree, const Vec3& up,
                Real angle, Real reach) {
  const Real aligned = std::cos(angle);
  const SurfaceSamples all = surface_samples(lower);
  Points middles(3, all.count()), normals(3, all.count());
  Eigen::VectorXd heights(all.count());
  std::vector<char> faces(static_cast<std::size_t>(all.count()), 0);
  for (Index i = 0; i < all.count(); ++i) {
    const Vec3 p = all.points.col(i), normal = all.normals.col(i);
    if (normal.dot(up) < aligned) continue;
    const NearestPoint nearest = tree.query(p, reach);
    if (nearest.face < 0) continue;
    const Vec3 across = nearest.point - p;
    normals.col(i) = area_vector(upper.vertices, upper.faces.col(nearest.face)).normalized();
    if (normals.col(i).dot(up) > -aligned) continue;
    if (nearest.distance > touching && across.dot(normal) < 0.7 * nearest.distance) continue;
    middles.col(i) = p + across / 2;
    heights[i] = nearest.distance;
    faces[static_cast<std::size_t>(i)] = 1;
  }
  return Gap{all, middles, normals, heights}.kept([&](Index i) { return faces[static_cast<std::size_t>(i)] != 0; });
}

/// Where most of the gap lies within a disc's radius: on the end plates, not on processes that face each other, too.
Gap end_plates(const Gap& gap, Real radius) {
  Index best = 0;
  Real most = 0;
  const auto near = [&](Index i, Index j) { return (gap.middles.col(i) - gap.middles.col(j)).norm() < radius; };
  const Index step = 1 + gap.count() / 300;
  for (Index i = 0; i < gap.count(); i += step) {
    Real area = 0;
    // The nearer, the more: else a window that holds all of a plate is as good off its middle.
    for (Index j = 0; j < gap.count(); ++j)
      if (near(i, j)) area += gap.lower.areas[j] * (1 - (gap.middles.col(i) - gap.middles.col(j)).norm() / radius);
    if (area > most) most = area, best = i;
  }
  return gap.kept([&](Index j) { return near(best, j); });
}

/// The joints' surfaces on both sides are where the two bones come nearest.
Gap lateral_masses(const Gap& gap, Real size) {
  std::vector<Real> heights(gap.heights.begin(), gap.heights.end());
  const auto tenth = heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 10);
  std::nth_element(heights.begin(), tenth, heights.end());
  return gap.kept([&](Index i) { return gap.heights[i] <= *tenth + masses_spread * size; });
}

/// Of two vertebrae with planes of symmetry of their own; the body's where they have none.
Vec3 right_of(const JointQuestion& q, const std::vector<std::size_t>& bones, const Vec3& up, int& by_symmetry) {
  Vec3 sum = Vec3::Zero();
  for (const std::size_t b : bones) {
    const SymmetryPlane plane = symmetry_plane(q.found.bones[b].mesh, q.frame.right());
    if (plane.normal.dot(q.frame.right()) < std::cos(farthest_right) || plane.misfit > worst_symmetry * q.found.size)
      continue;
    sum += plane.normal;
    ++by_symmetry;
  }
  const Vec3 right = by_symmetry > 0 ? sum : q.frame.right();
  return (right - right.dot(up) * up).normalized();
}

/// The first of these names that is here: a vertebra, or what holds it.
std::optional<std::size_t> first_named(const JointQuestion& q, const std::vector<std::string>& names) {
  const std::vector<std::size_t> all = bones_named(q.found, names, q.side);
  return all.empty() ? std::nullopt : std::optional(all.front());
}

}  // namespace

std::optional<JointFit> fit_vertebrae(const JointQuestion& q) {
  const std::optional<std::size_t> upper = first_named(q, q.joint.convex), lower = first_named(q, q.joint.concave);
  if (!upper || !lower) return std::nullopt;
  const FoundBone &above = q.found.bones[*upper], &below = q.found.bones[*lower];
  const NearestTriangle tree(above.mesh);
  const Real size = q.found.size, radius = q.joint.radius_max * size;
  Vec3 up = q.frame.superior;
  Gap gap;
  // A sacrum's end plate leans forward by half a right angle; about the level's own up the others fall off.
  for (const Real angle : {radians(65), radians(50), radians(40), radians(40)}) {
    gap = gap_between(below.mesh, above.mesh, tree, up, angle, highest_gap * size);
    if (gap.count() < 3) return std::nullopt;
    gap = q.joint.kind == JointKind::disc ? end_plates(gap, radius) : lateral_masses(gap, size);
    up = gap.up();
  }
  const Real covered = gap.area() / (pi * radius * radius);
  if (covered < 0.02) return std::nullopt;
  int by_symmetry = 0;
  const Vec3 right = right_of(q, {*upper, *lower}, up, by_symmetry);
  BodyFrame local = q.frame;
  local.superior = up;
  local.anterior = up.cross(right);
  JointFit fit{gap.middle(), {}, "", 0};
  for (const KnownCoordinate& coordinate : q.joint.coordinates)
    fit.axes.push_back(local.named(coordinate.about, q.side));
  const char* between = q.joint.kind == JointKind::disc ? "end plates" : "joints on both sides";
  fit.how = fmt::format("the middle of the gap of {:.1f} mm between the {} of {} and {}, axes by {} and {}",
                        1000 * gap.height(), between, below.name, above.name,
                        q.joint.kind == JointKind::disc ? "these" : "them",
                        by_symmetry > 0 ? "the bones' symmetry" : "the body's directions");
  fit.certainty = (covered < 0.15 ? 0.5 : 0.8) - (by_symmetry > 0 ? 0 : 0.15);
  return fit;
}

}  // namespace gracilis
