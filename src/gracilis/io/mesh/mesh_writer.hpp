#pragma once

#include <gracilis/core/types.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace gracilis {

/// One number or one vector per vertex, under a name that ParaView shows.
struct VertexArray {
  std::string name;
  Eigen::VectorXd values;  ///< `components` for each vertex in turn
  int components = 1;
};

/// Writes a surface as .vtp (appended, LZ4; double points, 32-bit indices), whole or not at all. What is read back has
/// the same bits. Points in m, 3 × n; faces 3 × m; arrays n each. May be called from several threads for different
/// files. Throws InputError with the path and the reason when the file cannot be written.
void write_surface(const std::filesystem::path& path, const Points& points, const Eigen::Matrix3Xi& faces,
                   const std::vector<VertexArray>& arrays = {});

}  // namespace gracilis
