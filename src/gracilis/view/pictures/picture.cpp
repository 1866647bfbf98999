#include <gracilis/view/pictures/picture.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/core/parallel.hpp>
#include <gracilis/io/atomic_file.hpp>
#include <gracilis/io/mesh/vtk_messages.hpp>
#include <gracilis/view/pictures/egl_context.hpp>
#include <gracilis/view/pictures/offscreen_window.hpp>
#include <gracilis/view/pictures/picture_layout.hpp>
#include <gracilis/view/pictures/picture_renderer.hpp>
#include <gracilis/view/pictures/soft_shadows.hpp>

#include <vtkCamera.h>
#include <vtkErrorCode.h>
#include <vtkFloatArray.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkRenderer.h>
#include <vtkRendererCollection.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace gracilis {

// Drawn this many times larger along each axis and averaged down: antialiasing that needs nothing from the driver.
static constexpr int oversampling = 2;

struct PictureDrawer::Window {
  EglContext context;  // outlives the window, whose destruction frees its OpenGL objects
  vtkSmartPointer<vtkGenericOpenGLRenderWindow> window;

  ~Window() { close(); }
  void close() {
    if (window) window->Finalize();
    window = nullptr;
  }
};

PictureDrawer::PictureDrawer() : window_(std::make_unique<Window>()) {}
PictureDrawer::~PictureDrawer() = default;

static PixelImage empty_image(const PictureLayout& layout, const Color& background) {
  PixelImage image{layout.width, layout.height, {}};
  image.rgba.resize(4 * static_cast<std::size_t>(layout.width) * static_cast<std::size_t>(layout.height), 255);
  for (std::size_t i = 0; i < image.rgba.size(); ++i)
    if (i % 4 < 3) image.rgba[i] = static_cast<unsigned char>(std::lround(255 * background[static_cast<Index>(i % 4)]));
  return image;
}

/// Averages blocks of oversampling² pixels into an area of the image; `pixels` holds RGBA rows of the area, enlarged,
/// bottom row first.
static void average_down(vtkUnsignedCharArray& pixels, const Rectangle& area, PixelImage& image) {
  const std::size_t of_row = 4 * static_cast<std::size_t>(area.width);
  parallel_for(area.height, 16, [&](Index begin, Index end) {
    for (Index row = begin; row < end; ++row) {
      const unsigned char* from =
          pixels.GetPointer(0) + static_cast<std::size_t>(row) * of_row * oversampling * oversampling;
      unsigned char* to = image.rgba.data() + 4 * (static_cast<std::size_t>(image.height - 1 - area.y - row) *
                                                       static_cast<std::size_t>(image.width) +
                                                   static_cast<std::size_t>(area.x));
      for (int column = 0; column < area.width; ++column, from += 4 * oversampling) {
        for (int channel = 0; channel < 3; ++channel) {
          int sum = 0;
          for (std::size_t j = 0; j < oversampling; ++j)
            for (std::size_t i = 0; i < oversampling; ++i)
              sum += from[j * of_row * oversampling + 4 * i + static_cast<std::size_t>(channel)];
          *to++ = static_cast<unsigned char>((sum + oversampling * oversampling / 2) / (oversampling * oversampling));
        }
        *to++ = 255;
      }
    }
  });
}

/// What both images show over their own background, white and black: a pixel that differs lets that much through.
static PixelImage without_background(const PixelImage& on_white, const PixelImage& on_black) {
  PixelImage image = on_black;
  for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
    int through = 0;
    for (std::size_t k = 0; k < 3; ++k) through = std::max(through, on_white.rgba[i + k] - on_black.rgba[i + k]);
    const int opacity = 255 - through;
    for (std::size_t k = 0; k < 3 && opacity > 0; ++k)
      image.rgba[i + k] = static_cast<unsigned char>(std::min(255, on_black.rgba[i + k] * 255 / opacity));
    image.rgba[i + 3] = static_cast<unsigned char>(opacity);
  }
  return image;
}

