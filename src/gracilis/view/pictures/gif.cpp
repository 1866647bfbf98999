#include <gracilis/view/pictures/gif.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/io/atomic_file.hpp>

#include <algorithm>
#include <cstdint>
#include <fstream>

namespace gracilis {

using Rgb = std::array<unsigned char, 3>;

static constexpr int most_colors = 255;
static constexpr unsigned char unchanged = 255;  // the transparent color

/// The channel in which colors differ most, and by how much.
static std::pair<int, std::size_t> widest_channel(const std::vector<Rgb>& colors) {
  std::pair<int, std::size_t> widest{0, 0};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto [low, high] =
        std::minmax_element(colors.begin(), colors.end(), [&](const Rgb& a, const Rgb& b) { return a[k] < b[k]; });
    if ((*high)[k] - (*low)[k] > widest.first) widest = {(*high)[k] - (*low)[k], k};
  }
  return widest;
}

std::vector<Rgb> gif_palette(const std::vector<PixelImage>& images) {
  std::vector<std::vector<Rgb>> boxes(1);
  for (const PixelImage& image : images)
    for (std::size_t i = 0; i + 3 < image.rgba.size(); i += 4 * 7)
      boxes[0].push_back({image.rgba[i], image.rgba[i + 1], image.rgba[i + 2]});
  // A plain background must not take all the colors: what is cut is the widest box, not the fullest.
  while (boxes.size() < most_colors) {
    const auto widest = std::max_element(boxes.begin(), boxes.end(), [](const auto& a, const auto& b) {
      return widest_channel(a).first < widest_channel(b).first;
    });
    const auto [width, k] = widest_channel(*widest);
    if (width == 0) break;
    std::sort(widest->begin(), widest->end(), [k = k](const Rgb& a, const Rgb& b) { return a[k] < b[k]; });
    // At a change of the value, so that neither half is empty and equal colors stay together.
    auto cut = std::lower_bound(widest->begin(), widest->end(), (*widest)[widest->size() / 2],
                                [k = k](const Rgb& a, const Rgb& b) { return a[k] < b[k]; });
    if (cut == widest->begin()) {
      cut = std::upper_bound(widest->begin(), widest->end(), widest->front(),
                             [k = k](const Rgb& a, const Rgb& b) { return a[k] < b[k]; });
    }
    std::vector<Rgb> upper(cut, widest->end());
    widest->erase(cut, widest->end());
    boxes.push_back(std::move(upper));
  }
  std::vector<Rgb> palette;
  for (const std::vector<Rgb>& box : boxes) {
    std::array<std::size_t, 3> sum{};
    for (const Rgb& color : box)
      for (std::size_t k = 0; k < 3; ++k) sum[k] += color[k];
    Rgb mean{};
    for (std::size_t k = 0; k < 3 && !box.empty(); ++k) mean[k] = static_cast<unsigned char>(sum[k] / box.size());
    palette.push_back(mean);
  }
  return palette;
}

namespace {

/// Codes of growing length, least significant bit first, in sub-blocks of at most 255 bytes.
class CodeWriter {
 public:
  void write(unsigned code, int length) {
    bits_ |= static_cast<std::uint64_t>(code) << count_;
    for (count_ += length; count_ >= 8; count_ -= 8, bits_ >>= 8) push(static_cast<char>(bits_ & 255));
  }
  std::string finish() {
    if (count_ > 0) push(static_cast<char>(bits_ & 255));
    flush();
    return std::move(out_) + '\0';
  }

 private:
  void push(char byte) {
    block_ += byte;
    if (block_.size() == 255) flush();
  }
  void flush() {
    if (block_.empty()) return;
    out_ += static_cast<char>(block_.size()) + block_;
    block_.clear();
  }

  std::uint64_t bits_ = 0;
  int count_ = 0;
  std::string block_, out_;
};

}  // namespace

