#include <gracilis/methods/tissue/seen_surface.hpp>

#include <gracilis/geometry/field_spline.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/methods/tissue/out_of_bones.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace gracilis::tissue {

namespace {

/// Of volume, then out of bones; each disturbs the other a little.
constexpr int rounds = 3, volume_rounds = 3;
constexpr Real volume_tolerance = 1e-6;
/// Places that are nearer to a bone than this beyond what they keep may have to be pushed: more than volume moves them
/// (m).
constexpr Real candidates_within = 0.001;
/// A vertex whose triangles face different ways moves as if they had this share of their area.
constexpr Real least_facing = 0.3;
/// A vertex goes no further back from another muscle than its neighbor does and this share of the edge between them.
constexpr Real steepest_push = 0.25;

Vec3 spot_on(const FacePlace& place, const Points& x) {
  Vec3 sum = Vec3::Zero();
  for (Index k = 0; k < 3; ++k) sum += place.shares[k] * x.col(place.corners[static_cast<std::size_t>(k)]);
  return sum;
}

Real longest_edge(const Points& x, const Eigen::Vector3i& corners) {
  Real longest = 0;
  for (Index k = 0; k < 3; ++k) longest = std::max(longest, (x.col(corners[k]) - x.col(corners[(k + 1) % 3])).norm());
  return longest;
}

Real volume_asked(const PreparedTissue& muscle, const Points& nodes) {
  return muscle.volume * filled_volume_ratio(muscle.lattice, nodes);
}

/// How the enclosed volume grows with each vertex, m²; and how far a vertex is moved for a volume, 1/m².
struct VolumeSlopes {
  Points slopes, moves;
};

VolumeSlopes volume_slopes(const PreparedTissue& muscle, const Points& x) {
  const Eigen::Matrix3Xi& faces = muscle.faces;
  VolumeSlopes found{Points::Zero(3, x.cols()), Points::Zero(3, x.cols())};
  Eigen::VectorXd areas = Eigen::VectorXd::Zero(x.cols());
  for (Index f = 0; f < static_cast<Index>(faces.cols()); ++f) {
    const Vec3 part = area_vector(x, faces.col(f)) / 6;
    const Real area = part.norm();
    for (Index k = 0; k < 3; ++k) {
      found.slopes.col(faces(k, f)) += part;
      areas[faces(k, f)] += area;
    }
  }
  for (Index v = 0; v < static_cast<Index>(x.cols()); ++v) {
    const Real least = least_facing * areas[v];
    const Real squared = std::max(found.slopes.col(v).squaredNorm(), least * least);
    if (squared > 0) found.moves.col(v) = found.slopes.col(v) / squared;
  }
  return found;
}

/// What each free vertex is asked to bring in, m³: the triangles' parts shared among their free corners.
Eigen::VectorXd shared_among_corners(const PreparedTissue& muscle, const std::vector<Real>& of_faces) {
  Eigen::VectorXd shared = Eigen::VectorXd::Zero(muscle.vertex_count);
  for (std::size_t i = 0; i < of_faces.size(); ++i) {
    const Eigen::Vector3i corners = muscle.faces.col(muscle.large_faces.faces[i].face);
    int free = 0;
    for (const Index v : corners) free += muscle.points[static_cast<std::size_t>(v)].held_by < 0;
    for (const Index v : corners)
      if (muscle.points[static_cast<std::size_t>(v)].held_by < 0) shared[v] += of_faces[i] / free;
  }
  return shared;
}

/// Moves the free part of the surface out evenly, so that the volume comes to what is asked for. `volume`: its slopes
/// where the surface was near by.
void meet_volume(const PreparedTissue& muscle, const VolumeSlopes& volume, Real asked, Points& x) {
  Eigen::VectorXd areas(muscle.vertex_count);
  for (Index v = 0; v < muscle.vertex_count; ++v) {
    const SurfacePoint& point = muscle.points[static_cast<std::size_t>(v)];
    areas[v] = point.held_by < 0 ? point.vertex_area : 0;
  }
  const Real gain = (volume.slopes.cwiseProduct(volume.moves).colwise().sum() * areas).value();
  if (!(gain > 0)) return;
  for (int i = 0; i < volume_rounds; ++i) {
    const Real missing = asked - enclosed_volume(x, muscle.faces);
    if (std::abs(missing) < volume_tolerance * asked) return;
    x += missing / gain * (volume.moves * areas.asDiagonal());
  }
}

/// The surface with what its large triangles lack, and the slopes of its volume nearly there.
struct EnclosingSurface {
  Points vertices;
  VolumeSlopes volume;
  Real asked = 0;  ///< m³
};

EnclosingSurface enclosing(const PreparedTissue& muscle, const Points& nodes, const Points& tissue_surface) {
  EnclosingSurface found{tissue_surface, volume_slopes(muscle, tissue_surface), volume_asked(muscle, nodes)};
  Points& x = found.vertices;
  x += found.volume.moves * shared_among_corners(muscle, lacking_volumes(muscle, nodes, x)).asDiagonal();
  meet_volume(muscle, found.volume, found.asked, x);
  return found;
}

/// The places on large triangles that a bone may have to push.
std::vector<std::size_t> places_near(const PreparedTissue& muscle, const Surroundings& around, std::size_t b,
                                     const Points& x) {
  const BoneGap& bone = muscle.bones[b];
  const RigidTransform& inverse = around.inverses[static_cast<std::size_t>(bone.body)];
  const std::vector<Real>& least = muscle.large_faces.least[b];
  std::vector<std::size_t> found;
  for (const LargeFace& large : muscle.large_faces.faces) {
    // Where the bone was seen from a corner tells of most triangles that they are far.
    const Index v = large.free_corner;
    if (b < around.queries.size()) {
      const CachedBoneQuery& query = around.queries[b];
      const Real size = longest_edge(x, muscle.faces.col(large.face));
      const Real least_at_corner = least_distance(query, v, inverse * x.col(v));
      if (least_at_corner - largest_slope * size > seen_clearance + candidates_within) continue;
    }
    for (Index i = large.kept_begin; i < large.kept_end; ++i) {
      const auto at = static_cast<std::size_t>(i);
      if (distance_in(bone, inverse * spot_on(muscle.large_faces.kept[at], x)) < least[at] + candidates_within)
        found.push_back(at);
    }
  }
  return found;
}

/// Pushes these places out of the bone, one after the other, so that none of it jumps.
void push_out(const PreparedTissue& muscle, const Surroundings& around, std::size_t b,
              const std::vector<std::size_t>& near, Points& x) {
  const BoneGap& bone = muscle.bones[b];
  const auto body = static_cast<std::size_t>(bone.body);
  for (const std::size_t i : near) {
    const FacePlace& kept = muscle.large_faces.kept[i];
    const Real least = muscle.large_faces.least[b][i];
    const PreciseSample found = sample_spline_precise(bone.field.grid, around.inverses[body] * spot_on(kept, x));
    if (!(found.distance < least)) continue;
    const Vec3 push =
        (least - found.distance) / kept.shares.squaredNorm() * (around.bodies[body].linear() * found.gradient);
    for (Index k = 0; k < 3; ++k) {
      const Index v = kept.corners[static_cast<std::size_t>(k)];
      if (muscle.points[static_cast<std::size_t>(v)].held_by < 0) x.col(v) += kept.shares[k] * push;
    }
  }
}

/// From where soft contact lets a vertex come, through other muscles, back to the planes between them. Not to those of
/// its own muscle: in a fold that is crushed they tell vertices beside each other to go different ways.
Vec3 back_to_planes(const Surroundings& around, Index v, const Vec3& tissue) {
  Vec3 push = Vec3::Zero();
  const auto p = static_cast<std::size_t>(v);
  for (Index i = around.planes_begin[p]; i < around.planes_begin[p + 1]; ++i) {
    const ContactPlane& plane = around.planes[static_cast<std::size_t>(i)];
    if (plane.muscle < 0) continue;
    const Real deep = plane.least - plane.spare - plane.normal.dot(tissue + push);
    if (deep > 0) push += deep * plane.normal;
  }
  return push;
}

/// Each of two muscles that soft contact lets into each other goes back to the planes between them. One vertex alone
/// may be told by a plane of another muscle's far side, so none goes much further than a neighbor does. What volume
/// this takes the rest of the surface gives back.
void push_out_of_muscles(const PreparedTissue& muscle, const Surroundings& around, const Points& tissue, Points& x) {
  if (around.planes.empty()) return;
  Points pushes = Points::Zero(3, muscle.vertex_count);
  Eigen::VectorXd allowed = Eigen::VectorXd::Zero(muscle.vertex_count);
  for (Index v = 0; v < muscle.vertex_count; ++v)
    if (muscle.points[static_cast<std::size_t>(v)].held_by < 0)
      pushes.col(v) = back_to_planes(around, v, tissue.col(v));
  const Eigen::VectorXd lengths = pushes.colwise().norm();
  if (lengths.isZero(0)) return;
  for (const Eigen::Vector3i face : muscle.faces.colwise())
    for (Index k = 0; k < 3; ++k) {
      const Index v = face[k];
      if (!(lengths[v] > 0)) continue;
      for (const Index neighbor : {face[(k + 1) % 3], face[(k + 2) % 3]}) {
        const Real as_far = pushes.col(neighbor).dot(pushes.col(v)) / lengths[v];
        allowed[v] = std::max(allowed[v], as_far + steepest_push * (tissue.col(neighbor) - tissue.col(v)).norm());
      }
    }
  const Real volume = enclosed_volume(x, muscle.faces);
  for (Index v = 0; v < muscle.vertex_count; ++v)
    if (lengths[v] > 0) x.col(v) += std::min(1.0, allowed[v] / lengths[v]) * pushes.col(v);
  meet_volume(muscle, volume, x);
}

}  // namespace

