#pragma once

#include <gracilis/simulate/taut_string.hpp>

namespace gracilis {

/// Whether p and q lie on opposite sides of a bone's shaft:
/// - the straight piece between them comes deeper into the bone than 2 mm and than a quarter of its half thickness
/// there;
/// - the bone goes on for three half thicknesses both ways along its axis there, so that nothing slides off its end;
/// - seen along that axis they lie more than 120 degrees apart, and neither lies in the bone's core.
/// The bone's middle is found by climbing the depth from the piece's deepest point; its axis is the principal one of
/// its inside within three half thicknesses of the middle.
bool is_across(const PlacedBones& bones, std::size_t bone, const Vec3& p, const Vec3& q);

/// Whether a line passes a bone on the wrong side: two neighboring points of it at least lie across the bone both from
/// the points at the same share of `way`, the taut way between the same ends, and from where the bone has carried those
/// of the line at rest. The first alone would blame lines that other tissue holds where a string slides away, the
/// second alone those that slide around a bone as the string does. `rest_line` is in the world frame of the capture
/// pose.
bool is_on_wrong_side(const PlacedBones& bones, const Points& line, const Points& rest_line, const Points& way);

}  // namespace gracilis
