#include <gracilis/core/errors.hpp>
#include <gracilis/view/pictures/gif.hpp>
#include <gracilis/view/pictures/video.hpp>

#include <gtest/gtest.h>
#include <io/test_files.hpp>

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_GIF
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

#include <cstdlib>

using namespace gracilis;

namespace {

/// A red square that wanders over a gray ramp.
PixelImage wandering(int frame) {
  PixelImage image{61, 37, {}};
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const bool square = x >= 4 * frame && x < 4 * frame + 10 && y > 10 && y < 20;
      const auto gray = static_cast<unsigned char>(4 * x);
      for (const unsigned char c :
           {square ? static_cast<unsigned char>(200) : gray, square ? static_cast<unsigned char>(30) : gray,
            square ? static_cast<unsigned char>(20) : gray, static_cast<unsigned char>(255)})
        image.rgba.push_back(c);
    }
  }
  return image;
}

/// Few colors, hard to compress.
PixelImage noise(int frame) {
  PixelImage image{200, 150, {}};
  unsigned state = 12345u + static_cast<unsigned>(frame);
  for (int i = 0; i < image.width * image.height; ++i) {
    state = state * 1664525u + 1013904223u;
    for (int k = 0; k < 3; ++k) image.rgba.push_back(static_cast<unsigned char>((state >> (20 + 3 * k) & 3u) * 85));
    image.rgba.push_back(255);
  }
  return image;
}

std::string bytes_of(const std::filesystem::path& path) {
  std::stringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

/// Largest difference of a channel between the images and what another program reads from the file.
int largest_difference(const std::filesystem::path& path, int count, PixelImage (*image)(int)) {
  const std::string bytes = bytes_of(path);
  int width = 0, height = 0, frames = 0, channels = 0, *delays = nullptr;
  stbi_uc* pixels =
      stbi_load_gif_from_memory(reinterpret_cast<const stbi_uc*>(bytes.data()), static_cast<int>(bytes.size()), &delays,
                                &width, &height, &frames, &channels, 4);
  EXPECT_NE(pixels, nullptr);
  EXPECT_EQ(frames, count);
  int largest = frames == count ? 0 : 1000;
  for (int f = 0; f < frames && f < count; ++f) {
    const PixelImage truth = image(f);
    EXPECT_EQ(width, truth.width);
    EXPECT_EQ(height, truth.height);
    for (std::size_t i = 0; i < truth.rgba.size(); ++i)
      largest =
          std::max(largest, std::abs(pixels[static_cast<std::size_t>(f) * truth.rgba.size() + i] - truth.rgba[i]));
  }
  stbi_image_free(pixels);
  stbi_image_free(delays);
  return largest;
}

}  // namespace

TEST(Gif, another_program_reads_every_frame_back) {
  const TestFolder folder;
  write_gif(folder.path() / "a.gif", 8, 25, wandering);
  EXPECT_LE(largest_difference(folder.path() / "a.gif", 8, wandering), 8);
}

TEST(Gif, codes_of_all_lengths_and_a_full_dictionary_are_read_back) {
  const TestFolder folder;
  write_gif(folder.path() / "a.gif", 2, 25, noise);
  EXPECT_LE(largest_difference(folder.path() / "a.gif", 2, noise), 1);
}

TEST(Gif, what_does_not_change_costs_little) {
  const TestFolder folder;
  const auto still = [](int) { return noise(0); };
  write_gif(folder.path() / "one.gif", 1, 25, still);
  write_gif(folder.path() / "ten.gif", 10, 25, still);
  EXPECT_LT(std::filesystem::file_size(folder.path() / "ten.gif"),
            std::filesystem::file_size(folder.path() / "one.gif") * 1.3);
}

TEST(Video, ffmpeg_gets_every_pixel_of_every_frame) {
  const TestFolder folder;
  // Stands for ffmpeg: keeps what comes in where the film should go, which is the last word and, whatever it
  // looks like, a file.
  const auto program = folder.write("ffmpeg", "#!/bin/sh\nfor last; do :; done\ncase $last in file:*) ;; *) exit 1;; esac\ncat > \"${last#file:}\"\n");
  std::filesystem::permissions(program, std::filesystem::perms::owner_all);
  const std::string path = std::getenv("PATH");
  setenv("PATH", (folder.path().string() + ":" + path).c_str(), 1);
  write_video(folder.path() / "it's a film.mp4", 3, 25, wandering);
  setenv("PATH", path.c_str(), 1);
  std::string truth;
  for (int i = 0; i < 3; ++i) {
    const PixelImage image = wandering(i);
    truth.append(image.rgba.begin(), image.rgba.end());
  }
  EXPECT_EQ(bytes_of(folder.path() / "it's a film.mp4"), truth);
}

TEST(Video, without_ffmpeg_says_so) {
  const TestFolder folder;
  const std::string path = std::getenv("PATH");
  setenv("PATH", folder.path().c_str(), 1);
  try {
    write_video(folder.path() / "a.mp4", 3, 25, wandering);
    ADD_FAILURE() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::unsupported);
    EXPECT_NE(std::string(error.what()).find("ffmpeg"), std::string::npos);
  }
  setenv("PATH", path.c_str(), 1);
}
