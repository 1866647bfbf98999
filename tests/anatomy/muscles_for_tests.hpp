#pragma once

#include <gracilis/scene/scene.hpp>

#include <shapes.hpp>

#include <cmath>
#include <functional>

/// Muscles of simple shapes: a tube of radius 15 mm and length 0.2 m along z, origin at its bottom cap, insertion at
/// its top cap, mapped point by point.
namespace gracilis {

inline Muscle tube_muscle(const std::function<Vec3(const Vec3&)>& map = [](const Vec3& p) { return p; }) {
  constexpr Real radius = 0.015, length = 0.2;
  constexpr int around = 40, along = 80, rings = 5;
  TriangleMesh tube = shapes::cylinder(radius, length, around, along);
  // The caps' fans become rings, so that attachments have an inside.
  const Index sides = 2 * around * along;
  std::vector<Vec3> vertices;
  std::vector<Eigen::Vector3i> faces;
  for (Index v = 0; v < tube.vertex_count() - 2; ++v) vertices.emplace_back(tube.vertices.col(v));
  for (Index f = 0; f < sides; ++f) faces.emplace_back(tube.faces.col(f));
  Muscle muscle;
  muscle.name = "tube";
  for (const bool top : {false, true}) {
    Attachment attachment{
        top ? "top" : "bottom", top ? AttachmentEnd::insertion : AttachmentEnd::origin, top, {}, false};
    const int rim = top ? around * along : 0;
    for (int i = 0; i < around; ++i) attachment.vertices.push_back(rim + i);
    int outer = rim;
    for (int ring = rings - 1; ring > 0; --ring) {
      const int inner = static_cast<int>(vertices.size());
      for (int i = 0; i < around; ++i) {
        const Vec3 p = tube.vertices.col(rim + i);
        attachment.vertices.push_back(inner + i);
        vertices.emplace_back(p.x() * ring / rings, p.y() * ring / rings, p.z());
      }
      for (int i = 0; i < around; ++i) {
        const int j = (i + 1) % around;
        const Eigen::Vector3i a(outer + i, outer + j, inner + j), b(outer + i, inner + j, inner + i);
        faces.push_back(top ? a : Eigen::Vector3i(a.reverse()));
        faces.push_back(top ? b : Eigen::Vector3i(b.reverse()));
      }
      outer = inner;
    }
    const int middle = static_cast<int>(vertices.size());
    attachment.vertices.push_back(middle);
    vertices.emplace_back(0, 0, top ? length : 0);
    for (int i = 0; i < around; ++i) {
      const Eigen::Vector3i a(outer + i, outer + (i + 1) % around, middle);
      faces.push_back(top ? a : Eigen::Vector3i(a.reverse()));
    }
    muscle.attachments.push_back(attachment);
  }
  muscle.surface = shapes::mesh_of(vertices, faces);
  for (Index v = 0; v < muscle.surface.vertex_count(); ++v)
    muscle.surface.vertices.col(v) = map(muscle.surface.vertices.col(v));
  return muscle;
}

/// Half as wide at the insertion.
inline Muscle cone_muscle() {
  return tube_muscle([](const Vec3& p) { return Vec3(p.x() * (1 - 2.5 * p.z()), p.y() * (1 - 2.5 * p.z()), p.z()); });
}

/// Bent by 90 degrees about the y axis; its axis becomes an arc of this radius.
inline constexpr Real bend_radius = 0.2 / (pi / 2);
inline Muscle bent_muscle() {
  return tube_muscle([](const Vec3& p) {
    const Real angle = p.z() / bend_radius;
    return Vec3((bend_radius + p.x()) * std::cos(angle), p.y(), (bend_radius + p.x()) * std::sin(angle));
  });
}

}  // namespace gracilis
