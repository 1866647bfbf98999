#include <gracilis/view/picture.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/io/atomic_file.hpp>
#include <gracilis/io/vtk_messages.hpp>
#include <gracilis/view/egl_context.hpp>
#include <gracilis/view/offscreen_window.hpp>
#include <gracilis/view/picture_layout.hpp>
#include <gracilis/view/picture_renderer.hpp>

#include <vtkErrorCode.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkUnsignedCharArray.h>

namespace gracilis {

// Drawn this many times larger along each axis and averaged down: antialiasing that needs nothing from the driver.
static constexpr int oversampling = 2;

/// Averages blocks of oversampling² pixels; `pixels` holds RGB rows of the larger image, bottom row first, as does the
/// result.
static vtkSmartPointer<vtkImageData> averaged_down(vtkUnsignedCharArray& pixels, int width, int height) {
  const auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(width, height, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  const unsigned char* from = pixels.GetPointer(0);
  auto* to = static_cast<unsigned char*>(image->GetScalarPointer());
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      for (int channel = 0; channel < 3; ++channel) {
        int sum = 0;
        for (int j = 0; j < oversampling; ++j) {
          for (int i = 0; i < oversampling; ++i) {
            const std::size_t y = static_cast<std::size_t>(row * oversampling + j);
            const std::size_t x = static_cast<std::size_t>(column * oversampling + i);
            sum +=
                from[(y * static_cast<std::size_t>(width * oversampling) + x) * 3 + static_cast<std::size_t>(channel)];
          }
        }
        *to++ = static_cast<unsigned char>((sum + oversampling * oversampling / 2) / (oversampling * oversampling));
      }
    }
  }
  return image;
}

static vtkSmartPointer<vtkImageData> draw(const Picture& picture) {
  const PictureLayout layout = lay_out(picture);
  const EglContext context;  // outlives the window, whose destruction frees its OpenGL objects
  const auto window = make_offscreen_window(layout.width * oversampling, layout.height * oversampling);
  add_renderers(picture, layout, oversampling, *window);
  window->Render();
  vtkNew<vtkUnsignedCharArray> pixels;
  window->GetPixelData(0, 0, layout.width * oversampling - 1, layout.height * oversampling - 1, 0, pixels, 0);
  window->Finalize();
  return averaged_down(*pixels, layout.width, layout.height);
}

void render_picture(const Picture& picture, const std::filesystem::path& path) {
  VtkMessages messages;
  const vtkSmartPointer<vtkImageData> image = draw(picture);
  if (messages.has_errors()) {
    throw Error(ExitCode::unsupported, "no picture can be drawn on this machine: " + messages.first_error());
  }
  write_file_atomically(path, [&](const std::filesystem::path& temporary) {
    vtkNew<vtkPNGWriter> writer;
    writer->SetInputData(image);
    writer->SetFileName(temporary.c_str());
    writer->Write();
    if (writer->GetErrorCode() != vtkErrorCode::NoError || messages.has_errors()) {
      throw InputError(
          {path.string(), "", "cannot be written: " + messages.first_error(), "check the free space of the disk"});
    }
  });
}

}  // namespace gracilis
