#include <gracilis/prepare/prepare_surfaces.hpp>

#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/nearest_triangle.hpp>
#include <gracilis/geometry/topology.hpp>
#include <gracilis/prepare/cgal.hpp>
#include <gracilis/prepare/estimates.hpp>
#include <gracilis/prepare/separation.hpp>
#include <gracilis/prepare/smoothing.hpp>
#include <gracilis/prepare/surface_repair.hpp>

#include <algorithm>
#include <array>
#include <map>

namespace gracilis {
namespace {

using Say = std::function<void(const std::string&)>;

constexpr Real sharpest_turn = radians(80);
constexpr Real farthest_rounding = 0.0012;  ///< m
constexpr Real thinnest_radius = 0.45;      ///< of an edge: about three go around
constexpr int passes = 3;
constexpr Real told_displacement = 0.0001;  ///< m; less is how triangles approximate a curved surface

/// Mean edge near the length asked for, none far from it, no needles: remeshing again would only blur the surface.
bool has_edges_about(const TriangleMesh& mesh, Real length) {
  Real sum = 0, shortest = length, longest = length;
  const MeshTopology topology = build_topology(mesh.faces, mesh.vertex_count());
  for (const MeshEdge& edge : topology.edges) {
    const Real l = (mesh.vertices.col(edge.a) - mesh.vertices.col(edge.b)).norm();
    sum += l, shortest = std::min(shortest, l), longest = std::max(longest, l);
  }
  const Real mean = sum / static_cast<Real>(topology.edges.size());
  return std::abs(mean / length - 1) < 0.15 && shortest > 0.2 * length && longest < 2.2 * length;
}

/// Largest and mean distance from the vertices and face centers of one surface to another.
struct SurfaceDistance {
  Real largest = 0, mean = 0;
};

SurfaceDistance distance_from_to(const TriangleMesh& from, const TriangleMesh& to) {
  const NearestTriangle nearest(to);
  SurfaceDistance result;
  Index count = 0;
  const auto add = [&](const Vec3& p) {
    const Real distance = nearest.query(p).distance;
    result.largest = std::max(result.largest, distance);
    result.mean += distance;
    ++count;
  };
  for (Index v = 0; v < from.vertex_count(); ++v) add(from.vertices.col(v));
  for (Index f = 0; f < from.face_count(); ++f)
    add((from.vertices.col(from.faces(0, f)) + from.vertices.col(from.faces(1, f)) +
         from.vertices.col(from.faces(2, f))) /
        3);
  result.mean /= count;
  return result;
}

/// Pairs of intersecting triangles by pairs of surfaces; muscles come first, pairs of two bones are left out.
using Crossings = std::map<std::pair<Index, Index>, Index>;

Crossings count_crossings(const std::vector<TriangleMesh>& muscles, const std::vector<TriangleMesh>& bones) {
  std::vector<const TriangleMesh*> all;
  for (const TriangleMesh& mesh : muscles) all.push_back(&mesh);
  for (const TriangleMesh& mesh : bones) all.push_back(&mesh);
  Crossings crossings;
  for (const FacePair& pair : intersecting_faces(all))
    if (pair.mesh_a < static_cast<Index>(muscles.size())) ++crossings[{pair.mesh_a, pair.mesh_b}];
  return crossings;
}

std::vector<TriangleMesh> meshes_of(const std::vector<NamedSurface>& surfaces) {
  std::vector<TriangleMesh> meshes;
  for (const NamedSurface& surface : surfaces) meshes.push_back(surface.mesh);
  return meshes;
}

/// True when any was remeshed.
bool remesh_where_needed(std::vector<TriangleMesh>& muscles, const PrepareSettings& settings) {
  bool any = false;
  for (TriangleMesh& mesh : muscles) {
    if (settings.edge_length == 0 || has_edges_about(mesh, settings.edge_length)) continue;
    mesh = remesh_isotropic(mesh, settings.edge_length, settings.remeshing_rounds);
    any = true;
  }
  return any;
}

/// The surface in triangles of the size asked for. What they could not follow, threads and blades, is rounded while the
/// triangles are still half as large.
TriangleMesh reshaped(const TriangleMesh& mesh, const PrepareSettings& settings) {
  TriangleMesh fine = remesh_isotropic(mesh, settings.edge_length / 2, 3);
  if (settings.rounding_rounds > 0) {
    thicken(fine, thinnest_radius * settings.edge_length);
    round_off(fine, sharpest_turn, settings.rounding_rounds, farthest_rounding);
  }
  return remesh_isotropic(fine, settings.edge_length, settings.remeshing_rounds);
}

/// Self-intersections that rounding and pulling apart may have made.
bool untangle(std::vector<TriangleMesh>& muscles, const std::vector<NamedSurface>& names) {
  bool any = false;
  for (std::size_t m = 0; m < muscles.size(); ++m) {
    const std::array<const TriangleMesh*, 1> one = {&muscles[m]};
    if (intersecting_faces(one).empty()) continue;
    muscles[m] = fix_surface(muscles[m], names[m].name).mesh;
    any = true;
  }
  return any;
}

/// How far separation took the surfaces: the distance of every vertex to the surface as it was before.
void report_displacements(const std::vector<TriangleMesh>& before, const std::vector<TriangleMesh>& after,
                          PreparationReport& report) {
  for (std::size_t m = 0; m < before.size(); ++m) {
    PreparedMuscleReport& muscle = report.muscles[m];
    const NearestTriangle nearest(before[m]);
    for (Index v = 0; v < after[m].vertex_count(); ++v) {
      const Real moved = nearest.query(after[m].vertices.col(v)).distance;
      if (moved <= told_displacement) continue;
      ++muscle.vertices_moved;
      muscle.mean_displacement += moved;
      muscle.max_displacement = std::max(muscle.max_displacement, moved);
    }
    if (muscle.vertices_moved > 0) muscle.mean_displacement /= muscle.vertices_moved;
  }
}

std::string name_of(Index surface, const std::vector<NamedSurface>& muscles, const std::vector<NamedSurface>& bones) {
  const auto s = static_cast<std::size_t>(surface);
  return s < muscles.size() ? muscles[s].name : bones[s - muscles.size()].name;
}

}  // namespace

PreparedSurfaces prepare_surfaces(const std::vector<NamedSurface>& muscles, const std::vector<NamedSurface>& bones,
                                  const PrepareSettings& settings, const Say& say) {
  require_affordable(muscles, bones, settings);
  PreparedSurfaces result;
  PreparationReport& report = result.report;
  const std::vector<TriangleMesh> obstacles = meshes_of(bones);
  const Crossings before = count_crossings(meshes_of(muscles), obstacles);
  for (const NamedSurface& muscle : muscles) {
    say("repairing " + muscle.name);
    FixedSurface fixed = fix_surface(muscle.mesh, muscle.name);
    report.muscles.push_back({.name = muscle.name, .repairs = fixed.repairs});
    result.muscles.push_back(std::move(fixed.mesh));
  }
  const std::vector<TriangleMesh> repaired = result.muscles;
  std::vector<NamedSurface> closed;
  for (std::size_t m = 0; m < muscles.size(); ++m) closed.push_back({muscles[m].name, repaired[m]});
  require_apart(closed, bones);
  const SeparationSettings apart{.muscle_gap = settings.muscle_gap, .bone_gap = settings.bone_gap};
  say("remeshing " + std::to_string(muscles.size()) + (muscles.size() == 1 ? " muscle" : " muscles"));
  for (TriangleMesh& mesh : result.muscles) {
    smooth_surface(mesh, settings.smoothing_rounds);
    if (settings.edge_length > 0 && !has_edges_about(mesh, settings.edge_length)) mesh = reshaped(mesh, settings);
    round_off(mesh, sharpest_turn, settings.rounding_rounds, farthest_rounding);
  }
  remesh_where_needed(result.muscles, settings);
  untangle(result.muscles, muscles);
  const std::vector<TriangleMesh> apart_from = result.muscles;
  say("pulling overlaps apart");
  for (int pass = 1;; ++pass) {
    report.largest_shortfall = separate(result.muscles, obstacles, apart).shortfall;
    if (pass == passes) break;
    // Triangles may have suffered; mending them may bring surfaces close again.
    const bool remeshed = remesh_where_needed(result.muscles, settings);
    if (!untangle(result.muscles, muscles) && !remeshed) break;
  }
  report_displacements(apart_from, result.muscles, report);

  say("measuring");
  const Crossings after = count_crossings(result.muscles, obstacles);
  for (std::size_t m = 0; m < muscles.size(); ++m) {
    PreparedMuscleReport& muscle = report.muscles[m];
    const TriangleMesh& mesh = result.muscles[m];
    muscle.faces_before = muscles[m].mesh.face_count();
    muscle.faces_after = mesh.face_count();
    muscle.volume_before = enclosed_volume(repaired[m].vertices, repaired[m].faces);
    muscle.volume_after = enclosed_volume(mesh.vertices, mesh.faces);
    const SurfaceDistance there = distance_from_to(mesh, repaired[m]), back = distance_from_to(repaired[m], mesh);
    muscle.hausdorff = std::max(there.largest, back.largest);
    muscle.mean_distance = there.mean;
    muscle.sharp_edges_before = sharp_edge_count(repaired[m], sharpest_turn);
    muscle.sharp_edges_after = sharp_edge_count(mesh, sharpest_turn);
  }
  Crossings all = before;
  all.insert(after.begin(), after.end());
  for (const auto& [pair, ignored] : all) {
    const auto count = [&](const Crossings& crossings) {
      const auto found = crossings.find(pair);
      return found == crossings.end() ? 0 : found->second;
    };
    if (pair.first == pair.second) {
      report.muscles[static_cast<std::size_t>(pair.first)].self_intersections_before = count(before);
      report.muscles[static_cast<std::size_t>(pair.first)].self_intersections_after = count(after);
    } else {
      report.pairs.push_back(
          {name_of(pair.first, muscles, bones), name_of(pair.second, muscles, bones), count(before), count(after)});
    }
  }
  return result;
}

}  // namespace gracilis