void meet_volume(const PreparedTissue& muscle, Real asked, Points& x) {
  meet_volume(muscle, volume_slopes(muscle, x), asked, x);
}

std::vector<Real> lacking_volumes(const PreparedTissue& muscle, const Points& nodes, const Points& corners) {
  const Points moved = nodes - muscle.lattice.nodes;
  std::vector<Real> lacking;
  for (const LargeFace& large : muscle.large_faces.faces) {
    const Eigen::Vector3i vertices = muscle.faces.col(large.face);
    Eigen::Matrix3d corners_moved;
    for (Index k = 0; k < 3; ++k)
      corners_moved.col(k) = corners.col(vertices[k]) - muscle.points[static_cast<std::size_t>(vertices[k])].rest;
    Vec3 mean = Vec3::Zero();
    for (Index i = large.places_begin; i < large.places_end; ++i) {
      const LargeFacePlace& place = muscle.large_faces.places[static_cast<std::size_t>(i)];
      mean += place.share * (mean_at(place.at, moved) - corners_moved * place.shares);
    }
    lacking.push_back(mean.dot(area_vector(corners, vertices)) / 2);
  }
  return lacking;
}

Points enclosing_surface(const PreparedTissue& muscle, const Points& nodes, const Points& tissue_surface) {
  if (muscle.large_faces.faces.empty()) return tissue_surface;
  return enclosing(muscle, nodes, tissue_surface).vertices;
}

