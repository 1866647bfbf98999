#pragma once

#include <gracilis/view/pictures/picture.hpp>

#include <filesystem>
#include <functional>

namespace gracilis {

/// Writes a film (.mp4, H.264) through the program ffmpeg, whole or not at all. `image` is asked for each image in
/// order; all have one size. Throws Error with exit code 4 where there is no ffmpeg, InputError when it fails.
void write_video(const std::filesystem::path& path, int count, int frames_per_second,
                 const std::function<PixelImage(int)>& image);

}  // namespace gracilis
