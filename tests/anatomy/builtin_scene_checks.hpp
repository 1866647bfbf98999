#pragma once

#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/mesh_inspection.hpp>
#include <gracilis/geometry/signed_distance.hpp>
#include <gracilis/geometry/topology.hpp>
#include <gracilis/scene/scene.hpp>

#include <gtest/gtest.h>

#include "contact_check/intersections.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

/// What every built-in scene has to hold.
namespace gracilis {

/// The least signed distance from the vertices and edge midpoints of `mesh` to `other`.
inline Real least_distance(const TriangleMesh& mesh, const SignedDistance& other) {
  Real least = 1;
  for (Index v = 0; v < mesh.vertex_count(); ++v) least = std::min(least, other.query(mesh.vertices.col(v)).distance);
  for (const MeshEdge& e : build_topology(mesh.faces, mesh.vertex_count()).edges)
    least = std::min(least, other.query((mesh.vertices.col(e.a) + mesh.vertices.col(e.b)) / 2).distance);
  return least;
}

inline const Bone& bone_of(const Scene& scene, const std::string& name) {
  return *std::find_if(scene.bones.begin(), scene.bones.end(), [&](const Bone& b) { return b.name == name; });
}

/// Closed, manifold, oriented outwards, of this genus, cutting itself nowhere, and no crumb: of at least this volume,
/// m³.
inline void expect_sound(const std::string& name, const TriangleMesh& mesh, int genus, Real least_volume = 5e-5) {
  const MeshReport report = inspect_mesh(mesh);
  ASSERT_GT(report.face_count, 1000) << name;
  EXPECT_TRUE(report.is_closed() && report.is_manifold() && report.is_oriented()) << name;
  EXPECT_EQ(report.components, 1) << name;
  EXPECT_EQ(report.genus, genus) << name;
  EXPECT_GT(report.volume, least_volume) << name;
  EXPECT_TRUE(contact_check::self_intersecting_faces(mesh).empty()) << name;
}

inline void expect_even_triangles(const Muscle& m) {
  const auto edges = build_topology(m.surface.faces, m.surface.vertex_count()).edges;
  Real shortest = 1, longest = 0, mean = 0;
  for (const MeshEdge& e : edges) {
    const Real length = (m.surface.vertices.col(e.a) - m.surface.vertices.col(e.b)).norm();
    shortest = std::min(shortest, length);
    longest = std::max(longest, length);
    mean += length / static_cast<Real>(edges.size());
  }
  EXPECT_GT(shortest, 0.4 * mean) << m.name;
  EXPECT_LT(longest, 1.7 * mean) << m.name;
}

inline void expect_clear_of_bones(const Scene& scene) {
  for (const Bone& b : scene.bones) {
    const SignedDistance distance(b.surface);
    for (const Muscle& m : scene.muscles) {
      EXPECT_GT(least_distance(m.surface, distance), 0.0008) << m.name << " and " << b.name;
      const SignedDistance to_muscle(m.surface);
      for (Index v = 0; v < b.surface.vertex_count(); ++v)
        ASSERT_GT(to_muscle.query(b.surface.vertices.col(v), 0.02).distance, 0.0005) << m.name << " and " << b.name;
    }
  }
}

inline void expect_clear_of_each_other(const Scene& scene) {
  for (const Muscle& a : scene.muscles) {
    const SignedDistance distance(a.surface);
    for (const Muscle& b : scene.muscles)
      if (&a != &b) {
        EXPECT_GT(least_distance(b.surface, distance), 0.001) << b.name << " and " << a.name;
      }
  }
}

/// A point known from palpation or from another model, and the bone that it lies on.
struct Landmark {
  const char* name;
  const char* bone;
  Vec3 point;
};

inline void expect_on_bone(const Landmark& landmark, const Bone& bone) {
  EXPECT_LT(std::abs(SignedDistance(bone.surface).query(landmark.point).distance), 0.008) << landmark.name;
}

inline void expect_same_surfaces(const Scene& one, const Scene& other) {
  ASSERT_EQ(one.muscles.size(), other.muscles.size());
  for (std::size_t i = 0; i < one.muscles.size(); ++i) {
    EXPECT_EQ(one.muscles[i].surface.vertices, other.muscles[i].surface.vertices);
    EXPECT_EQ(one.muscles[i].attachments[0].vertices, other.muscles[i].attachments[0].vertices);
  }
}

}  // namespace gracilis
