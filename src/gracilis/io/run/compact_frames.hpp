#pragma once

#include <gracilis/geometry/polylines.hpp>
#include <gracilis/geometry/triangle_mesh.hpp>
#include <gracilis/io/mesh/mesh_reader_vtp.hpp>
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

/// Surfaces of a run's frames. Each frame's file is read from the disk once, as long as those last asked for take no
/// more than `most_bytes` together. May be asked by several threads.
class CompactShapes {
 public:
  /// `folder` is a run folder of the layout `compact`; nothing is read yet.
  explicit CompactShapes(std::filesystem::path folder, std::size_t most_bytes = 256 << 20);
  ~CompactShapes();

  const std::filesystem::path& folder() const { return folder_; }  ///< of the run
  /// A muscle's surface, m. Throws InputError where the frame's file is damaged or has none of that name.
  TriangleMesh muscle(const std::string& name, int frame) const;
  /// Where its motion has taken it.
  TriangleMesh bone(const std::string& name, int frame) const;
  /// A frame's file, read where nobody has asked for it lately. Throws InputError.
  std::shared_ptr<const VtpFile> file(int frame) const;
  /// How many files of frames were read so far.
  int files_read() const;

 private:
  struct Kept;
  std::filesystem::path folder_;
  std::unique_ptr<Kept> kept_;
};

/// Fibers of a run's frames, bound to their surfaces when they are first asked for. May be asked by several threads.
class CompactFibers {
 public:
  /// Of the same run; nothing is read yet.
  explicit CompactFibers(std::shared_ptr<const CompactShapes> shapes);
  ~CompactFibers();

  /// None where the muscle has none.
  Polylines read(const std::string& muscle, int frame) const;

 private:
  struct Bindings;
  std::shared_ptr<const CompactShapes> shapes_;
  std::unique_ptr<Bindings> bindings_;
};

}  // namespace gracilis
