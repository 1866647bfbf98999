#pragma once

#include <gracilis/geometry/polylines.hpp>

#include <filesystem>

namespace gracilis {

/// Reads the tracks of TrackVis (.trk, versions 1 and 2). Points are in voxels times the voxels' size; where the header
/// has the matrix from voxels to the scanner's frame, they are taken there, as other programs do, else left as they
/// are. Then they are multiplied by `unit`, the length of the file's unit in m. Lines of less than two points are left
/// out. Throws InputError with file, place and reason.
Polylines read_trk(const std::filesystem::path& path, Real unit);

}  // namespace gracilis
