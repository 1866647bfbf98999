#pragma once

#include <gracilis/core/types.hpp>
#include <gracilis/geometry/nearest_triangle.hpp>
#include <gracilis/geometry/triangle_mesh.hpp>

#include <span>
#include <variant>
#include <vector>

/// Which vertices of a muscle move with a bone. All distances in m, all points in the world frame of the capture pose.
namespace gracilis {

/// How the points of landmarks hang together, in their order.
enum class LineKind {
  cloud,   ///< not at all
  open,    ///< as a line from the first to the last
  closed,  ///< as an outline; what lies inside it belongs to it too
  outline  ///< as an outline in any order, whose inside is told on the bone's surface (outline_on_bones)
};

/// Landmarks on a bone. A closed line's inside is judged along its best-fitting plane's normal.
struct LandmarkSet {
  Points points;
  LineKind kind = LineKind::cloud;
  std::vector<std::vector<char>> inside = {};  ///< of an `outline`: per bone and face
};

/// Points around an area of a bone, in any order, as an outline: in the order of the shortest tour through them
/// (geometry/outline_curves.hpp), with the faces inside it on the bone to which most points are nearest.
/// Precondition: there is a bone.
LandmarkSet outline_on_bones(const Points& points, std::span<const TriangleMesh* const> bones);

/// Vertices within `bone_distance` of the bone and within `landmark_distance` of one of the landmark sets, or, for a
/// closed line or an outline, with their nearest point on the bone inside it.
struct NearLandmarks {
  std::vector<LandmarkSet> landmarks;
  Real bone_distance = 0;
  Real landmark_distance = 0;
};

/// Vertices within `distance` of one of the landmark sets, for muscles whose bone is not in the scene.
struct NearPoints {
  std::vector<LandmarkSet> landmarks;
  Real distance = 0;
};

/// Exactly these vertices.
struct ListedVertices {
  std::vector<Index> vertices;
};

/// Vertices within `distance` of the bone.
struct NearBone {
  Real distance = 0;
};

using AttachmentRule = std::variant<NearLandmarks, NearPoints, ListedVertices, NearBone>;

/// The vertices of `muscle` that the rule takes, ascending, each once. `bones` are the surfaces that count as the bone
/// (the rules that ask for a distance to it need at least one). Listed vertices are taken as they are, whether they
/// exist or not.
std::vector<Index> select_vertices(const TriangleMesh& muscle, std::span<const NearestTriangle* const> bones,
                                   const AttachmentRule& rule);

/// The distance from p to the nearest of the set's points, or of the segments between them.
Real distance_to(const LandmarkSet& landmarks, const Vec3& p);

/// Whether p lies inside the outline, both seen along the normal of the plane that fits the outline best, and no
/// further from that plane than the outline itself reaches plus `reach`.
bool inside_outline(const Points& outline, const Vec3& p, Real reach);

/// The surface that belongs to some vertices (a third of each triangle to each corner), and how it spreads.
struct AttachmentArea {
  Real area = 0;    ///< m²
  Real length = 0;  ///< m, largest extent along the principal direction of its vertices
  Real width = 0;   ///< m, area over length

  /// Long and thin, or no triangle wide.
  bool sliver() const { return width < length / 10; }
};
/// Of these vertices of a muscle (m); all zero where there are none.
AttachmentArea attachment_area(const TriangleMesh& muscle, std::span<const Index> vertices);

/// Fewer vertices than this hold a muscle by a few points only.
inline constexpr Index handful = 10;

}  // namespace gracilis
