#include <gracilis/view/export/export_surfaces.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/io/atomic_file.hpp>
#include <gracilis/io/mesh/mesh_writer.hpp>

namespace gracilis {

namespace fs = std::filesystem;

void export_surfaces(const RecordedRun& run, const fs::path& folder, const std::vector<int>& frames) {
  create_folder(folder);
  std::vector<std::string> names = run.muscles;
  names.insert(names.end(), run.bones.begin(), run.bones.end());
  for (const int frame : frames)
    parallel_for_each(names.size(), [&](std::size_t i) {
      const TriangleMesh surface = recorded_surface(run, names[i], frame);
      write_surface(folder / frame_file("", names[i], frame).filename(), surface.vertices, surface.faces);
    });
}

}  // namespace gracilis
