#pragma once

#include <gracilis/geometry/polylines.hpp>
#include <gracilis/geometry/triangle_mesh.hpp>
#include <gracilis/scene/scene.hpp>
#include <gracilis/view/pictures/palette.hpp>

#include <string_view>
#include <vector>

namespace gracilis {

/// What a muscle's surface looks like: pale where it is tendon, red where it is belly, and striped along its fibers.
/// Values per vertex, from the shape at rest; they stay with the vertices in every pose.
struct MuscleLook {
  std::vector<Real> tendon;   ///< 0 belly ... 1 tendon
  std::vector<Real> stripes;  ///< m across the fibers, constant along each
};

/// Both follow the harmonic field from origin to insertion: fibers run along its gradient, and tendon is where the
/// muscle's section by a level of the field is much smaller than the largest one, at either end.
/// Preconditions: a closed surface, neither end empty.
MuscleLook muscle_look(const TriangleMesh& rest, const std::vector<Index>& origin, const std::vector<Index>& insertion);

/// The same with ends where the fibers (at rest, from origin to insertion) have theirs; without fibers where the
/// surface ends along its longest direction.
MuscleLook muscle_look(const TriangleMesh& rest, const Polylines& fibers);

/// By its attachments, where it has both ends.
MuscleLook muscle_look(const Muscle& muscle);

/// Colors per vertex. Muscles differ in lightness as their own colors do, so that neighbors can be told apart.
Points natural_colors(const MuscleLook& look, std::string_view name);
/// The color of a muscle's fibers beside that, and of its belly.
Color fiber_paint(std::string_view name);
/// The same for all muscles.
Color tendon_paint();

/// Of the texture of stripes: how bright it is (0 to 1) from one end of its width to the other, which is `stripe_width`
/// long and repeats.
inline constexpr Real stripe_width = 0.032;  ///< m
/// At so many places, evenly spaced.
std::vector<Real> stripe_brightness(std::size_t count);

}  // namespace gracilis
