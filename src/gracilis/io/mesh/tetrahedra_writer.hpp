#pragma once

#include <gracilis/anatomy/sections/tetrahedra.hpp>

#include <filesystem>

namespace gracilis {

/// Writes tetrahedra as .vtu (appended, LZ4), whole or not at all, with arrays per cell: compartment (0 muscle, 1
/// tendon), density (kg/m³), volume (m³) and mass (kg). Throws InputError with the path and the reason when the file
/// cannot be written.
void write_tetrahedra(const std::filesystem::path& path, const Tetrahedra& tetrahedra);

}  // namespace gracilis
