#pragma once

#include <gracilis/geometry/triangle_mesh.hpp>
#include <gracilis/io/mesh/load_surface.hpp>
#include <gracilis/io/scene/scene_in_progress.hpp>
#include <gracilis/io/toml_reader.hpp>

#include <map>

namespace gracilis::sections {

/// The surface of an element: its key `file`, its table `box` or, of scenes that a program makes, its key `given`.
SurfaceDescription read_surface(TomlReader& table);

/// A surface's file under the key, with its keys `unit` and `mirror`.
NamedFile surface_file(TomlReader& table, const std::string& path);

/// What is right of the body's middle plane, which runs through the frame's origin, comes to lie left of it, where the
/// file asks for that.
void mirror_if_asked(const SceneInProgress& progress, const NamedFile& file, TriangleMesh& mesh);

/// Whether any of the points lies in the surface's bounding box, as what belongs to it does. Precondition: the surface
/// has a vertex.
bool any_point_within(const TriangleMesh& surface, const Points& points);

/// Loads the surfaces of all bones and muscles side by side, and then hands them out one by one.
class SurfaceLoader {
 public:
  /// `muscles_stay_raw`: muscles from files are taken as they are there, to be prepared.
  SurfaceLoader(SceneInProgress& progress, bool muscles_stay_raw);

  /// Sets `mesh` to a surface of the scene's description, fit for its role; what had to be repaired becomes a warning,
  /// what is wrong with it a problem. Tells whether anything had to be repaired.
  bool take(const SurfaceDescription& surface, SurfaceRole role, TriangleMesh& mesh);

 private:
  bool take_given(const SurfaceDescription& surface, SurfaceRole role, TriangleMesh& mesh);
  bool stays_raw(const SurfaceDescription& surface, SurfaceRole role) const;

  SceneInProgress& progress_;
  bool muscles_stay_raw_;
  std::map<const SurfaceDescription*, LoadOutcome> loaded_;
};

}  // namespace gracilis::sections
