#pragma once

#include <gracilis/view/pictures/picture.hpp>

#include <array>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace gracilis {

/// At most 255 colors that stand for those of the images: median cut (Heckbert 1982) over every few pixels.
std::vector<std::array<unsigned char, 3>> gif_palette(const std::vector<PixelImage>& images);

/// The variable-length codes of a GIF image's pixels (Welch 1984), in sub-blocks, with the code size before and the
/// terminator behind. `bits` is the number of bits of a pixel, 2 ... 8.
std::string gif_codes(const std::vector<unsigned char>& pixels, int bits);

/// An animation that repeats for ever; pixels that stay as they were are left out. `image` is asked for first, middle
/// and last image for the palette, then for all in order; all have one size. Throws InputError, and what `image`
/// throws. Precondition: count > 0, frames_per_second in 1 ... 50.
void write_gif(const std::filesystem::path& path, int count, int frames_per_second,
               const std::function<PixelImage(int)>& image);

}  // namespace gracilis
