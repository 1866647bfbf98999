#include "solids.hpp"

#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/nearest_triangle.hpp>
#include <gracilis/geometry/radial_solid.hpp>
#include <gracilis/geometry/surface_extraction.hpp>
#include <gracilis/io/scene/demo_scene.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis {

namespace {

/// Of every vertex of one surface, from the other.
Eigen::VectorXd distances(const TriangleMesh& from, const TriangleMesh& to) {
  const NearestTriangle nearest(to);
  Eigen::VectorXd found(from.vertex_count());
  for (Index v = 0; v < from.vertex_count(); ++v) found[v] = nearest.query(from.vertices.col(v)).distance;
  return found;
}

}  // namespace

TriangleMesh builtin_gluteus() {
  const Scene scene = demo_scene("hip");
  return std::find_if(scene.muscles.begin(), scene.muscles.end(),
                      [](const Muscle& each) { return each.name == "gluteus_maximus_r"; })
      ->surface;
}

SolidErrors solid_errors(const TriangleMesh& surface, Index centers, Real step) {
  RadialSolidSettings settings;
  settings.centers = centers;
  const RadialSolid solid = fit_solid(surface, settings);
  const TriangleMesh found = largest_component(extract_surface(sample(implicit_solid(solid), step)));
  const Eigen::VectorXd there = distances(found, surface);
  SolidErrors errors;
  errors.centers = centers;
  errors.volume =
      std::abs(enclosed_volume(found.vertices, found.faces) / enclosed_volume(surface.vertices, surface.faces) - 1);
  errors.hausdorff = std::max(there.maxCoeff(), distances(surface, found).maxCoeff());
  errors.mean = there.mean();
  errors.condition = solid.fit.condition;
  return errors;
}

}  // namespace gracilis
