#include <gracilis/dynamics/contact/self/unfolding.hpp>

#include <gracilis/core/sort_unique.hpp>

#include <Eigen/Geometry>
#include <Eigen/SVD>

#include <algorithm>
#include <unordered_map>

namespace gracilis {

namespace {

/// How much of the way those next to a cut go with it, and each goes to its neighbors' middle.
constexpr float half = 0.5f;
/// Rings around a cut, or around a particle, whose places tell how it lies.
constexpr int rings_around_cut = 3, rings_around_particle = 2;
/// Rings around a cut that go with it where motions are smoothed.
constexpr int rings_of_motion = 3;
/// Weight of the turn alone in the map, against what the places tell: a flat part tells nothing across itself.
constexpr float turn_weight = 0.1f;
/// Where a surface is thin for its edges a particle stands out from its neighbors' middle by this share of them.
constexpr float thin = 0.1f;

std::vector<Index> corners_of(const ContactSurface& surface, const FacePair& pair) {
  std::vector<Index> corners;
  for (const Index face : pair)
    for (const Index corner : surface.faces.col(face)) corners.push_back(corner);
  sort_unique(corners);
  return corners;
}

std::vector<Index> with_neighbors(const ContactSurface& surface, const std::vector<Index>& particles) {
  std::vector<Index> grown = particles;
  for (const Index particle : particles)
    for_each_neighbor(surface, particle, [&](Index neighbor) { grown.push_back(neighbor); });
  sort_unique(grown);
  return grown;
}

std::vector<Index> with_rings(const ContactSurface& surface, std::vector<Index> particles, int rings) {
  for (int ring = 0; ring < rings; ++ring) particles = with_neighbors(surface, particles);
  return particles;
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
    sort_unique(part);
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

Eigen::Vector3f middle_of_neighbors(const ContactSurface& surface, Index particle, const Particles& particles) {
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  float count = 0;
  for_each_neighbor(surface, particle, [&](Index neighbor) { sum += particles.position(neighbor), ++count; });
  return sum / count;
}

/// Where a particle stands beside its neighbors' middle at rest; 0 where the surface is not thin there, which smoothing
/// does not harm.
Eigen::Vector3f offset_where_thin(const ContactSurface& surface, Index particle, const Eigen::Matrix3Xf& rest) {
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  float count = 0, edges = 0;
  for_each_neighbor(surface, particle, [&](Index neighbor) {
    sum += rest.col(neighbor), edges += (rest.col(neighbor) - rest.col(particle)).norm(), ++count;
  });
  const Eigen::Vector3f normal = sum_around(surface, particle, [&](Index face) -> Eigen::Vector3f {
    const Eigen::Vector3f corner = rest.col(surface.faces(0, face));
    return (rest.col(surface.faces(1, face)) - corner).cross(rest.col(surface.faces(2, face)) - corner);
  });
  Eigen::Vector3f offset = rest.col(particle) - sum / count;
  if (!(offset.dot(normal.normalized()) > thin * edges / count)) return Eigen::Vector3f::Zero();
  return offset;
}

/// So many times over, the corners of cuts and so many rings around them go half of the way to goal(particle), all at
/// once.
template <class Goal>
void relax(const ContactSurface& surface, const std::vector<FacePair>& cuts, int rings, int rounds, float most,
           Particles& particles, const Goal& goal) {
  std::vector<Index> corners;
  for (const FacePair& cut : cuts)
    for (const Index corner : corners_of(surface, cut)) corners.push_back(corner);
  const std::vector<Index> moved = with_rings(surface, corners, rings);
  std::vector<Eigen::Vector3f> goals(moved.size());
  for (int round = 0; round < rounds; ++round) {
    std::transform(moved.begin(), moved.end(), goals.begin(), goal);
    for (std::size_t i = 0; i < moved.size(); ++i) move_toward(goals[i], half, most, moved[i], particles);
  }
}

}  // namespace

void unfold(const ContactSurface& surface, const Eigen::Matrix3Xf& rest, const std::vector<FacePair>& cuts, float most,
            Particles& particles) {
  for (const std::vector<Index>& part : parts_of(surface, cuts)) {
    const AffineMap map = fit(with_rings(surface, part, rings_around_cut), rest, particles);
    for (const Index p : with_neighbors(surface, part))
      move_toward(map(rest.col(p)), std::binary_search(part.begin(), part.end(), p) ? 1 : half, most, p, particles);
  }
}

void smooth(const ContactSurface& surface, const std::vector<FacePair>& cuts, int rounds, float most,
            Particles& particles) {
  relax(surface, cuts, 1, rounds, most, particles,
        [&](Index particle) { return middle_of_neighbors(surface, particle, particles); });
}

void restore_shape(const ContactSurface& surface, const Eigen::Matrix3Xf& rest, const std::vector<FacePair>& cuts,
                   int rounds, float most, Particles& particles) {
  relax(surface, cuts, 1, rounds, most, particles, [&](Index particle) -> Eigen::Vector3f {
    Eigen::Vector3f middle = middle_of_neighbors(surface, particle, particles);
    const Eigen::Vector3f offset = offset_where_thin(surface, particle, rest);
    if (offset.isZero(0)) return middle;
    return middle + fit(with_rings(surface, {particle}, rings_around_particle), rest, particles).linear * offset;
  });
}

void smooth_motion(const ContactSurface& surface, const Particles& predicted, const std::vector<FacePair>& cuts,
                   int rounds, float most, Particles& particles) {
  relax(surface, cuts, rings_of_motion, rounds, most, particles, [&](Index particle) -> Eigen::Vector3f {
    return predicted.position(particle) + middle_of_neighbors(surface, particle, particles) -
           middle_of_neighbors(surface, particle, predicted);
  });
}

}  // namespace gracilis
