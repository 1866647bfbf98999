#pragma once

#include <gracilis/io/run/recorded_run.hpp>

#include <filesystem>
#include <vector>

namespace gracilis {

struct GltfOptions {
  Index muscle_vertices = 4000;  ///< about, at most, of each muscle; they are some of its own
  Index bone_vertices = 4000;
  int frames = 60;              ///< at most; first, last and as many between as are allowed
  Real frames_per_second = 20;  ///< of the animation
};

/// One .glb (glTF 2.0) that plays: muscles as morph targets, one for each frame, of which one at a time has weight 1,
/// blended in between; bones as nodes that turn and move. In m, the subject upright (y up) and looking along +z, as
/// glTF wants it. Throws InputError.
void export_gltf(const RecordedRun& run, const std::filesystem::path& path, const GltfOptions& options = {});

/// A folder with one .obj per frame, in m, an object for each bone and muscle, and their colors in run.mtl. `frames`
/// are those of the run; precondition: they are there. Throws InputError.
void export_obj(const RecordedRun& run, const std::filesystem::path& folder, const std::vector<int>& frames);

/// A folder with every table of the run as .csv: measures, and fiber lengths and moment arms where it has them; and for
/// each muscle its points in these frames (frame, vertex, x, y, z in m). Throws InputError.
void export_csv(const RecordedRun& run, const std::filesystem::path& folder, const std::vector<int>& frames);

/// A folder with the tetrahedra of all muscles that are made of sections across their lines, MUSCLE_FRAME.vtu (see
/// write_tetrahedra), and two tables: sections.csv with each section's area and shape, and muscles.csv with volumes,
/// mass, physiological cross-section and the force that it makes with the specific tension (N/m²). Throws InputError.
void export_tetrahedra(const RecordedRun& run, const std::filesystem::path& folder, const std::vector<int>& frames,
                       Real specific_tension);

}  // namespace gracilis
