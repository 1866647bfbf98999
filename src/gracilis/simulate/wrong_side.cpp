#include <gracilis/simulate/wrong_side.hpp>

#include <gracilis/geometry/polylines.hpp>
#include <gracilis/geometry/principal_axes.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis {

namespace {

constexpr Real least_depth = 0.002;       ///< m; what a muscle overlaps a bone in data and does no harm
constexpr Real least_depth_share = 0.25;  ///< of the bone's half thickness
constexpr Real least_cosine = -0.5;       ///< of 120 degrees
constexpr Real stride = 0.0015;           ///< m, within a bone: half of a field's cell
constexpr Real reach_in_thickness = 3;    ///< half thicknesses around a place in which the bone's shape there shows
constexpr Real least_climb = 0.3;         ///< depth won over way gone; less leads along the bone, not to its middle

struct Place {
  Vec3 point = Vec3::Zero();
  Real depth = -std::numeric_limits<Real>::infinity();  ///< m, negative outside of the bone
};

Place deepest_between(const PlacedBones& bones, std::size_t bone, const Vec3& p, const Vec3& q) {
  const Real length = (q - p).norm();
  Place deepest;
  for (Real gone = 0; gone < length;) {
    const Vec3 at = p + (q - p) * (gone / length);
    const Real distance = bones.sample(bone, at).distance;
    if (-distance > deepest.depth) deepest = {at, -distance};
    gone += std::max(distance, stride);
  }
  return deepest;
}

/// The middle of the bone next to a point inside of it.
Place middle_near(const PlacedBones& bones, std::size_t bone, Place place) {
  for (;;) {
    const FieldSample at = bones.sample(bone, place.point);
    if (at.gradient.squaredNorm() < 1e-4f) return place;
    const Vec3 next = place.point - stride * bones.in_world(bone, at.gradient.normalized());
    const Real depth = -bones.sample(bone, next).distance;
    if (depth < place.depth + least_climb * stride) return place;
    place = {next, depth};
  }
}

/// The direction in which the bone extends most around a place in its middle: the principal axis of its points within
/// three half thicknesses of it.
Vec3 axis_at(const PlacedBones& bones, std::size_t bone, const Place& middle) {
  constexpr int across = 3;  // samples from the middle to the rim
  const Real step = reach_in_thickness * middle.depth / across;
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (int k = -across; k <= across; ++k)
    for (int j = -across; j <= across; ++j)
      for (int i = -across; i <= across; ++i) {
        const Vec3 away = step * Vec3(i, j, k);
        if (i * i + j * j + k * k > across * across) continue;
        if (bones.sample(bone, middle.point + away).distance < 0) spread += away * away.transpose();
      }
  return principal_axes(spread).most();
}

/// Whether the bone goes on both ways along the axis, so that nothing slides off its end nearby.
bool goes_on(const PlacedBones& bones, std::size_t bone, const Place& middle, const Vec3& axis) {
  for (const Real way : {-1.0, 1.0})
    for (Real along = 0.5; along <= reach_in_thickness; along += 0.5)
      if (bones.sample(bone, middle.point + way * along * middle.depth * axis).distance > 0) return false;
  return true;
}

}  // namespace

bool is_across(const PlacedBones& bones, std::size_t bone, const Vec3& p, const Vec3& q) {
  const Real length = (q - p).norm();
  if (length == 0 || bones.sample(bone, p).distance > length) return false;
  const Place deepest = deepest_between(bones, bone, p, q);
  if (deepest.depth < least_depth) return false;
  const Place middle = middle_near(bones, bone, deepest);
  if (deepest.depth < least_depth_share * middle.depth) return false;
  // An end inside of the bone is on no side of it.
  for (const Vec3& end : {p, q})
    if (-bones.sample(bone, end).distance > middle.depth / 2) return false;
  const Vec3 axis = axis_at(bones, bone, middle);
  if (!goes_on(bones, bone, middle, axis)) return false;
  const auto from_axis = [&](const Vec3& end) -> Vec3 {
    const Vec3 away = end - middle.point;
    return away - axis * axis.dot(away);
  };
  const Vec3 to_p = from_axis(p), to_q = from_axis(q);
  return to_p.dot(to_q) < least_cosine * to_p.norm() * to_q.norm();
}

bool is_on_wrong_side(const PlacedBones& bones, const Points& line, const Points& rest_line, const Points& way) {
  const auto parts = static_cast<Index>(way.cols() - 1);
  const Points now = resampled(line, parts), rest = resampled(rest_line, parts);
  for (std::size_t bone = 0; bone < bones.to_local.size(); ++bone) {
    const RigidTransform to_world = bones.to_local[bone].inverse();
    bool last = false;
    for (Index i = 1; i < parts; ++i) {
      // Few lines ever leave the side where they were at rest, so that is asked first.
      const bool across = is_across(bones, bone, to_world * Vec3(rest.col(i)), now.col(i)) &&
                          is_across(bones, bone, way.col(i), now.col(i));
      if (across && last) return true;
      last = across;
    }
  }
  return false;
}

}  // namespace gracilis
