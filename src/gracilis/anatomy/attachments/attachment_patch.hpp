#pragma once

#include <gracilis/geometry/nearest_triangle.hpp>
#include <gracilis/geometry/triangle_mesh.hpp>

#include <span>
#include <vector>

/// Attachments that are given as open surfaces on bones.
namespace gracilis {

/// For each face of a patch the bone that its piece (faces that hang together) lies nearest to, on average over the
/// piece's vertices: an index into `bones`. Precondition: there is a bone, and all indices are in range.
std::vector<std::size_t> bones_under(const TriangleMesh& patch, std::span<const NearestTriangle* const> bones);

/// The faces with `keep` set, over the same vertices.
TriangleMesh kept_faces(const TriangleMesh& mesh, const std::vector<char>& keep);

}  // namespace gracilis
