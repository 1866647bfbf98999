#pragma once

#include <gracilis/core/types.hpp>
#include <gracilis/scene/scene.hpp>

#include <Eigen/Geometry>

#include <filesystem>
#include <map>
#include <string>

namespace gracilis {

/// Points by name, m.
using LandmarkPoints = std::map<std::string, Vec3>;

/// A table (.csv) with columns cloud, x, y, z and perhaps index, as scenes have it: a cloud of one point is called as
/// the cloud, points of others as their `index` says; or .toml, `name = [x, y, z]`, with `unit` beside. Without a unit
/// in the file `unit` is its length in m. Throws InputError and ConfigurationError.
LandmarkPoints read_landmark_points(const std::filesystem::path& path, Real unit);

/// Centers of a scene's joints, by the joints' names.
LandmarkPoints joint_centers(const Scene& scene);

/// Throws ConfigurationError about `option` where a point lies further from the middle of the bones than ten times the
/// diagonal of their box, as points in another unit do.
void require_near(const LandmarkPoints& points, const Eigen::AlignedBox3d& bones, const std::string& option);

/// Volumes of muscles, m³: a .csv with columns muscle and volume_cm3, volume_ml, volume_mm3, mass_g or mass_kg. Throws
/// InputError with file and line: columns that are missing, cells that are no numbers above 0, a muscle twice.
std::map<std::string, Real> read_volumes(const std::filesystem::path& path);

/// kg/m³, of muscle (Mendez and Keys 1960).
inline constexpr Real muscle_density = 1060;

}  // namespace gracilis
