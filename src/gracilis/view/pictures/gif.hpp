#pragma once

#include <gracilis/view/pictures/picture.hpp>

#include <filesystem>
#include <functional>

namespace gracilis {

/// An animation that repeats for ever; pixels that stay as they were are left out. `image` is asked once
/// for each, first for first, middle and last image, whose colors are those of all; all have one size. Throws
/// InputError, and what `image` throws. Precondition: count > 0, frames_per_second in 1 ... 50.
void write_gif(const std::filesystem::path& path, int count, int frames_per_second,
               const std::function<PixelImage(int)>& image);

}  // namespace gracilis