std::string gif_codes(const std::vector<unsigned char>& pixels, int bits) {
  const unsigned clear = 1u << bits, end = clear + 1;
  static constexpr unsigned full = 4096;  // codes have 12 bits at most
  CodeWriter writer;
  // next[code][pixel]: the code for what `code` stands for with one more pixel; 0: none yet.
  std::vector<std::array<std::uint16_t, 256>> next(full);
  const auto restart = [&] {
    for (auto& row : next) row.fill(0);
  };
  restart();
  unsigned known = end + 1;
  int length = bits + 1;
  writer.write(clear, length);
  if (pixels.empty()) return static_cast<char>(bits) + (writer.write(end, length), writer.finish());
  unsigned code = pixels[0];
  for (std::size_t i = 1; i < pixels.size(); ++i) {
    const std::uint16_t longer = next[code][pixels[i]];
    if (longer != 0) {
      code = longer;
      continue;
    }
    writer.write(code, length);
    if (known < full) {
      next[code][pixels[i]] = static_cast<std::uint16_t>(known);
      if (known++ == (1u << length)) ++length;
    } else {
      writer.write(clear, length);
      restart();
      known = end + 1;
      length = bits + 1;
    }
    code = pixels[i];
  }
  writer.write(code, length);
  // A reader knows one more code by now and may have gone to longer ones.
  if (known < full && known == (1u << length)) ++length;
  writer.write(end, length);
  return static_cast<char>(bits) + writer.finish();
}

namespace {

/// The palette's nearest color, remembered for 5 bits of each channel.
class NearestColor {
 public:
  explicit NearestColor(const std::vector<Rgb>& palette) : palette_(palette), known_(1u << 15, -1) {}

  unsigned char operator()(const unsigned char* pixel) {
    const std::size_t key = static_cast<std::size_t>(pixel[0] >> 3 << 10 | pixel[1] >> 3 << 5 | pixel[2] >> 3);
    if (known_[key] < 0) {
      long least = std::numeric_limits<long>::max();
      for (std::size_t i = 0; i < palette_.size(); ++i) {
        long distance = 0;
        for (std::size_t k = 0; k < 3; ++k) {
          const long difference = pixel[k] - static_cast<long>(palette_[i][k]);
          distance += difference * difference;
        }
        if (distance < least) least = distance, known_[key] = static_cast<int>(i);
      }
    }
    return static_cast<unsigned char>(known_[key]);
  }

 private:
  const std::vector<Rgb>& palette_;
  std::vector<int> known_;
};

}  // namespace

static std::string two_bytes(int number) {
  return {static_cast<char>(number & 255), static_cast<char>(number >> 8 & 255)};
}

static std::string gif_head(const PixelImage& first, const std::vector<Rgb>& palette) {
  std::string head = "GIF89a" + two_bytes(first.width) + two_bytes(first.height) + "\xf7" + std::string(2, '\0');
  for (std::size_t i = 0; i < 256; ++i)
    for (std::size_t k = 0; k < 3; ++k) head += static_cast<char>(i < palette.size() ? palette[i][k] : 0);
  return head + std::string("\x21\xff\x0bNETSCAPE2.0\x03\x01\0\0\0", 19);  // for ever
}

void write_gif(const std::filesystem::path& path, int count, int frames_per_second,
               const std::function<PixelImage(int)>& image) {
  const std::vector<Rgb> palette = gif_palette({image(0), image(count / 2), image(count - 1)});
  NearestColor nearest(palette);
  std::string gif;
  std::vector<unsigned char> last;
  for (int i = 0; i < count; ++i) {
    const PixelImage now = image(i);
    if (i == 0) gif = gif_head(now, palette);
    std::vector<unsigned char> pixels(now.rgba.size() / 4);
    for (std::size_t p = 0; p < pixels.size(); ++p) pixels[p] = nearest(&now.rgba[4 * p]);
    std::vector<unsigned char> changes = pixels;
    for (std::size_t p = 0; p < last.size(); ++p)
      if (pixels[p] == last[p]) changes[p] = unchanged;
    // Shown for 1/100 s each, left standing, transparent where unchanged.
    gif +=
        std::string("\x21\xf9\x04\x05", 4) + two_bytes(100 / frames_per_second) + static_cast<char>(unchanged) + '\0';
    gif += ',' + std::string(4, '\0') + two_bytes(now.width) + two_bytes(now.height) + '\0' + gif_codes(changes, 8);
    last = std::move(pixels);
  }
  write_text_atomically(path, gif + ';');
}

}  // namespace gracilis
