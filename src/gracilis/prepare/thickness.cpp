#include <gracilis/prepare/thickness.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/nearest_triangle.hpp>
#include <gracilis/geometry/smoothing.hpp>
#include <gracilis/geometry/topology.hpp>
#include <gracilis/prepare/solids.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace gracilis {

static Points outward_normals(const TriangleMesh& mesh) {
  Points normals = Points::Zero(3, mesh.vertex_count());
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const Vec3 normal = area_vector(mesh.vertices, mesh.faces.col(f));
    for (int k = 0; k < 3; ++k) normals.col(mesh.faces(k, f)) += normal;
  }
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const Real length = normals.col(v).norm();
    normals.col(v) = length > 0 ? Vec3(normals.col(v) / length) : Vec3::Zero();
  }
  return normals;
}

/// Radius of the largest ball that touches the surface at p from inside, at most `largest`: a ball is shrunk until no
/// part of the surface is in it (Ma, Bae and Choi 2012).
static Real inner_radius(const NearestTriangle& surface, const Vec3& p, const Vec3& normal, Real largest) {
  Real radius = largest;
  for (int i = 0; i < 8; ++i) {
    const Vec3 center = p - radius * normal;
    const NearestPoint nearest = surface.query(center, 0.97 * radius);
    if (nearest.face < 0) break;
    const Vec3 across = p - nearest.point;
    const Real along = across.dot(normal);
    // What is beside the vertex says nothing about what is opposite to it.
    if (along < 0.3 * across.norm()) break;
    radius = std::min(radius, across.squaredNorm() / (2 * along));
  }
  return radius;
}

/// Of every vertex, at most `largest`.
static Eigen::VectorXd inner_radii(const TriangleMesh& mesh, const Points& normals, Real largest) {
  const NearestTriangle surface(mesh);
  Eigen::VectorXd radii(mesh.vertex_count());
  parallel_for(mesh.vertex_count(), 256, [&](Index begin, Index end) {
    for (Index v = begin; v < end; ++v) radii[v] = inner_radius(surface, mesh.vertices.col(v), normals.col(v), largest);
  });
  return radii;
}

static Real median(Eigen::VectorXd values) {
  const auto middle = values.begin() + values.size() / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

Real thicken(TriangleMesh& mesh, Real radius, const TimeLimit& limit) {
  constexpr int rounds = 15;
  const MeshTopology topology = build_topology(mesh.faces, mesh.vertex_count());
  const Points start = mesh.vertices;
  for (int round = 0; round < rounds; ++round) {
    limit.check();
    const Points normals = outward_normals(mesh);
    const Eigen::VectorXd radii = inner_radii(mesh, normals, radius);
    if (round == 0) radius = median(radii);
    Eigen::VectorXd lack = (radius - radii.array().min(radius)).matrix();
    if (!(lack.maxCoeff() >= 0.05 * radius) || !(radius > 0)) break;
    // Smoothed as one row of a field along the surface.
    for (int i = 0; i < 2; ++i) {
      const Eigen::VectorXd before = lack;
      for (Index v = 0; v < mesh.vertex_count(); ++v) {
        const Index begin = topology.stars.offsets[static_cast<std::size_t>(v)],
                    end = topology.stars.offsets[static_cast<std::size_t>(v) + 1];
        for (Index j = begin; j < end; ++j)
          lack[v] += (before[topology.stars.neighbors[static_cast<std::size_t>(j)]] - before[v]) / (2 * (end - begin));
      }
    }
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      const Vec3 moved = mesh.vertices.col(v) + 0.3 * lack[v] * normals.col(v) - start.col(v);
      mesh.vertices.col(v) = start.col(v) + moved * std::min(1.0, radius / std::max(moved.norm(), 1e-12));
    }
    move_to_means(mesh.vertices, topology.stars, (lack.array() / radius).min(1).max(0), 0.3);
  }
  return radius;
}

/// The balls' radii, each the mean of its own and its neighbors'.
static Eigen::VectorXd even_radii(const TriangleMesh& mesh, const VertexStars& stars, Real largest) {
  Eigen::VectorXd radii = inner_radii(mesh, outward_normals(mesh), largest);
  for (int round = 0; round < 3; ++round) {
    const Eigen::VectorXd before = radii;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      const Index begin = stars.offsets[static_cast<std::size_t>(v)],
                  end = stars.offsets[static_cast<std::size_t>(v) + 1];
      for (Index j = begin; j < end; ++j)
        radii[v] += (before[stars.neighbors[static_cast<std::size_t>(j)]] - before[v]) / (2 * (end - begin));
    }
  }
  return radii;
}

void set_volume(TriangleMesh& mesh, Real volume, const TimeLimit& limit) {
  constexpr int rounds = 8;
  constexpr Real farthest = 0.4;
  const Real area = surface_area(mesh.vertices, mesh.faces);
  if (!(area > 0) || !(volume > 0)) return;
  const MeshTopology topology = build_topology(mesh.faces, mesh.vertex_count());
  const Eigen::VectorXd radii = even_radii(mesh, topology.stars, 3 * volume / area);
  Eigen::VectorXd moved = Eigen::VectorXd::Zero(mesh.vertex_count());
  for (int round = 0; round < rounds; ++round) {
    limit.check();
    const Real lack = volume - enclosed_volume(mesh.vertices, mesh.faces);
    if (std::abs(lack) < 1e-4 * volume) return;
    const Real weight = radii.dot(vertex_areas(mesh.vertices, mesh.faces));
    if (!(weight > 0)) return;
    const Points normals = outward_normals(mesh);
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      const Real most = farthest * radii[v];
      const Real step = std::clamp(moved[v] + lack / weight * radii[v], -most, most) - moved[v];
      moved[v] += step;
      mesh.vertices.col(v) += step * normals.col(v);
    }
  }
}

void give_volume_back(TriangleMesh& mesh, Real volume, Real tolerance, const TimeLimit& limit) {
  if (volume_error(mesh, volume) <= tolerance) return;
  TriangleMesh given = mesh;
  set_volume(given, volume, limit);
  if (is_solid(given) && !cuts_itself(given, limit)) mesh = std::move(given);
}

}  // namespace gracilis
