#include <gracilis/view/pictures/stripes.hpp>

#include <gracilis/view/pictures/muscle_look.hpp>

#include <vtkImageData.h>
#include <vtkNew.h>

#include <cmath>

namespace gracilis {

vtkSmartPointer<vtkTexture> stripe_texture() {
  constexpr int width = 512;
  const std::vector<Real> bright = stripe_brightness(width);
  vtkNew<vtkImageData> image;
  image->SetDimensions(width, 2, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  auto* pixels = static_cast<unsigned char*>(image->GetScalarPointer());
  for (int i = 0; i < 2 * width; ++i)
    for (int k = 0; k < 3; ++k)
      *pixels++ = static_cast<unsigned char>(std::lround(255 * bright[static_cast<std::size_t>(i % width)]));
  auto texture = vtkSmartPointer<vtkTexture>::New();
  texture->SetInputData(image);
  texture->InterpolateOn();
  texture->MipmapOn();
  texture->RepeatOn();
  return texture;
}

vtkSmartPointer<vtkFloatArray> stripe_places(const std::vector<Real>& stripes) {
  auto array = vtkSmartPointer<vtkFloatArray>::New();
  array->SetNumberOfComponents(2);
  array->SetNumberOfTuples(static_cast<vtkIdType>(stripes.size()));
  for (std::size_t v = 0; v < stripes.size(); ++v)
    array->SetTuple2(static_cast<vtkIdType>(v), stripes[v] / stripe_width, 0.5);
  return array;
}

}  // namespace gracilis
