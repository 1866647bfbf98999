#include <gracilis/dynamics/contact/self/self_intersections.hpp>

#include <gracilis/core/sort_unique.hpp>
#include <gracilis/dynamics/constraints/dihedral.hpp>

#include <Eigen/Geometry>

#include <algorithm>

namespace gracilis {

namespace {

/// Pairs that are looked at for each face of a surface.
constexpr Index most_looks = 500;

using PreciseCorners = std::array<Eigen::Vector3d, 3>;

/// Six times the volume between four points; its sign tells on which side of the first three the fourth is.
double volume(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c, const Eigen::Vector3d& d) {
  return (b - a).cross(c - a).dot(d - a);
}

bool passes_through(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const PreciseCorners& triangle) {
  const auto& [a, b, c] = triangle;
  if (!(volume(a, b, c, p) * volume(a, b, c, q) < 0)) return false;
  const double u = volume(p, q, a, b), v = volume(p, q, b, c), w = volume(p, q, c, a);
  return (u > 0 && v > 0 && w > 0) || (u < 0 && v < 0 && w < 0);
}

/// Whether two faces cut each other where place(particle) tells the corners are.
template <class Place>
bool cut_each_other(const ContactSurface& surface, Index one, Index other, const Place& place) {
  const auto places_of = [&](Index face) -> PreciseCorners {
    return {place(surface.faces(0, face)), place(surface.faces(1, face)), place(surface.faces(2, face))};
  };
  const PreciseCorners a = places_of(one), b = places_of(other);
  const auto side_passes = [](const PreciseCorners& of, int opposite, const PreciseCorners& through) {
    return passes_through(of[static_cast<std::size_t>((opposite + 1) % 3)],
                          of[static_cast<std::size_t>((opposite + 2) % 3)], through);
  };
  int shared = 0, corner_of_one = 0, corner_of_other = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (surface.faces(i, one) == surface.faces(j, other)) ++shared, corner_of_one = i, corner_of_other = j;
  if (shared > 1) return false;
  if (shared == 1) return side_passes(a, corner_of_one, b) || side_passes(b, corner_of_other, a);
  for (int corner = 0; corner < 3; ++corner)
    if (side_passes(a, corner, b) || side_passes(b, corner, a)) return true;
  return false;
}

Index corner_opposite(const ContactSurface& surface, const ContactSurface::Edge& edge, Index face) {
  for (const Index corner : surface.faces.col(face))
    if (corner != edge.ends[0] && corner != edge.ends[1]) return corner;
  return edge.ends[0];
}

/// The angle between an edge's two faces where place(particle) tells the corners are.
template <class Place>
Real angle_at(const ContactSurface& surface, const ContactSurface::Edge& edge, const Place& place) {
  return dihedral_angle(place(edge.ends[0]), place(edge.ends[1]), place(corner_opposite(surface, edge, edge.faces[0])),
                        place(corner_opposite(surface, edge, edge.faces[1])));
}

bool is_folded(Real at_rest, Real now) { return std::abs(std::remainder(now - at_rest, 2 * pi)) > pi / 2; }

/// Whether the normals of an edge's faces are more than 45 degrees apart.
template <class Place>
bool is_bent(const ContactSurface& surface, const ContactSurface::Edge& edge, const Place& place) {
  const auto area = [&](Index face) -> Vec3 {
    const Vec3 corner = place(surface.faces(0, face));
    return (place(surface.faces(1, face)) - corner).cross(place(surface.faces(2, face)) - corner);
  };
  const Vec3 left = area(edge.faces[0]), right = area(edge.faces[1]);
  const Real cosine = left.dot(right);
  return cosine < 0 || 2 * cosine * cosine < left.squaredNorm() * right.squaredNorm();
}

bool can_move(const ContactSurface& surface, const FacePair& pair, const Particles& particles) {
  return can_move(surface, pair[0], particles) || can_move(surface, pair[1], particles);
}

}  // namespace

void gather_folded(const ContactSurface& surface, const Particles& particles, std::vector<Index>& faces) {
  Eigen::Matrix3Xf areas(3, surface.faces.cols());
  for (Index face = 0; face < areas.cols(); ++face) areas.col(face) = face_area(surface, face, particles);
  for (const ContactSurface::Edge& edge : surface.edges) {
    const auto [left, right] = edge.faces;
    if (left < 0 || right < 0 || areas.col(left).dot(areas.col(right)) >= 0) continue;
    for (const Index end : edge.ends) {
      const std::span<const Index> around = surface.vertex_faces.around(end);
      faces.insert(faces.end(), around.begin(), around.end());
    }
  }
}

std::vector<FacePair> find_self_intersections(const ContactSurface& surface, const Eigen::Matrix3Xf& rest,
                                              const Particles& before, const Particles& particles,
                                              std::vector<Index> faces) {
  sort_unique(faces);
  struct FaceBox {
    Index face;
    Eigen::AlignedBox3f box;
  };
  std::vector<FaceBox> boxes;
  Eigen::AlignedBox3f all;
  for (const Index face : faces) {
    boxes.push_back({face, {}});
    for (const Index corner : surface.faces.col(face))
      boxes.back().box.extend(Eigen::Vector3f(particles.position(corner)));
    all.extend(boxes.back().box);
  }
  Index along = 0;
  if (!boxes.empty()) all.sizes().maxCoeff(&along);
  std::stable_sort(boxes.begin(), boxes.end(),
                   [along](const FaceBox& l, const FaceBox& r) { return l.box.min()[along] < r.box.min()[along]; });
  const auto now = [&](Index p) -> Eigen::Vector3d { return particles.position(p).cast<double>(); };
  const auto then = [&](Index p) -> Eigen::Vector3d { return rest.col(p).cast<double>(); };
  const auto earlier = [&](Index p) -> Eigen::Vector3d { return before.position(p).cast<double>(); };
  std::vector<FacePair> cuts;
  Index looks = most_looks * static_cast<Index>(surface.faces.cols());
  for (auto one = boxes.begin(); one != boxes.end() && looks > 0; ++one)
    for (auto other = one + 1; other != boxes.end() && other->box.min()[along] <= one->box.max()[along] && looks > 0;
         ++other, --looks) {
      const FacePair pair = {std::min(one->face, other->face), std::max(one->face, other->face)};
      if (one->box.intersects(other->box) && cut_each_other(surface, pair[0], pair[1], now) &&
          !cut_each_other(surface, pair[0], pair[1], then) && !cut_each_other(surface, pair[0], pair[1], earlier) &&
          can_move(surface, pair, particles))
        cuts.push_back(pair);
    }
  std::sort(cuts.begin(), cuts.end());
  return cuts;
}

std::vector<FacePair> find_folds(const ContactSurface& surface, const Eigen::Matrix3Xf& rest, const Particles& before,
                                 const Particles& particles) {
  const auto now = [&](Index p) -> Vec3 { return particles.position(p).cast<Real>(); };
  const auto then = [&](Index p) -> Vec3 { return rest.col(p).cast<Real>(); };
  const auto earlier = [&](Index p) -> Vec3 { return before.position(p).cast<Real>(); };
  std::vector<FacePair> folds;
  for (const ContactSurface::Edge& edge : surface.edges) {
    const auto [left, right] = edge.faces;
    if (left < 0 || right < 0 || !is_bent(surface, edge, now)) continue;
    const Real at_rest = angle_at(surface, edge, then);
    if (is_folded(at_rest, angle_at(surface, edge, now)) && !is_folded(at_rest, angle_at(surface, edge, earlier)) &&
        can_move(surface, {left, right}, particles))
      folds.push_back({std::min(left, right), std::max(left, right)});
  }
  std::sort(folds.begin(), folds.end());
  return folds;
}

}  // namespace gracilis
