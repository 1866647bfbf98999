#pragma once

#include <gracilis/geometry/triangle_mesh.hpp>

#include <vector>

/// Outlines of the open surfaces that say where muscles attach to bones.
namespace gracilis {

/// A rim of an open surface and the piece of it that the rim bounds.
struct PatchRim {
  Points points;  ///< along the rim in its order, about 8 mm apart, but 8 to 40 of them
  Points piece;   ///< all vertices of the piece
};

/// Of every rim with at least `least` vertices.
std::vector<PatchRim> patch_rims(const TriangleMesh& patches, std::size_t least);

}  // namespace gracilis
