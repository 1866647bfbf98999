#include <gracilis/dynamics/contact/mesh/contact_surface.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/point_triangle.hpp>
#include <gracilis/geometry/topology.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis {

namespace {

constexpr Index particles_per_task = 1024;
/// Closer than this the direction from the nearest point is rounding (m).
constexpr float same_place = 1e-7f;
/// Steps of a walk; each comes nearer, so it ends anyway.
constexpr int longest_walk = 100;
/// Cosine to the outward direction below which a perpendicular does not tell the sides apart.
constexpr float least_facing = 0.3f;

using Corners = std::array<Eigen::Vector3f, 3>;

Corners corners_of(const ContactSurface& surface, Index face, const Particles& particles) {
  return {particles.position(surface.faces(0, face)), particles.position(surface.faces(1, face)),
          particles.position(surface.faces(2, face))};
}

/// The edges at a particle, each by the first of its faces.
void add_edges_around(Index particle, ContactSurface& surface) {
  for (const Index face : surface.vertex_faces.around(particle)) {
    for (const Index side : surface.sides.col(face)) {
      const auto& [ends, faces] = surface.edges[static_cast<std::size_t>(side)];
      const Index first = faces[0] >= 0 ? faces[0] : faces[1];
      if (face == first && (ends[0] == particle || ends[1] == particle)) surface.particle_edges.push_back(side);
    }
  }
}

}  // namespace

ContactSurface build_contact_surface(const Eigen::Matrix3Xi& faces, Index particle_count) {
  ContactSurface surface;
  surface.faces = faces;
  surface.across.setConstant(3, faces.cols(), -1);
  surface.sides.setConstant(3, faces.cols(), -1);
  for (const MeshEdge& edge : build_topology(faces, particle_count).edges) {
    const auto number = static_cast<Index>(surface.edges.size());
    surface.edges.push_back({{edge.a, edge.b}, {edge.left, edge.right}});
    const auto enter = [&](Index face, Index other) {
      if (face < 0) return;
      for (int corner = 0; corner < 3; ++corner) {
        if (faces(corner, face) == edge.a || faces(corner, face) == edge.b) continue;
        surface.across(corner, face) = other;
        surface.sides(corner, face) = number;
      }
    };
    enter(edge.left, edge.right);
    enter(edge.right, edge.left);
  }
  surface.vertex_faces = build_vertex_faces(faces, particle_count);
  surface.particle_edge_offsets.push_back(0);
  for (Index p = 0; p < particle_count; ++p) {
    add_edges_around(p, surface);
    surface.particle_edge_offsets.push_back(static_cast<Index>(surface.particle_edges.size()));
  }
  return surface;
}

Eigen::Matrix3Xf sums_around_particles(const ContactSurface& surface, const Eigen::Matrix3Xf& of_faces) {
  const auto count = static_cast<Index>(surface.vertex_faces.offsets.size()) - 1;
  Eigen::Matrix3Xf sums(3, count);
  parallel_for(count, particles_per_task, [&](Index begin, Index end) {
    for (Index p = begin; p < end; ++p)
      sums.col(p) = sum_around(surface, p, [&](Index face) { return of_faces.col(face); });
  });
  return sums;
}

NearestFace nearest_on_face(const Eigen::Vector3f& p, const ContactSurface& surface, Index face,
                            const Particles& particles) {
  const Corners x = corners_of(surface, face, particles);
  return {face, nearest_barycentric(p, x[0], x[1], x[2])};
}

PointGap point_gap(const Eigen::Vector3f& p, const ContactSurface& surface, Index face, const Particles& particles,
                   const Eigen::Matrix3Xf& normals) {
  return point_gap(p, surface, nearest_on_face(p, surface, face, particles), particles, normals);
}

