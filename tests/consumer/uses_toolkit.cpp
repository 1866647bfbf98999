// Writes a triangle and reads it back.
#include <gracilis/io/mesh/mesh_reader.hpp>
#include <gracilis/io/mesh/mesh_writer.hpp>

#include <cstdio>

int main() {
  using namespace gracilis;
  Points points(3, 3);
  points << 0, 0.1, 0, 0, 0, 0.1, 0, 0, 0;
  write_surface("triangle.vtp", points, Eigen::Vector3i(0, 1, 2));
  const TriangleMesh mesh = read_mesh("triangle.vtp", 1);
  std::printf("%d vertices, %d triangle\n", mesh.vertex_count(), mesh.face_count());
  return mesh.vertices == points && mesh.face_count() == 1 ? 0 : 1;
}
