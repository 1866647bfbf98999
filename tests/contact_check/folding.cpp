#include "folding.hpp"

#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace gracilis::contact_check {

std::vector<Dihedral> dihedrals_of(const TriangleMesh& mesh) {
  std::map<std::pair<Index, Index>, std::vector<Index>> opposite;  // of every directed side
  for (Index f = 0; f < mesh.face_count(); ++f) {
    for (int i = 0; i < 3; ++i)
      opposite[{mesh.faces(i, f), mesh.faces((i + 1) % 3, f)}].push_back(mesh.faces((i + 2) % 3, f));
  }
  std::vector<Dihedral> dihedrals;
  for (const auto& [side, left] : opposite) {
    const auto [start, end] = side;
    if (start > end) continue;
    const auto back = opposite.find({end, start});
    if (left.size() == 1 && back != opposite.end() && back->second.size() == 1)
      dihedrals.push_back({start, end, left[0], back->second[0]});
  }
  return dihedrals;
}

Real dihedral_angle_of(const Dihedral& dihedral, const Points& points) {
  const Vec3 start = points.col(dihedral.start), edge = points.col(dihedral.end) - start;
  const Vec3 left = edge.cross(points.col(dihedral.left) - start);
  const Vec3 right = (points.col(dihedral.right) - start).cross(edge);
  if (left.squaredNorm() == 0 || right.squaredNorm() == 0) return std::numeric_limits<Real>::quiet_NaN();
  return std::atan2(left.cross(right).dot(edge.normalized()), left.dot(right));
}

Real turned_by(Real angle, Real rest_angle) { return std::abs(std::remainder(angle - rest_angle, 2 * pi)); }

Real enclosed_volume(const Points& points, const Eigen::Matrix3Xi& faces) {
  const Vec3 center = points.rowwise().mean();
  Real sixfold = 0;
  for (Index f = 0; f < faces.cols(); ++f) {
    const Vec3 a = points.col(faces(0, f)) - center, b = points.col(faces(1, f)) - center;
    sixfold += a.dot(b.cross(points.col(faces(2, f)) - center));
  }
  return sixfold / 6;
}

}  // namespace gracilis::contact_check
