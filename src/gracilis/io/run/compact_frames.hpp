#pragma once

#include <gracilis/geometry/polylines.hpp>
#include <gracilis/geometry/triangle_mesh.hpp>
#include <gracilis/io/mesh/mesh_writer.hpp>
#include <gracilis/scene/scene.hpp>
#include <gracilis/simulate/run.hpp>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace gracilis {

/// The bones in the capture pose and a script that shows them in ParaView beside the frames (File, Load State).
void write_compact_bones(const std::filesystem::path& folder, const Scene& scene);

/// All muscles of a frame in one file, and in it how the bones have moved. `arrays`: per muscle, of the same names.
void write_compact_shapes(const std::filesystem::path& folder, const Scene& scene, const Frame& frame,
                          const std::vector<std::vector<VertexArray>>& arrays);

/// All fibers of frame 0; in others only those that the method itself knows: the rest follows from the surfaces.
void write_compact_fibers(const std::filesystem::path& folder, const Scene& scene, const FrameRecord& record);

TriangleMesh read_compact_muscle(const std::filesystem::path& folder, const std::string& muscle, int frame);

/// A bone where its motion has taken it.
TriangleMesh read_compact_bone(const std::filesystem::path& folder, const std::string& bone, int frame);

/// Fibers of a run's frames, bound to their surfaces when they are first asked for. May be asked by several threads.
class CompactFibers {
 public:
  explicit CompactFibers(std::filesystem::path folder);
  ~CompactFibers();

  /// None where the muscle has none.
  Polylines read(const std::string& muscle, int frame) const;

 private:
  struct Bindings;
  std::filesystem::path folder_;
  std::unique_ptr<Bindings> bindings_;
};

}  // namespace gracilis