/// Pushes what lies on large triangles out of bones, and makes up for the volume that this takes.
static void push_large_faces_out(const PreparedTissue& muscle, const Surroundings& around, EnclosingSurface& surface) {
  std::vector<std::vector<std::size_t>> near;
  bool any = false;
  for (std::size_t b = 0; b < muscle.bones.size(); ++b) {
    near.push_back(places_near(muscle, around, b, surface.vertices));
    any = any || !near.back().empty();
  }
  for (int round = 0; any && round < rounds; ++round) {
    if (round > 0) meet_volume(muscle, surface.volume, surface.asked, surface.vertices);
    for (int i = 0; i < bone_rounds; ++i)
      for (std::size_t b = 0; b < near.size(); ++b) push_out(muscle, around, b, near[b], surface.vertices);
  }
}

Points seen_surface(const PreparedTissue& muscle, const Surroundings& around,
                    const std::vector<SignedDistance>& distances, const Points& nodes) {
  const Points tissue = surface_at(muscle, nodes);
  Points x = tissue;
  if (!muscle.large_faces.faces.empty()) {
    EnclosingSurface surface = enclosing(muscle, nodes, tissue);
    push_large_faces_out(muscle, around, surface);
    x = std::move(surface.vertices);
  }
  push_out_of_muscles(muscle, around, tissue, x);
  push_out_of_bones(muscle, around, distances, x);
  return x;
}

}  // namespace gracilis::tissue
