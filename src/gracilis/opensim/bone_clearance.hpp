#pragma once

#include <gracilis/geometry/signed_distance.hpp>
#include <gracilis/geometry/triangle_mesh.hpp>

namespace gracilis::opensim {

/// A bone that muscles keep out of.
struct SolidBone {
  explicit SolidBone(const TriangleMesh& surface);

  SignedDistance distance;
  Vec3 low, high;  ///< the box around it
};

/// Sections across a line: their centers, and their corners' distances from these (rays × sections, m).
struct ClearSections {
  Points centers;
  Eigen::MatrixXd radii;
};

/// Sections with these radii (m) along a line, brought out of the bones. Centers within a bone or closer to one than 4
/// mm (or their radius) are pushed out, and their neighbors with them, so that the line bends softly; by 30 mm at most.
/// Then corners are drawn in to 0.5 mm before a bone, and the others out, by 1.6 times at most, so that the sections
/// keep their areas: the muscle lies against the bone. A first or last section outside of the bones stays where it is.
ClearSections clear_of_bones(const Points& line, const Eigen::VectorXd& radii, int rays,
                             const std::vector<SolidBone>& bones);

}  // namespace gracilis::opensim
