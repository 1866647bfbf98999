#pragma once

#include <gracilis/geometry/signed_distance.hpp>
#include <gracilis/geometry/triangle_mesh.hpp>

#include <functional>
#include <vector>

namespace gracilis::opensim {

/// A bone that muscles keep out of.
struct SolidBone {
  /// `surface` is closed, m.
  explicit SolidBone(const TriangleMesh& surface);

  SignedDistance distance;
  Vec3 low, high;  ///< the box around it
};

/// How far away the bones are, negative within one, as far as it is less than `most`, m.
Real distance_to(const std::vector<SolidBone>& bones, const Vec3& p, Real most);

/// How far one comes from a point outside of the bones along a unit direction until one is 0.5 mm away, `length` at
/// most, m.
Real way_along(const std::vector<SolidBone>& bones, const Vec3& from, const Vec3& direction, Real length);

/// Sections across a line: their centers, and their corners' distances from these (rays × sections, m).
struct ClearSections {
  Points centers;
  Eigen::MatrixXd radii;
  Real volume_share = 1;  ///< of the round sections' volume
};

/// Centers of sections with these radii (m) brought out of the bones, as clear_of_bones does first.
Points clear_centers(const Points& line, const Eigen::VectorXd& radii, const std::vector<SolidBone>& bones);

/// How far one may go from a section's center along a unit ray for what is beside the muscle but bones, `length` (m) at
/// most; `radius` is the round section's.
using RoomBeside = std::function<Real(const Vec3& center, const Vec3& ray, Real radius, Real length)>;

/// The corners of sections as rays, a column each, section by section: where they begin, which way they go (unit), and
/// how far (rays × sections, m).
struct SectionRays {
  Points feet, directions;
  Eigen::MatrixXd lengths;

  /// Where the rays end, m.
  Points corners() const;
};

/// How long the rays are so that corners keep out of the bones: drawn in to 0.5 mm before one, and until edges between
/// them are outside (drawn_off_ridges), and the others out, by 1.6 times at most, so that sections keep their areas.
/// Where something is beside the muscle, corners are drawn in before that, too, down to 0.4 of their rays, and
/// others go out by 2.2 times at most; what sections lack then the others take, up to twice their areas, so that the
/// muscle keeps its volume, but for what ridges take. Precondition: feet lie outside of the bones.
struct ClearRays {
  Eigen::MatrixXd lengths;  ///< m
  Real volume_share = 1;    ///< of the volume before
};
/// Nothing is moved: the result says how long the rays become.
ClearRays clear_rays(const SectionRays& rays, const std::vector<SolidBone>& bones, const RoomBeside& beside = {});

/// Sections with these radii (m) along a line, brought out of the bones. Centers within a bone or closer to one than 4
/// mm (or their radius) are pushed out, and their neighbors with them, so that the line bends softly; by 30 mm at most.
/// A first or last section outside of the bones stays where it is. Then corners are drawn in by clear_rays: the muscle
/// lies against the bone.
ClearSections clear_of_bones(const Points& line, const Eigen::VectorXd& radii, int rays,
                             const std::vector<SolidBone>& bones, const RoomBeside& beside = {});

}  // namespace gracilis::opensim
