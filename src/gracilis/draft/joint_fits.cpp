#include <gracilis/draft/joint_fits.hpp>

#include <gracilis/draft/spine_fits.hpp>
#include <gracilis/geometry/nearest_triangle.hpp>
#include <gracilis/geometry/revolution_fit.hpp>
#include <gracilis/geometry/sphere_fit.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gracilis {
namespace {

constexpr Index few_samples = 30;
constexpr Real farthest_axis = radians(35);  // from where anatomy expects it

Vec3 across(const Vec3& direction, const Vec3& axis) { return (direction - direction.dot(axis) * axis).normalized(); }

/// The nearest of several surfaces.
class Surroundings {
 public:
  Surroundings(const FoundFolder& found, const std::vector<std::size_t>& bones) {
    for (const std::size_t b : bones) trees_.emplace_back(found.bones[b].mesh);
  }
  bool empty() const { return trees_.empty(); }
  NearestPoint query(const Vec3& p, Real reach = std::numeric_limits<Real>::infinity()) const {
    NearestPoint best;
    for (const NearestTriangle& tree : trees_) {
      const NearestPoint found = tree.query(p, std::min(reach, best.distance));
      if (found.face >= 0 && found.distance < best.distance) best = found;
    }
    return best;
  }

 private:
  std::vector<NearestTriangle> trees_;
};

SurfaceSamples joined(const SurfaceSamples& a, const SurfaceSamples& b) {
  SurfaceSamples all{Points(3, a.count() + b.count()), Points(3, a.count() + b.count()),
                     Eigen::VectorXd(a.count() + b.count())};
  all.points << a.points, b.points;
  all.normals << a.normals, b.normals;
  all.areas << a.areas, b.areas;
  return all;
}

SurfaceSamples nothing() { return {Points(3, 0), Points(3, 0), Eigen::VectorXd(0)}; }

/// Parts of the bones' surfaces that face others which are near: within 4 mm more than the nearest are, or, where the
/// triangles are large, within as much as it takes to see a few. Nothing where all others are farther than 3 cm.
SurfaceSamples facing(const JointQuestion& q, const std::vector<std::size_t>& bones, const Surroundings& others) {
  SurfaceSamples all = nothing();
  for (const std::size_t b : bones) all = joined(all, surface_samples(q.found.bones[b].mesh));
  if (all.count() == 0) return all;
  std::vector<Real> distances(static_cast<std::size_t>(all.count()), std::numeric_limits<Real>::infinity());
  std::vector<char> turned(distances.size(), 0);
  for (Index i = 0; i < all.count(); ++i) {
    const NearestPoint nearest = others.query(all.points.col(i), 0.03 * q.found.size);
    if (nearest.face < 0) continue;
    const Vec3 towards = nearest.point - all.points.col(i);
    distances[static_cast<std::size_t>(i)] = nearest.distance;
    turned[static_cast<std::size_t>(i)] = towards.dot(all.normals.col(i)) > 0.6 * nearest.distance;
  }
  const Real least = *std::min_element(distances.begin(), distances.end());
  SurfaceSamples face = nothing();
  for (const Real spread : {0.004, 0.006, 0.009, 0.013}) {
    face = all.kept([&](Index i) {
      const auto k = static_cast<std::size_t>(i);
      return distances[k] <= least + spread * q.found.size && (turned[k] || distances[k] < 0.0005);
    });
    if (face.count() >= few_samples) break;
  }
  return face;
}

std::optional<JointFit> fit_ball(const JointQuestion& q) {
  const std::vector<std::size_t> convex = bones_named(q.found, q.joint.convex, q.side);
  if (convex.empty() || !q.axes[convex.front()]) return std::nullopt;
  const BoneAxis& axis = *q.axes[convex.front()];
  const Surroundings socket(q.found, bones_named(q.found, q.joint.concave, q.side));
  const SurfaceSamples all = surface_samples(q.found.bones[convex.front()].mesh);
  const SurfaceSamples end = all.kept([&](Index i) { return axis.share(all.points.col(i)) < 0.25; });
  // The socket lies about the ball: as far from its center as the ball reaches, and some cartilage.
  const auto liking = [&](const Vec3& center, Real radius) -> Real {
    if (socket.empty()) return 1;
    const Real gap = socket.query(center, 2 * radius).distance - radius;
    return gap > -0.35 * radius && gap < 0.35 * radius ? 1 : 0;
  };
  const SphereFit sphere =
      fit_sphere(end, q.joint.radius_min * q.found.size, q.joint.radius_max * q.found.size, liking);
  if (sphere.radius == 0 || sphere.share < 0.12) return std::nullopt;
  const Real certainty = std::clamp(0.5 + sphere.share, 0.0, 0.95);
  return JointFit{
      sphere.center, body_axes(q),
      fmt::format("a sphere of {:.1f} mm on {}, which covers {:.0f} % of it to {:.2f} mm", 1000 * sphere.radius,
                  q.found.bones[convex.front()].name, 100 * sphere.share, 1000 * sphere.residual),
      certainty};
}

/// The two spheres of condyles, of what lies right and left of the middle.
struct Condyles {
  SphereFit right, left;
};

Condyles fit_condyles(const JointQuestion& q, const SurfaceSamples& end, const Vec3& down, const Vec3& right) {
  const Vec3 forward = right.cross(down);
  const Eigen::RowVectorXd aside = right.transpose() * end.points;
  const Real middle = (aside.maxCoeff() + aside.minCoeff()) / 2;
  const auto half = [&](Real sign) {
    const SurfaceSamples part = end.kept([&](Index i) {
      const Vec3 n = end.normals.col(i);
      // The groove for the patella, the shaft and the sides are no part of the spheres.
      return sign * (aside[i] - middle) > 0 && n.dot(forward) < 0.35 && n.dot(down) > -0.6;
    });
    return fit_sphere(part, q.joint.radius_min * q.found.size, q.joint.radius_max * q.found.size);
  };
  return {half(1), half(-1)};
}

std::optional<JointFit> fit_hinge_of_condyles(const JointQuestion& q) {
  const std::vector<std::size_t> convex = bones_named(q.found, q.joint.convex, q.side);
  if (convex.empty() || !q.axes[convex.front()]) return std::nullopt;
  const BoneAxis& axis = *q.axes[convex.front()];
  const Vec3 down = axis.direction();
  const SurfaceSamples all = surface_samples(q.found.bones[convex.front()].mesh);
  const SurfaceSamples end = all.kept([&](Index i) { return axis.share(all.points.col(i)) > 0.87; });
  if (end.count() == 0) return std::nullopt;
  Vec3 right = across(q.frame.right(), down);
  Condyles condyles;
  for (int round = 0; round < 3; ++round) {
    condyles = fit_condyles(q, end, down, right);
    if (condyles.right.radius == 0 || condyles.left.radius == 0) return std::nullopt;
    right = across(condyles.right.center - condyles.left.center, down);
  }
  const Vec3 line = condyles.right.center - condyles.left.center;
  if (line.norm() < 0.02 * q.found.size) return std::nullopt;
  const Real off = std::acos(std::clamp(line.normalized().dot(q.frame.right()), -1.0, 1.0));
  const Vec3 direction =
      q.joint.coordinates.front().about.starts_with("-") ? Vec3(-line.normalized()) : line.normalized();
  return JointFit{
      (condyles.right.center + condyles.left.center) / 2,
      {direction},
      fmt::format("a line through spheres of {:.1f} and {:.1f} mm on the condyles of {}", 1000 * condyles.right.radius,
                  1000 * condyles.left.radius, q.found.bones[convex.front()].name),
      off < radians(20) ? 0.85 : 0.6};
}

/// The vertex that lies farthest along a direction.
Vec3 tip_along(const Vec3& direction, const TriangleMesh& mesh) {
  Eigen::Index tip = 0;
  (direction.transpose() * mesh.vertices).maxCoeff(&tip);
  return mesh.vertices.col(tip);
}

/// Along which way a hinge's axis runs about: at the ankle, seen from above, from the tip of one malleolus to that of
/// the other, and outwards down by 7.3 degrees (Inman 1976); else the body's right, at right angles to the longest bone
/// there.
Vec3 expected_axis(const JointQuestion& q, const std::vector<std::size_t>& bones) {
  Vec3 right = q.frame.named(q.joint.coordinates.front().about, q.side);
  const std::vector<std::size_t> fork = bones_named(q.found, {"tibia", "fibula"}, q.side);
  if (q.joint.name == "ankle" && fork.size() == 2 && q.axes[fork.front()]) {
    const Vec3 down = q.axes[fork.front()]->direction();
    const Vec3 outwards =
        across(tip_along(down, q.found.bones[fork[1]].mesh) - tip_along(down, q.found.bones[fork[0]].mesh), down);
    const Vec3 axis = (outwards + std::tan(radians(7.3)) * down).normalized();
    if (std::abs(axis.dot(right)) > std::cos(farthest_axis)) return axis.dot(right) > 0 ? axis : Vec3(-axis);
  }
  for (const std::size_t b : bones)
    if (q.axes[b]) return across(right, q.axes[b]->direction());
  return right;
}

/// Of the whole bones what lies on the roller: as far along its axis as the part that faces the others, about as far
/// from it, within 40 degrees of it, and turned outwards.
SurfaceSamples rolled_on(const JointQuestion& q, const std::vector<std::size_t>& bones, const RevolutionFit& fit,
                         const SurfaceSamples& face) {
  const Eigen::RowVectorXd along = fit.direction.transpose() * face.points;
  const Real low = along.minCoeff(), high = along.maxCoeff();
  SurfaceSamples all = nothing();
  for (const std::size_t b : bones) all = joined(all, surface_samples(q.found.bones[b].mesh));
  const auto outwards = [&](const Vec3& p) -> Vec3 {
    return (p - fit.center) - fit.direction.dot(p - fit.center) * fit.direction;
  };
  const auto beside_face = [&](const Vec3& out) {
    for (Index i = 0; i < face.count(); ++i)
      if (outwards(face.points.col(i)).normalized().dot(out) > std::cos(radians(40)) * out.norm()) return true;
    return false;
  };
  return all.kept([&](Index i) {
    const Real place = fit.direction.dot(all.points.col(i));
    const Vec3 out = outwards(all.points.col(i));
    const Real distance = out.norm();
    const Vec3 slide = fit.direction.cross(out) / std::max(distance, 1e-9);
    return place >= low && place <= high && distance > 0.6 * fit.radius && distance < 1.5 * fit.radius &&
           out.dot(all.normals.col(i)) > 0.4 * distance && std::abs(slide.dot(all.normals.col(i))) < 0.35 &&
           beside_face(out);
  });
}

std::optional<JointFit> fit_roller(const JointQuestion& q) {
  const std::vector<std::size_t> convex = bones_named(q.found, q.joint.convex, q.side);
  const std::vector<std::size_t> concave = bones_named(q.found, q.joint.concave, q.side);
  if (convex.empty() || concave.empty()) return std::nullopt;
  const SurfaceSamples face = facing(q, convex, Surroundings(q.found, concave));
  const Vec3 expected = expected_axis(q, q.axes[convex.front()] ? convex : concave);
  RevolutionFit fit;
  for (const Real bias : {0.1, 0.3, 1.0, 3.0}) {
    fit = fit_revolution(face, expected, bias);
    // Only a part of the roller faces the other bones in this pose; the rest of it says more about the axis.
    for (int round = 0; round < 4 && !fit.direction.isZero(); ++round)
      fit = fit_revolution(rolled_on(q, convex, fit, face), expected, bias);
    // A joint is no hinge about any axis: a surface that has several is asked for the one that anatomy expects.
    if (fit.direction.dot(expected) > std::cos(farthest_axis)) break;
  }
  if (fit.direction.isZero()) return std::nullopt;
  const Real size = q.found.size;
  const bool fits = fit.radius > 0.7 * q.joint.radius_min * size && fit.radius < 1.5 * q.joint.radius_max * size;
  const bool expected_there = fit.direction.dot(expected) > std::cos(farthest_axis);
  const Real certainty = !fits || !expected_there ? 0.3 : fit.misfit < 0.2 ? 0.85 : fit.misfit < 0.35 ? 0.7 : 0.5;
  return JointFit{fit.center,
                  {fit.direction},
                  fmt::format("the axis about which the joint's surface on {} slides along itself, {:.1f} mm below it",
                              q.found.bones[convex.front()].name, 1000 * fit.radius),
                  certainty};
}

Vec3 middle_by_area(const SurfaceSamples& samples) { return samples.points * samples.areas / samples.areas.sum(); }

/// Of what `keep` says, else of the whole surface.
Vec3 middle_where(const TriangleMesh& mesh, const std::function<bool(const Vec3&)>& keep) {
  const SurfaceSamples all = surface_samples(mesh);
  const SurfaceSamples part = all.kept([&](Index i) { return keep(all.points.col(i)); });
  return part.count() > 0 ? middle_by_area(part) : Vec3(mesh.vertices.rowwise().mean());
}

std::optional<JointFit> fit_pivot(const JointQuestion& q) {
  const std::vector<std::size_t> moving = bones_named(q.found, q.joint.convex, q.side);
  const std::vector<std::size_t> resting = bones_named(q.found, q.joint.concave, q.side);
  if (moving.empty() || resting.empty() || !q.axes[moving.front()] || !q.axes[resting.front()]) return std::nullopt;
  const FoundBone &radius = q.found.bones[moving.front()], &ulna = q.found.bones[resting.front()];
  const Vec3 near = middle_where(radius.mesh, [&](const Vec3& p) { return q.axes[moving.front()]->share(p) < 0.06; });
  const Vec3 far = middle_where(ulna.mesh, [&](const Vec3& p) { return q.axes[resting.front()]->share(p) > 0.95; });
  Vec3 axis = (near - far).normalized();
  if (axis.isZero()) return std::nullopt;
  if (q.side == BodySide::left) axis = -axis;
  return JointFit{near, {axis}, fmt::format("from the head of {} to the far end of {}", radius.name, ulna.name), 0.8};
}

std::optional<JointFit> fit_saddle(const JointQuestion& q) {
  const std::vector<std::size_t> convex = bones_named(q.found, q.joint.convex, q.side);
  const std::vector<std::size_t> concave = bones_named(q.found, q.joint.concave, q.side);
  if (convex.empty() || concave.empty() || !q.axes[concave.front()]) return std::nullopt;
  const BoneAxis& radius = *q.axes[concave.front()];
  const SurfaceSamples face = facing(q, convex, Surroundings(q.found, concave));
  if (face.count() == 0) return std::nullopt;
  const SphereFit sphere = fit_sphere(face, q.joint.radius_min * q.found.size, q.joint.radius_max * q.found.size);
  const Vec3 up = -radius.direction();
  const Vec3 center = sphere.radius > 0 ? sphere.center : Vec3(middle_by_area(face) - 0.015 * q.found.size * up);
  // In the anatomical position the radius lies outwards of the ulna, wherever the forearm is turned.
  Vec3 right = across(q.frame.right(), up);
  bool by_ulna = false;
  if (const auto ulna = bones_named(q.found, {"ulna"}, q.side); !ulna.empty() && q.axes[ulna.front()]) {
    const Vec3 outwards = across(radius.far - q.axes[ulna.front()]->far, up);
    right = q.side == BodySide::left ? Vec3(-outwards) : outwards;
    by_ulna = true;
  }
  BodyFrame local = q.frame;
  local.superior = up;
  local.anterior = up.cross(right);
  std::vector<Vec3> axes;
  for (const KnownCoordinate& coordinate : q.joint.coordinates) axes.push_back(local.named(coordinate.about, q.side));
  return JointFit{center, axes,
                  fmt::format("the middle of the bones beside {}, axes by {}", q.found.bones[concave.front()].name,
                              by_ulna ? "radius and ulna" : "the body's directions"),
                  by_ulna ? 0.7 : 0.5};
}

}  // namespace

std::vector<std::size_t> bones_named(const FoundFolder& found, const std::vector<std::string>& names, BodySide side) {
  std::vector<std::size_t> result;
  for (const std::string& name : names)
    for (std::size_t b = 0; b < found.bones.size(); ++b) {
      const FoundBone& bone = found.bones[b];
      if (bone.known && bone.known->name == name && (bone.side == side || bone.side == BodySide::none))
        result.push_back(b);
    }
  return result;
}

std::vector<Vec3> body_axes(const JointQuestion& q) {
  std::vector<Vec3> axes;
  for (const KnownCoordinate& coordinate : q.joint.coordinates) axes.push_back(q.frame.named(coordinate.about, q.side));
  return axes;
}

std::optional<JointFit> fit_joint(const JointQuestion& question) {
  switch (question.joint.kind) {
    case JointKind::ball:
      return fit_ball(question);
    case JointKind::condyles:
      return fit_hinge_of_condyles(question);
    case JointKind::roller:
      return fit_roller(question);
    case JointKind::pivot:
      return fit_pivot(question);
    case JointKind::saddle:
      return fit_saddle(question);
    case JointKind::disc:
    case JointKind::masses:
      return fit_vertebrae(question);
  }
  return std::nullopt;
}

}  // namespace gracilis
