#include <gracilis/view/pictures/gif.hpp>

#include <gracilis/io/atomic_file.hpp>

#include <gif_lib.h>

#include <algorithm>
#include <cassert>
#include <limits>
#include <map>
#include <new>
#include <utility>

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

/// At most 255 colors that stand for those of the images: median cut (Heckbert 1982) over every few pixels.
static std::vector<Rgb> gif_palette(const std::vector<const PixelImage*>& images) {
  struct Box {
    std::vector<Rgb> colors;
    std::pair<int, std::size_t> widest = widest_channel(colors);
  };
  std::vector<Rgb> all;
  for (const PixelImage* image : images)
    for (std::size_t i = 0; i + 3 < image->rgba.size(); i += 4 * 7)
      all.push_back({image->rgba[i], image->rgba[i + 1], image->rgba[i + 2]});
  std::vector<Box> boxes = {{std::move(all)}};
  // A plain background must not take all the colors: what is cut is the widest box, not the fullest.
  while (boxes.size() < most_colors) {
    Box& widest = *std::max_element(boxes.begin(), boxes.end(),
                                    [](const Box& a, const Box& b) { return a.widest.first < b.widest.first; });
    if (widest.widest.first == 0) break;
    std::vector<Rgb>& colors = widest.colors;
    const auto less = [k = widest.widest.second](const Rgb& a, const Rgb& b) { return a[k] < b[k]; };
    std::sort(colors.begin(), colors.end(), less);
    // At a change of the value, so that neither half is empty and equal colors stay together.
    auto cut = std::lower_bound(colors.begin(), colors.end(), colors[colors.size() / 2], less);
    if (cut == colors.begin()) cut = std::upper_bound(colors.begin(), colors.end(), colors.front(), less);
    Box upper{{cut, colors.end()}};
    colors.erase(cut, colors.end());
    widest = {std::move(colors)};
    boxes.push_back(std::move(upper));
  }
  std::vector<Rgb> palette;
  for (const auto& [box, widest] : boxes) {
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

namespace {

/// A file of giflib's that is written into memory.
class GifText {
 public:
  GifText() {
    int problem = 0;
    file_ = EGifOpen(&text_, append, &problem);
    if (file_ == nullptr) throw std::bad_alloc();
    EGifSetGifVersion(file_, true);
  }
  ~GifText() {
    if (file_ != nullptr) EGifCloseFile(file_, nullptr);
  }
  GifText(const GifText&) = delete;
  GifText& operator=(const GifText&) = delete;

  /// Size, colors, and that it repeats for ever.
  void begin(int width, int height, const std::vector<Rgb>& palette) {
    std::array<GifColorType, 256> colors{};
    for (std::size_t i = 0; i < palette.size(); ++i) colors[i] = {palette[i][0], palette[i][1], palette[i][2]};
    ColorMapObject* const map = GifMakeMapObject(256, colors.data());
    if (map == nullptr) throw std::bad_alloc();
    const int result = EGifPutScreenDesc(file_, width, height, 8, 0, map);
    GifFreeMapObject(map);
    check(result);
    check(EGifPutExtensionLeader(file_, APPLICATION_EXT_FUNC_CODE));
    check(EGifPutExtensionBlock(file_, 11, "NETSCAPE2.0"));
    check(EGifPutExtensionBlock(file_, 3, "\x01\0\0"));
    check(EGifPutExtensionTrailer(file_));
  }

  /// An image that stays where the next one is transparent.
  void add(int width, int height, std::vector<unsigned char> pixels, int hundredths) {
    const GraphicsControlBlock control{DISPOSE_DO_NOT, false, hundredths, unchanged};
    std::array<GifByteType, 4> bytes{};
    EGifGCBToExtension(&control, bytes.data());
    check(EGifPutExtension(file_, GRAPHICS_EXT_FUNC_CODE, 4, bytes.data()));
    check(EGifPutImageDesc(file_, 0, 0, width, height, false, nullptr));
    check(EGifPutLine(file_, pixels.data(), static_cast<int>(pixels.size())));
  }

  std::string end() {
    check(EGifCloseFile(std::exchange(file_, nullptr), nullptr));
    return std::move(text_);
  }

 private:
  static int append(GifFileType* file, const GifByteType* bytes, int count) {
    static_cast<std::string*>(file->UserData)
        ->append(reinterpret_cast<const char*>(bytes), static_cast<std::size_t>(count));
    return count;
  }
  /// Memory takes all that is written: what can fail is memory.
  static void check(int result) {
    if (result != GIF_OK) throw std::bad_alloc();
  }

  std::string text_;
  GifFileType* file_;
};

}  // namespace

void write_gif(const std::filesystem::path& path, int count, int frames_per_second,
               const std::function<PixelImage(int)>& image) {
  std::map<int, PixelImage> telling;
  std::vector<const PixelImage*> of_palette;
  for (const int i : {0, count / 2, count - 1})
    if (!telling.contains(i)) of_palette.push_back(&telling.emplace(i, image(i)).first->second);
  const std::vector<Rgb> palette = gif_palette(of_palette);
  NearestColor nearest(palette);
  GifText gif;
  std::vector<unsigned char> last;
  for (int i = 0; i < count; ++i) {
    const auto known = telling.find(i);
    const PixelImage now = known != telling.end() ? std::move(known->second) : image(i);
    assert(last.empty() || now.rgba.size() == 4 * last.size());
    if (i == 0) gif.begin(now.width, now.height, palette);
    std::vector<unsigned char> pixels(now.rgba.size() / 4);
    for (std::size_t p = 0; p < pixels.size(); ++p) pixels[p] = nearest(&now.rgba[4 * p]);
    std::vector<unsigned char> changes = pixels;
    for (std::size_t p = 0; p < last.size(); ++p)
      if (pixels[p] == last[p]) changes[p] = unchanged;
    gif.add(now.width, now.height, std::move(changes), 100 / frames_per_second);
    last = std::move(pixels);
  }
  write_text_atomically(path, gif.end());
}

}  // namespace gracilis
