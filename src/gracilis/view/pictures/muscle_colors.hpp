#pragma once

#include <gracilis/view/pictures/palette.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace gracilis {

/// A muscle's color by its name, the same in pictures, window, report and plots, and on both sides of the body. Muscles
/// that lie and work together share a hue and differ in lightness, parts of a muscle less than muscles; a name that is
/// in no table gets the same color everywhere, too, by a hash.
Color muscle_color(std::string_view name);

}  // namespace gracilis
