#pragma once

#include <gracilis/geometry/triangle_mesh.hpp>
#include <gracilis/scene/settings.hpp>

#include <functional>
#include <optional>
#include <string>
#include <vector>

/// What passes between a scene and whoever prepares its surfaces for it. The work itself is an optional component, so
/// it is handed in as a function.
namespace gracilis {

struct NamedSurface {
  std::string name;
  TriangleMesh mesh;
  bool largest_piece = false;  ///< of a muscle: only that of its closed pieces which encloses most is wanted
  /// Of a muscle: those that it is pulled apart from; not given: all others and bones; none: it stays where it is.
  std::optional<std::vector<std::string>> apart_from = {};

  bool stays() const { return apart_from && apart_from->empty(); }  ///< gives way to nothing
};

/// Has only those muscles give way that `apart` names: "a" to all others and bones, "a:b" each to the other alone, and
/// both where they are named so often; the others stay. Without names all give way. Returns the names that no muscle
/// has.
std::vector<std::string> pull_only(std::vector<NamedSurface>& muscles, const std::vector<std::string>& apart);

/// What happened to one muscle.
struct PreparedMuscleReport {
  std::string name;
  std::vector<std::string> repairs = {};  ///< one clause each
  Index faces_before = 0, faces_after = 0;
  Index pieces = 1;                          ///< closed ones in the end
  Index vertices_moved = 0;                  ///< by separation, more than 0.1 mm
  Real mean_displacement = 0;                ///< m, of the moved vertices, by separation
  Real max_displacement = 0;                 ///< m, by separation
  Real volume_before = 0, volume_after = 0;  ///< m³
  Real hausdorff = 0;      ///< m, largest distance between the input's surface and the result, both ways
  Real mean_distance = 0;  ///< m, from the result to the input's surface
  Index sharp_edges_before = 0, sharp_edges_after = 0;                ///< at which it turns by more than 80 degrees
  Index self_intersections_before = 0, self_intersections_after = 0;  ///< pairs of triangles
};

/// Two surfaces that met at rest, or still do.
struct PreparedPairReport {
  std::string a, b;
  Index intersections_before = 0, intersections_after = 0;  ///< pairs of triangles
};

struct PreparationReport {
  std::vector<PreparedMuscleReport> muscles;
  std::vector<PreparedPairReport> pairs;  ///< those with intersections before or after
  Real largest_shortfall = 0;             ///< m by which the worst gap is missed in the end
  bool pulled_apart = true;  ///< false: gaps are missed by more than 1 mm, or muscles stay as they were, unasked
};

struct PreparedSurfaces {
  std::vector<TriangleMesh> muscles;  ///< in the order given
  PreparationReport report;
};

/// Changes whenever the same input gives another result, so that what older versions made is not taken for it.
inline constexpr int preparation_version = 4;

/// Prepares muscles that lie among bones, which stay as they are; says on `say` what it does.
using PrepareFunction = std::function<PreparedSurfaces(
    const std::vector<NamedSurface>& muscles, const std::vector<NamedSurface>& bones, const PrepareSettings& settings,
    const std::function<void(const std::string&)>& say)>;

}  // namespace gracilis
