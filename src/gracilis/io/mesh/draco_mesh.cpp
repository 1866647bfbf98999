#include <gracilis/io/mesh/draco_mesh.hpp>

#include <draco/compression/decode.h>

namespace gracilis {

DracoMesh decode_draco(const unsigned char* bytes, std::size_t size, int position) {
  DracoMesh result;
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(bytes), size);
  draco::Decoder decoder;
  auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
  if (!decoded.ok()) {
    result.error = decoded.status().error_msg_string();
    return result;
  }
  const draco::Mesh& mesh = *decoded.value();
  const draco::PointAttribute* places = mesh.GetAttributeByUniqueId(static_cast<std::uint32_t>(position));
  if (!places || places->num_components() != 3) {
    result.error = "no positions";
    return result;
  }
  for (draco::PointIndex p(0); p < mesh.num_points(); ++p) {
    double place[3] = {0, 0, 0};
    if (!places->ConvertValue<double, 3>(places->mapped_index(p), place)) result.error = "positions of an unknown kind";
    result.positions.insert(result.positions.end(), place, place + 3);
  }
  for (draco::FaceIndex f(0); f < mesh.num_faces(); ++f)
    for (const draco::PointIndex& corner : mesh.face(f)) result.corners.push_back(corner.value());
  return result;
}

}  // namespace gracilis
