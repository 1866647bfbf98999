#pragma once

#include <gracilis/core/types.hpp>
#include <gracilis/geometry/polylines.hpp>

#include <vtkSmartPointer.h>

class vtkPolyData;

namespace gracilis {

/// The arrays as VTK's mesh type: double points, 32-bit triangle indices. Copies.
vtkSmartPointer<vtkPolyData> to_vtk(const Points& points, const Eigen::Matrix3Xi& faces);

/// The same for lines.
vtkSmartPointer<vtkPolyData> to_vtk(const Polylines& lines);

}  // namespace gracilis
