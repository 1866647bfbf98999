#pragma once

#include <vtkFloatArray.h>
#include <vtkSmartPointer.h>
#include <vtkTexture.h>

#include <vector>

namespace gracilis {

/// Stripes along the fibers, as a row of gray pixels that repeats.
vtkSmartPointer<vtkTexture> stripe_texture();

/// Where in it points lie; `stripes`: m across the fibers, as MuscleLook has them.
vtkSmartPointer<vtkFloatArray> stripe_places(const std::vector<double>& stripes);

}  // namespace gracilis
