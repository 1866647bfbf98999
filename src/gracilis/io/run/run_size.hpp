#pragma once

#include <gracilis/io/run/run_layout.hpp>
#include <gracilis/scene/scene.hpp>

#include <cstdint>
#include <string>

namespace gracilis {

/// What a run writes.
struct RunSize {
  double bytes = 0;
  std::int64_t files = 0;
};

/// About what frames of a scene take on the disk, as run folders have them: from the counts of vertices, triangles and
/// points of fibers. Of compact frames the most: coordinates that can be packed take less.
RunSize estimated_size(const Scene& scene, int frames, bool with_fibers, RunLayout layout = RunLayout::surfaces);

/// Bytes that corrections add to a frame: of each kind that a solver may have, three numbers a vertex.
double correction_bytes(const Scene& scene);

/// "8.1 GB", "310 MB", "12 kB".
std::string size_text(double bytes);

/// "40 s", "9 min", "1.5 h".
std::string duration_text(double seconds);

}  // namespace gracilis