/// Of one of `oversampling`² pixels each; `area` is what the window shows.
static DepthImage depths_of(const Rectangle& part, const Rectangle& area, vtkRenderer& renderer,
                            vtkGenericOpenGLRenderWindow& window) {
  DepthImage image{part.width, part.height, {}};
  const int width = part.width * oversampling, height = part.height * oversampling;
  vtkNew<vtkFloatArray> all;
  const int x = (part.x - area.x) * oversampling, y = (part.y - area.y) * oversampling;
  window.GetZbufferData(x, y, x + width - 1, y + height - 1, all);
  const double* range = renderer.GetActiveCamera()->GetClippingRange();
  for (int row = 0; row < height; row += oversampling)
    for (int column = 0; column < width; column += oversampling) {
      const float z = all->GetValue(static_cast<vtkIdType>(row) * width + column);
      image.depths.push_back(z < 1 ? static_cast<float>(range[0] + z * (range[1] - range[0]))
                                   : std::numeric_limits<float>::infinity());
    }
  return image;
}

static PixelImage drawn(const Picture& picture, const PictureLayout& layout, vtkGenericOpenGLRenderWindow& window) {
  PixelImage image = empty_image(layout, picture.background);
  vtkNew<vtkUnsignedCharArray> pixels;  // with opacity, which nobody needs: what the driver need not repack is faster
  for (const Rectangle& area : areas_to_draw(layout)) {
    while (window.GetRenderers()->GetFirstRenderer()) window.RemoveRenderer(window.GetRenderers()->GetFirstRenderer());
    const int width = area.width * oversampling, height = area.height * oversampling;
    window.SetSize(width, height);
    const std::map<std::size_t, vtkRenderer*> of_panels = add_renderers(picture, layout, area, oversampling, window);
    window.Render();
    window.GetRGBACharPixelData(0, 0, width - 1, height - 1, 0, pixels, 0);
    average_down(*pixels, area, image);
    for (const auto& [i, renderer] : of_panels)
      if (!is_seen_through(picture.panels[i]))
        add_soft_shadows(depths_of(layout.panels[i], area, *renderer, window), layout.panels[i], layout.half_height,
                         image);
  }
  return image;
}

PixelImage PictureDrawer::draw(const Picture& picture, bool transparent) {
  const PictureLayout layout = lay_out(picture);
  VtkMessages messages;
  if (!window_->window) window_->window = make_offscreen_window(layout.width, layout.height);
  PixelImage image;
  if (transparent) {
    Picture copy = picture;
    copy.background = Color::Ones();
    const PixelImage on_white = drawn(copy, layout, *window_->window);
    copy.background = Color::Zero();
    image = without_background(on_white, drawn(copy, layout, *window_->window));
  } else {
    image = drawn(picture, layout, *window_->window);
  }
  if (messages.has_errors())
    throw Error(ExitCode::unsupported, "no picture can be drawn on this machine: " + messages.first_error());
  return image;
}

void write_png(const std::filesystem::path& path, const PixelImage& image) {
  bool opaque = true;
  for (std::size_t i = 3; i < image.rgba.size(); i += 4) opaque = opaque && image.rgba[i] == 255;
  const int channels = opaque ? 3 : 4;
  vtkNew<vtkImageData> data;
  data->SetDimensions(image.width, image.height, 1);
  data->AllocateScalars(VTK_UNSIGNED_CHAR, channels);
  auto* to = static_cast<unsigned char*>(data->GetScalarPointer());
  for (int row = image.height - 1; row >= 0; --row)
    for (int i = 0; i < 4 * image.width; ++i)
      if (i % 4 < channels) *to++ = image.rgba[static_cast<std::size_t>(row * image.width * 4 + i)];
  VtkMessages messages;
  write_file_atomically(path, [&](const std::filesystem::path& temporary) {
    vtkNew<vtkPNGWriter> writer;
    writer->SetInputData(data);
    writer->SetFileName(temporary.c_str());
    writer->Write();
    if (writer->GetErrorCode() != vtkErrorCode::NoError || messages.has_errors()) {
      throw InputError(
          {path.string(), "", "cannot be written: " + messages.first_error(), "check the free space of the disk"});
    }
  });
}

void render_picture(const Picture& picture, const std::filesystem::path& path) {
  write_png(path, PictureDrawer().draw(picture));
}

}  // namespace gracilis
