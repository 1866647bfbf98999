#include <gracilis/dynamics/contact/self/self_intersections.hpp>

#include <gracilis/dynamics/constraints/dihedral.hpp>

#include <Eigen/Geometry>
#include <Eigen/SVD>

#include <algorithm>
#include <unordered_map>

namespace gracilis {

namespace {

/// How much of the way those next to a cut go with it, and each goes to its neighbors' middle.
constexpr float half = 0.5f;
/// Rings around a cut whose places tell how it lies.
constexpr int fitted_rings = 3;
/// Weight of the turn alone in the map, against what the places tell: a flat part tells nothing across itself.
constexpr float turn_weight = 0.1f;

/// Pairs that are looked at for each face of a surface.
constexpr Index most_looks = 500;

using PreciseCorners = std::array<Eigen::Vector3d, 3>;

void keep_each_once(std::vector<Index>& numbers) {
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

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
  for (const Index face : pair)
    for (const Index corner : surface.faces.col(face))
      if (particles.inverse_mass(corner) > 0) return true;
  return false;
}

/// Calls act(neighbor) for each particle at the other end of an edge.
template <class Act>
void for_each_neighbor(const ContactSurface& surface, Index particle, const Act& act) {
  for (const Index edge : surface.edges_at(particle)) {
    const auto& ends = surface.edges[static_cast<std::size_t>(edge)].ends;
    act(ends[0] == particle ? ends[1] : ends[0]);
  }
}

std::vector<Index> corners_of(const ContactSurface& surface, const FacePair& pair) {
  std::vector<Index> corners;
  for (const Index face : pair)
    for (const Index corner : surface.faces.col(face)) corners.push_back(corner);
  keep_each_once(corners);
  return corners;
}

std::vector<Index> with_neighbors(const ContactSurface& surface, const std::vector<Index>& particles) {
  std::vector<Index> grown = particles;
  for (const Index particle : particles)
    for_each_neighbor(surface, particle, [&](Index neighbor) { grown.push_back(neighbor); });
  keep_each_once(grown);
  return grown;
}

/// The corners of cuts that hang together by common corners, each part sorted, in the order of their last cuts.
std::vector<std::vector<Index>> parts_of(const ContactSurface& surface, const std::vector<FacePair>& cuts) {
  std::vector<std::size_t> parent(cuts.size());
  const auto root = [&](std::size_t cut) {
    while (parent[cut] != cut) cut = parent[cut] = parent[parent[cut]];
    return cut;
  };
  std::unordered_map<Index, std::size_t> cut_at;
  for (std::size_t cut = 0; cut < cuts.size(); ++cut) {
    parent[cut] = cut;
    for (const Index corner : corners_of(surface, cuts[cut])) {
      const auto [at, is_new] = cut_at.try_emplace(corner, cut);
      // The later cut is the root, so that roots are the parts' last cuts.
      if (!is_new) parent[root(at->second)] = cut, at->second = cut;
    }
  }
  std::vector<std::vector<Index>> of_root(cuts.size()), parts;
  for (std::size_t cut = 0; cut < cuts.size(); ++cut) {
    const std::vector<Index> corners = corners_of(surface, cuts[cut]);
    std::vector<Index>& part = of_root[root(cut)];
    part.insert(part.end(), corners.begin(), corners.end());
  }
  for (std::vector<Index>& part : of_root) {
    if (part.empty()) continue;
    keep_each_once(part);
    parts.push_back(std::move(part));
  }
  return parts;
}

/// From places at rest to places now.
struct AffineMap {
  Eigen::Matrix3f linear;
  Eigen::Vector3f from, to;
  Eigen::Vector3f operator()(const Eigen::Vector3f& rest) const { return to + linear * (rest - from); }
};

Eigen::Matrix3f nearest_turn(const Eigen::Matrix3f& matrix) {
  const Eigen::JacobiSVD<Eigen::Matrix3f> svd(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3f u = svd.matrixU();
  if ((u * svd.matrixV().transpose()).determinant() < 0) u.col(2) = -u.col(2);
  return u * svd.matrixV().transpose();
}

/// The map nearest to how the listed particles lie (shape matching with linear deformations; Müller, Heidelberger,
/// Teschner and Gross 2005).
AffineMap fit(const std::vector<Index>& listed, const Eigen::Matrix3Xf& rest, const Particles& particles) {
  AffineMap map{{}, Eigen::Vector3f::Zero(), Eigen::Vector3f::Zero()};
  for (const Index p : listed) map.from += rest.col(p), map.to += particles.position(p);
  map.from /= static_cast<float>(listed.size()), map.to /= static_cast<float>(listed.size());
  Eigen::Matrix3f mixed = Eigen::Matrix3f::Zero(), of_rest = Eigen::Matrix3f::Zero();
  for (const Index p : listed) {
    const Eigen::Vector3f away = rest.col(p) - map.from;
    mixed += (particles.position(p) - map.to) * away.transpose();
    of_rest += away * away.transpose();
  }
  const float weight = turn_weight * of_rest.trace() / 3;
  map.linear = (mixed + weight * nearest_turn(mixed)) * (of_rest + weight * Eigen::Matrix3f::Identity()).inverse();
  return map;
}

void move_toward(const Eigen::Vector3f& goal, float share, float most, Index particle, Particles& particles) {
  if (!(particles.inverse_mass(particle) > 0)) return;
  Eigen::Vector3f way = share * (goal - particles.position(particle));
  const float length = way.norm();
  if (length > most) way *= most / length;
  particles.position(particle) += way;
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
  keep_each_once(faces);
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

void unfold(const ContactSurface& surface, const Eigen::Matrix3Xf& rest, const std::vector<FacePair>& cuts, float most,
            Particles& particles) {
  for (const std::vector<Index>& part : parts_of(surface, cuts)) {
    std::vector<Index> fitted = part;
    for (int ring = 0; ring < fitted_rings; ++ring) fitted = with_neighbors(surface, fitted);
    const AffineMap map = fit(fitted, rest, particles);
    for (const Index p : with_neighbors(surface, part))
      move_toward(map(rest.col(p)), std::binary_search(part.begin(), part.end(), p) ? 1 : half, most, p, particles);
  }
}

void smooth(const ContactSurface& surface, const std::vector<FacePair>& cuts, int rounds, float most,
            Particles& particles) {
  std::vector<Index> corners;
  for (const FacePair& cut : cuts)
    for (const Index corner : corners_of(surface, cut)) corners.push_back(corner);
  const std::vector<Index> smoothed = with_neighbors(surface, corners);
  std::vector<Eigen::Vector3f> middles(smoothed.size());
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t i = 0; i < smoothed.size(); ++i) {
      Eigen::Vector3f sum = Eigen::Vector3f::Zero();
      int count = 0;
      for_each_neighbor(surface, smoothed[i], [&](Index neighbor) { sum += particles.position(neighbor), ++count; });
      middles[i] = sum / static_cast<float>(count);
    }
    for (std::size_t i = 0; i < smoothed.size(); ++i) move_toward(middles[i], half, most, smoothed[i], particles);
  }
}

}  // namespace gracilis