PointGap point_gap(const Eigen::Vector3f& p, const ContactSurface& surface, const NearestFace& at,
                   const Particles& particles, const Eigen::Matrix3Xf& normals) {
  const Corners x = corners_of(surface, at.face, particles);
  PointGap gap;
  gap.barycentric = at.barycentric;
  const Eigen::Vector3f nearest = gap.barycentric[0] * x[0] + gap.barycentric[1] * x[1] + gap.barycentric[2] * x[2];
  if (gap.barycentric.minCoeff() > 0) {
    gap.normal = (x[1] - x[0]).cross(x[2] - x[0]).stableNormalized();
    gap.distance = gap.normal.dot(p - nearest);
    return gap;
  }
  Eigen::Vector3f outward = Eigen::Vector3f::Zero();
  for (int corner = 0; corner < 3; ++corner)
    outward += gap.barycentric[corner] * normals.col(surface.faces(corner, at.face));
  const Eigen::Vector3f away = p - nearest;
  const float distance = away.norm();
  if (distance < same_place) {
    gap.normal = outward.stableNormalized();
    gap.distance = gap.normal.dot(away);
  } else {
    gap.distance = away.dot(outward) < 0 ? -distance : distance;
    gap.normal = away / gap.distance;
  }
  return gap;
}

EdgeGap edge_gap(const Eigen::Vector3f& a0, const Eigen::Vector3f& a1, const Eigen::Vector3f& b0,
                 const Eigen::Vector3f& b1, const Eigen::Vector3f& outward) {
  EdgeGap gap;
  gap.normal.setZero();
  const Eigen::Vector3f a = a1 - a0, b = b1 - b0, between = a0 - b0, perpendicular = a.cross(b);
  const float aa = a.squaredNorm(), bb = b.squaredNorm(), across2 = perpendicular.squaredNorm();
  if (!(across2 > 1e-4f * aa * bb)) return gap;
  // Where the lines come nearest.
  gap.s = b.cross(between).dot(perpendicular) / across2;
  gap.t = a.cross(between).dot(perpendicular) / across2;
  if (gap.s < 0 || gap.s > 1 || gap.t < 0 || gap.t > 1) return gap;
  const float length = std::sqrt(across2), facing = perpendicular.dot(outward);
  if (!(std::abs(facing) > least_facing * length * outward.norm())) return gap;
  gap.normal = perpendicular / (facing < 0 ? -length : length);
  gap.distance = gap.normal.dot(between);
  gap.crossing = true;
  return gap;
}

template <class MayVisit>
static NearestFace walk(const Eigen::Vector3f& p, const ContactSurface& surface, Index face, const Particles& particles,
                        const MayVisit& may_visit) {
  const auto distance2_to = [&](Index f, Eigen::Vector3f& barycentric) {
    const Corners x = corners_of(surface, f, particles);
    barycentric = nearest_barycentric(p, x[0], x[1], x[2]);
    return (barycentric[0] * x[0] + barycentric[1] * x[1] + barycentric[2] * x[2] - p).squaredNorm();
  };
  Eigen::Vector3f barycentric;
  float best = distance2_to(face, barycentric);
  for (int step = 0; step < longest_walk; ++step) {
    Index next = face;
    Eigen::Vector3f there = barycentric;
    const auto consider = [&](Index candidate) {
      if (candidate < 0 || candidate == face || !may_visit(candidate)) return;
      Eigen::Vector3f weights;
      const float distance2 = distance2_to(candidate, weights);
      if (distance2 < best) best = distance2, next = candidate, there = weights;
    };
    const int zeros = static_cast<int>((barycentric.array() <= 0).count());
    if (zeros == 1) {
      for (int corner = 0; corner < 3; ++corner)
        if (barycentric[corner] <= 0) consider(surface.across(corner, face));
    } else if (zeros == 2) {
      Index corner;
      barycentric.maxCoeff(&corner);
      for (const Index around : surface.vertex_faces.around(surface.faces(corner, face))) consider(around);
    }
    if (next == face) break;
    face = next;
    barycentric = there;
  }
  return {face, barycentric};
}

NearestFace walk_to_nearest(const Eigen::Vector3f& p, const ContactSurface& surface, Index face,
                            const Particles& particles) {
  return walk(p, surface, face, particles, [](Index) { return true; });
}

NearestFace walk_to_nearest(const Eigen::Vector3f& p, const ContactSurface& surface, Index face,
                            const Particles& particles, const std::function<bool(Index)>& may_visit) {
  return walk(p, surface, face, particles, may_visit);
}

}  // namespace gracilis
