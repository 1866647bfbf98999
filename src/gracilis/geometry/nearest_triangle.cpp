#include <gracilis/geometry/nearest_triangle.hpp>

#include <gracilis/geometry/point_triangle.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace gracilis {

/// The circle in a triangle's plane that holds it. A triangle without a plane has no normal.
struct EnclosingDisk {
  Vec3 center, normal;
  Real radius = 0;
};

namespace {

EnclosingDisk disk_around(const Vec3& a, const Vec3& b, const Vec3& c) {
  EnclosingDisk disk;
  disk.center = (a + b + c) / 3;
  disk.normal = (b - a).cross(c - a).stableNormalized();
  disk.radius = std::sqrt(
      std::max({(a - disk.center).squaredNorm(), (b - disk.center).squaredNorm(), (c - disk.center).squaredNorm()}));
  return disk;
}

/// Whether no point of the disk is within `distance` of p: many triangles lie little farther than the nearest, and this
/// knows them quickly.
bool is_farther(const EnclosingDisk& disk, const Vec3& p, Real distance) {
  constexpr Real rounding = 1e-9;
  const Vec3 away = p - disk.center;
  const Real height = away.dot(disk.normal), along2 = std::max(away.squaredNorm() - height * height, 0.0),
             beyond = std::max(std::sqrt(along2) - disk.radius, 0.0);
  return height * height + beyond * beyond > (1 + rounding) * distance * distance;
}

}  // namespace

struct NearestTriangle::Tree {
  TriangleMesh mesh;
  std::vector<EnclosingDisk> disks;  ///< around the faces
  TriangleTree triangles;
};

namespace {

struct Query {
  const TriangleMesh& mesh;
  const std::vector<EnclosingDisk>& disks;
  Vec3 p;
  NearestPoint best;
};

/// Whether the face is the nearest so far. Ties go to the lower face, so that the answer does not depend on the tree.
bool consider(Index face, Query& query) {
  if (is_farther(query.disks[static_cast<std::size_t>(face)], query.p, query.best.distance)) return false;
  const Eigen::Vector3i corners = query.mesh.faces.col(face);
  const Vec3 a = query.mesh.vertices.col(corners[0]), b = query.mesh.vertices.col(corners[1]),
             c = query.mesh.vertices.col(corners[2]);
  const Vec3 barycentric = nearest_barycentric(query.p, a, b, c);
  const Vec3 point = barycentric[0] * a + barycentric[1] * b + barycentric[2] * c;
  const Real distance = (point - query.p).norm();
  if (distance > query.best.distance || (distance == query.best.distance && face > query.best.face)) return false;
  query.best = {face, barycentric, point, distance};
  return true;
}

/// What the tree has to look at for everything within `reach`: its boxes are rounded to float.
float generous(Real reach) { return static_cast<float>(reach * (1 + 1e-5) + 1e-7); }

float consider_near(Index face, void* of_point) {
  auto& query = *static_cast<Query*>(of_point);
  return consider(face, query) ? generous(query.best.distance) : std::numeric_limits<float>::infinity();
}

void search(const TriangleTree& triangles, Query& query) {
  triangles.near(query.p, generous(query.best.distance), consider_near, &query);
}

}  // namespace

static std::vector<EnclosingDisk> disks_around(const TriangleMesh& mesh) {
  std::vector<EnclosingDisk> disks;
  for (const auto face : mesh.faces.colwise())
    disks.push_back(disk_around(mesh.vertices.col(face[0]), mesh.vertices.col(face[1]), mesh.vertices.col(face[2])));
  return disks;
}

NearestTriangle::NearestTriangle(const TriangleMesh& mesh)
    : tree_(new Tree{mesh, disks_around(mesh), TriangleTree(mesh)}) {}

NearestTriangle::~NearestTriangle() = default;
NearestTriangle::NearestTriangle(NearestTriangle&&) noexcept = default;
NearestTriangle& NearestTriangle::operator=(NearestTriangle&&) noexcept = default;

const TriangleTree& NearestTriangle::triangles() const { return tree_->triangles; }

NearestPoint NearestTriangle::query(const Vec3& p, Real reach) const {
  Query query{tree_->mesh, tree_->disks, p, {}};
  query.best.distance = reach;
  query.best.face = std::numeric_limits<Index>::max();
  search(tree_->triangles, query);
  if (query.best.face == std::numeric_limits<Index>::max()) return {};
  return query.best;
}

NearestPoint NearestTriangle::query_from(Index guess, const Vec3& p) const {
  Query query{tree_->mesh, tree_->disks, p, {}};
  consider(guess, query);
  search(tree_->triangles, query);
  return query.best;
}

}  // namespace gracilis
