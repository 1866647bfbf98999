#pragma once

#include <gracilis/core/types.hpp>

namespace gracilis {

/// Unit normals at a surface's vertices, those of its triangles weighted by their areas; zero where there is none.
/// 3 × n.
Points vertex_normals(const Points& vertices, const Eigen::Matrix3Xi& faces);

}  // namespace gracilis
