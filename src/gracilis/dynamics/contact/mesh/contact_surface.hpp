#pragma once

#include <gracilis/core/types.hpp>
#include <gracilis/dynamics/particles.hpp>
#include <gracilis/dynamics/vertex_faces.hpp>

#include <algorithm>
#include <array>
#include <functional>
#include <span>
#include <vector>

namespace gracilis {

/// A surface as others meet it: constant. Faces and edges are numbered like in the input.
struct ContactSurface {
  struct Edge {
    std::array<Index, 2> ends;   ///< particles
    std::array<Index, 2> faces;  ///< -1 where there is none
  };

  Eigen::Matrix3Xi faces;   ///< particles, counter-clockwise seen from outside
  Eigen::Matrix3Xi across;  ///< face behind the side opposite to each corner; -1: none
  Eigen::Matrix3Xi sides;   ///< edge opposite to each corner
  std::vector<Edge> edges;
  VertexFaces vertex_faces;
  std::vector<Index> particle_edge_offsets, particle_edges;  ///< edges at each particle

  /// The edges that end at a particle.
  std::span<const Index> edges_at(Index particle) const {
    const auto at = static_cast<std::size_t>(particle);
    return {particle_edges.begin() + particle_edge_offsets[at], particle_edges.begin() + particle_edge_offsets[at + 1]};
  }
};

/// Tables of a triangle list over `particle_count` particles.
ContactSurface build_contact_surface(const Eigen::Matrix3Xi& faces, Index particle_count);

/// The area vector of a face: along its normal, twice its area long.
inline Eigen::Vector3f face_area(const ContactSurface& surface, Index face, const Particles& particles) {
  const Eigen::Vector3f a = particles.position(surface.faces(0, face));
  return (particles.position(surface.faces(1, face)) - a)
      .cross(Eigen::Vector3f(particles.position(surface.faces(2, face)) - a));
}
/// The sum over a particle's faces of of_face(face).
template <class OfFace>
Eigen::Vector3f sum_around(const ContactSurface& surface, Index particle, const OfFace& of_face) {
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  for (const Index face : surface.vertex_faces.around(particle)) sum += of_face(face);
  return sum;
}
/// Calls act(neighbor) for each particle at the other end of an edge.
template <class Act>
void for_each_neighbor(const ContactSurface& surface, Index particle, const Act& act) {
  for (const Index edge : surface.edges_at(particle)) {
    const auto& ends = surface.edges[static_cast<std::size_t>(edge)].ends;
    act(ends[0] == particle ? ends[1] : ends[0]);
  }
}
/// Whether a corner of the face can move.
inline bool can_move(const ContactSurface& surface, Index face, const Particles& particles) {
  const auto corners = surface.faces.col(face);
  return std::any_of(corners.begin(), corners.end(), [&](Index corner) { return particles.inverse_mass(corner) > 0; });
}
/// At each particle the sum over its faces of what they have, one column each.
Eigen::Matrix3Xf sums_around_particles(const ContactSurface& surface, const Eigen::Matrix3Xf& of_faces);

/// A face and the nearest point of it.
struct NearestFace {
  Index face = 0;
  Eigen::Vector3f barycentric;
};

/// Where on the face it is nearest to p.
NearestFace nearest_on_face(const Eigen::Vector3f& p, const ContactSurface& surface, Index face,
                            const Particles& particles);

/// That point, m.
inline Eigen::Vector3f point_on(const ContactSurface& surface, const NearestFace& at, const Particles& particles) {
  return at.barycentric[0] * particles.position(surface.faces(0, at.face)) +
         at.barycentric[1] * particles.position(surface.faces(1, at.face)) +
         at.barycentric[2] * particles.position(surface.faces(2, at.face));
}

/// Where a point stands against a triangle: the nearest point of the triangle, and the signed distance to it along
/// `normal`, positive outside.
struct PointGap {
  Eigen::Vector3f barycentric;
  Eigen::Vector3f normal;
  float distance = 0;
};

/// The gap between p and the face. Over the inside of the face the normal is the face's own; over its sides and corners
/// it points from the nearest point to p, outward by `normals` at the corners. Zero normal where nothing tells a
/// direction.
PointGap point_gap(const Eigen::Vector3f& p, const ContactSurface& surface, Index face, const Particles& particles,
                   const Eigen::Matrix3Xf& normals);
/// The same where the face's nearest point is known.
PointGap point_gap(const Eigen::Vector3f& p, const ContactSurface& surface, const NearestFace& nearest,
                   const Particles& particles, const Eigen::Matrix3Xf& normals);

/// Where two edges stand against each other.
struct EdgeGap {
  float s = 0, t = 0;      ///< parameters of the nearest points on the first and second edge
  Eigen::Vector3f normal;  ///< from the second to the first
  float distance = 0;      ///< along `normal`; negative when they have passed through each other
  bool crossing = false;   ///< the nearest points lie inside of both edges, and the normal is well defined
};

/// The gap between edges (a0, a1) and (b0, b1) along their common perpendicular, which is turned to `outward`, from the
/// second's surface to the first's. Not `crossing` when they are parallel, when one passes the other's end, or when the
/// perpendicular lies nearly across `outward`.
EdgeGap edge_gap(const Eigen::Vector3f& a0, const Eigen::Vector3f& a1, const Eigen::Vector3f& b0,
                 const Eigen::Vector3f& b1, const Eigen::Vector3f& outward);

/// From `face` to neighbors as long as they come nearer to p: the nearest face, or one nearest among those around it.
NearestFace walk_to_nearest(const Eigen::Vector3f& p, const ContactSurface& surface, Index face,
                            const Particles& particles);
/// The same over faces alone that `may_visit` allows; `face` is taken as it is.
NearestFace walk_to_nearest(const Eigen::Vector3f& p, const ContactSurface& surface, Index face,
                            const Particles& particles, const std::function<bool(Index)>& may_visit);

}  // namespace gracilis
