#pragma once

#include <gracilis/geometry/polylines.hpp>

#include <filesystem>

namespace gracilis {

/// Reads the streamlines of MRtrix (.tck): a header of words, then points as floating-point numbers, lines apart by a
/// point of NaN, the end a point of infinity. Coordinates are multiplied by `unit`, the length of the file's unit in
/// m. Lines of less than two points are left out. Throws InputError with file, place and reason.
Polylines read_tck(const std::filesystem::path& path, Real unit);

}  // namespace gracilis
