#include <gracilis/simulate/place_beside_way.hpp>

#include <gracilis/geometry/point_segment.hpp>
#include <gracilis/geometry/polylines.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <limits>

namespace gracilis {

/// The direction is taken over this share of the way to either side, so that single kinks at bones do not turn it.
static constexpr Real direction_reach = 0.1;

static Vec3 direction_at(const Points& way, Real share) {
  const Real length = polyline_length(way);
  const Points ends = points_along(
      way, {std::max(share - direction_reach, Real{0}) * length, std::min(share + direction_reach, Real{1}) * length});
  return Vec3(ends.col(1) - ends.col(0)).stableNormalized();
}

std::optional<PlaceBesideWay> place_beside(std::span<const TautWay> ways, const Vec3& p) {
  std::optional<PlaceBesideWay> place;
  Real nearest = std::numeric_limits<Real>::infinity();
  for (std::size_t w = 0; w < ways.size(); ++w) {
    const Points& points = ways[w].points;
    Real before = 0;
    for (Eigen::Index i = 1; i < points.cols(); ++i) {
      const Vec3 a = points.col(i - 1), b = points.col(i);
      const Real share = nearest_on_segment<Vec3>(p, a, b), length = (b - a).norm();
      const Vec3 offset = p - a - share * (b - a);
      if (offset.norm() < nearest) {
        nearest = offset.norm();
        place = {w, before + share * length, Vec3::Zero(), offset};
      }
      before += length;
    }
  }
  if (!place) return place;
  const Points& way = ways[place->way].points;
  const Real length = polyline_length(way);
  place->share = length > 0 ? place->share / length : 0;
  place->along = direction_at(way, place->share);
  return place;
}

Real distance_from_place(const PlaceBesideWay& place, std::span<const TautWay> ways, const Vec3& p) {
  const Points& way = ways[place.way].points;
  const Eigen::Quaterniond turn = Eigen::Quaterniond::FromTwoVectors(place.along, direction_at(way, place.share));
  return distance_to_polyline(way, p - turn * place.offset);
}

}  // namespace gracilis
