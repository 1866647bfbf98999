#pragma once

#include <gracilis/geometry/triangle_mesh.hpp>

#include <string>
#include <vector>

/// Muscles as implicit surfaces of radial basis functions (Cervenka 2024, sections 5.6 and 5.13).
namespace gracilis {

/// gluteus_maximus_r of the built-in hip.
TriangleMesh builtin_gluteus();

/// What describing a surface by fewer functions costs.
struct SolidErrors {
  Index centers = 0;
  Real volume = 0;     ///< relative, without sign
  Real hausdorff = 0;  ///< m
  Real mean = 0;       ///< m, from the extracted vertices to the surface
  Real condition = 0;
};

/// Thin plates at so many centers, extracted again at `step` (m).
SolidErrors solid_errors(const TriangleMesh& surface, Index centers, Real step);

}  // namespace gracilis
