#pragma once

#include <gracilis/io/run/recorded_run.hpp>

#include <nlohmann/json.hpp>

#include <string>

namespace gracilis {

/// What the report's view shows of a run. Numbers stand in `bytes` (little endian, each array at a multiple of 4);
/// `description` says where, beginning at its "..._at":
///
///   frames     which frames are there, ascending; the first and the last of the run are
///   surfaces   name, kind (muscle or bone), vertices, faces, low and size (the box of all frames, m);
///              faces_at: 3 × faces, 16 bits each; points_at: 3 × vertices per frame, 0 ... 65535 within the box
///              (bones: one frame); stretch_at: per frame and vertex 128 + 126 log2(mean ratio of its edges' lengths to
///              those at rest), 0 and 255 are beyond half and double; belly and tendon (colors), tendon_at: per vertex
///              255 × how much of it is tendon, stripes_at: per vertex where it lies across the fibers, 16 bits each
///              within stripes (lowest place and range, in widths of the stripes) (muscles); motion_at: per frame a
///              quaternion x y z w and a translation, floats (bones)
///   fibers     muscle, sizes (points of each line), low, size; points_at as above; strain_at: per frame and line as
///              stretch, of the line's length
///   brightness_at   512 bytes: the stripes from one end of their width to the other
struct ReportShapes {
  nlohmann::ordered_json description;
  std::string bytes;
};

/// Surfaces are thinned and frames left out until all fits `budget` bytes. Throws InputError.
ReportShapes report_shapes(const RecordedRun& run, std::size_t budget);

}  // namespace gracilis
