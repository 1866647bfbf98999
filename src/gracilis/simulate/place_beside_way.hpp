#pragma once

#include <gracilis/simulate/taut_way.hpp>

#include <optional>
#include <span>

namespace gracilis {

/// A point beside the nearest of a muscle's taut ways in the capture pose, which the way takes along.
struct PlaceBesideWay {
  std::size_t way = 0;
  Real share = 0;              ///< of the way's length, at the nearest place on it
  Vec3 along = Vec3::Zero();   ///< unit direction of the way around there
  Vec3 offset = Vec3::Zero();  ///< m, from that place to the point
};

/// Where p lies beside the ways; empty without any.
std::optional<PlaceBesideWay> place_beside(std::span<const TautWay> ways, const Vec3& p);

/// How far p is from the line that its way is when it is shifted by the offset, turned as the way's direction has
/// turned since: 0 where p went with its way, or slid along it. m.
Real distance_from_place(const PlaceBesideWay& place, std::span<const TautWay> ways, const Vec3& p);

}  // namespace gracilis
