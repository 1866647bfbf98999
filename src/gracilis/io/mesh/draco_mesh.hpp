#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace gracilis {

/// Positions and triangles of a mesh that Draco compressed.
struct DracoMesh {
  std::vector<double> positions;      ///< x y z x y z ...
  std::vector<std::int64_t> corners;  ///< three per triangle
  std::string error;                  ///< empty: it could be read
};

/// `position` is the attribute that holds the positions, by the number that the compression gave it.
DracoMesh decode_draco(const unsigned char* bytes, std::size_t size, int position);

}  // namespace gracilis
