#pragma once

#include <gracilis/core/types.hpp>
#include <gracilis/geometry/implicit_surface.hpp>
#include <gracilis/geometry/triangle_mesh.hpp>

#include <vector>

namespace gracilis {

/// Values at the nodes of a regular grid; node (i, j, k) lies at origin + step (i, j, k), value (k * ny + j) * nx + i.
struct SampledSolid {
  Vec3 origin = Vec3::Zero();
  Real step = 0;                                    ///< m
  Eigen::Vector3i nodes = Eigen::Vector3i::Zero();  ///< per axis
  std::vector<Real> values;                         ///< m, negative inside

  Index node_count() const { return nodes.prod(); }  ///< of the whole grid
  Vec3 node(Index index) const;                      ///< its place, m
};

/// Lays a grid over the solid's bounds plus a margin of two steps and evaluates the solid near its surface (over all
/// threads, the same bits for any number of them). Nodes further away keep the sign and a smaller magnitude.
/// Precondition: step > 0.
SampledSolid sample(const ImplicitSolid& solid, Real step);

/// Trilinear value at `point`, and its gradient when asked; beyond the grid that of the nearest point on its border.
Real interpolate(const SampledSolid& solid, const Vec3& point, Vec3* gradient = nullptr);

/// The surface where the interpolated value is 0, by marching tetrahedra (six per cell, Kuhn's division; Doi and Koide
/// 1991): closed, manifold, oriented outwards, but with uneven triangles; remesh() evens them. Where the values have
/// the same sign on the whole grid the mesh is empty. Precondition: values on the grid's border are positive.
TriangleMesh extract_surface(const SampledSolid& solid);

/// The connected part of `mesh` with the most faces, its vertices renumbered in their old order.
TriangleMesh largest_component(const TriangleMesh& mesh);

/// Moves every vertex along the gradient onto the surface of `solid`; at most one grid step.
void project_to_surface(TriangleMesh& mesh, const SampledSolid& solid);

/// The solid's surface as a mesh with edges about `edge_length` long: sample, extract, largest component, remesh.
/// `step` is the grid's; details finer than two steps are lost.
TriangleMesh mesh_solid(const ImplicitSolid& solid, Real step, Real edge_length);

}  // namespace gracilis
