#include <gracilis/anatomy/sections/enhancement.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace gracilis {

using Vec2 = Eigen::Vector2d;

static Vec2 direction(Real angle) { return {std::cos(angle), std::sin(angle)}; }

static Eigen::VectorXd even_angles(Index rays) {
  Eigen::VectorXd angles(rays);
  for (Index i = 0; i < rays; ++i) angles[i] = 2 * pi * i / rays;
  return angles;
}

CastRadii cast_radii(const SectionCut& cut, const Eigen::VectorXd& angles, const Eigen::VectorXd& radii) {
  CastRadii cast{radii, std::vector<bool>(static_cast<std::size_t>(radii.size()), false)};
  for (Eigen::Index i = 0; i < radii.size(); ++i) {
    const Vec2 along = direction(angles[i]), from = radii[i] * along;
    const auto found = cast.found.begin() + i;
    for (const RayHit& hit : cut.hits(from, along)) {
      if (!hit.back) continue;
      cast.radii[i] = radii[i] + hit.distance;  // the last one is the farthest
      *found = true;
    }
    if (*found) continue;
    for (const RayHit& hit : cut.hits(from, -along)) {
      if (hit.back) continue;
      cast.radii[i] = radii[i] - hit.distance;
      *found = true;
      break;
    }
  }
  return cast;
}

std::vector<RayMatch> find_matches(const CastRadii& cast) {
  const auto rays = static_cast<Index>(cast.radii.size()), half = rays / 2;
  std::vector<RayMatch> matches;
  for (Index i = 0; i < half; ++i) {
    const Index opposite = i + half;
    if (!cast.found[static_cast<std::size_t>(i)] || !cast.found[static_cast<std::size_t>(opposite)]) continue;
    if ((cast.radii[i] < 0) == (cast.radii[opposite] < 0)) continue;
    matches.push_back(cast.radii[i] < 0 ? RayMatch{opposite, i} : RayMatch{i, opposite});
  }
  std::sort(matches.begin(), matches.end(),
            [](const RayMatch& a, const RayMatch& b) { return a.positive < b.positive; });
  std::size_t begin = 0;
  Index largest = 0;
  for (std::size_t m = 0; m < matches.size(); ++m) {
    const Index before = m > 0 ? matches[m - 1].positive : matches.back().positive - rays;
    if (matches[m].positive - before <= largest) continue;
    largest = matches[m].positive - before;
    begin = m;
  }
  std::rotate(matches.begin(), matches.begin() + static_cast<std::ptrdiff_t>(begin), matches.end());
  return matches;
}

/// Of a quadrilateral's area; its middle where it has none.
static Vec2 centroid(const std::array<Vec2, 4>& corners) {
  const Vec2 middle = (corners[0] + corners[1] + corners[2] + corners[3]) / 4;
  Vec2 sum = Vec2::Zero();
  Real area = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec2 a = corners[i] - middle, b = corners[(i + 1) % 4] - middle;
    const Real twice = a.x() * b.y() - a.y() * b.x();
    area += twice;
    sum += twice * (a + b) / 3;
  }
  return std::abs(area) > 1e-14 ? Vec2(middle + sum / area) : middle;
}

Vec2 inner_point(const std::vector<RayMatch>& matches, const Eigen::VectorXd& angles, const Eigen::VectorXd& radii) {
  assert(!matches.empty());
  const auto at = [&](Index ray) -> Vec2 { return radii[ray] * direction(angles[ray]); };
  const RayMatch& middle = matches[matches.size() / 2];
  if (matches.size() % 2 == 1) return (at(middle.positive) + at(middle.negative)) / 2;
  const RayMatch& before = matches[matches.size() / 2 - 1];
  return centroid({at(before.positive), at(middle.positive), at(middle.negative), at(before.negative)});
}

/// The middle of the longest way inside the surface on the line through the center in this direction.
static Vec2 middle_of_longest_way(const SectionCut& cut, Real angle) {
  const Vec2 along = direction(angle), from = -10 * along;  // m, from outside of any muscle
  const std::vector<RayHit> hits = cut.hits(from, along);
  Vec2 best = Vec2::Zero();
  Real longest = 0;
  for (std::size_t i = 1; i < hits.size(); ++i) {
    if (hits[i - 1].back || !hits[i].back || hits[i].distance - hits[i - 1].distance <= longest) continue;
    longest = hits[i].distance - hits[i - 1].distance;
    best = from + (hits[i].distance + hits[i - 1].distance) / 2 * along;
  }
  return best;
}

/// Where the center should be, in the section's plane, and the points that it is from.
struct InnerPoint {
  Vec2 center = Vec2::Zero();
  std::vector<std::array<Vec2, 2>> matches;
};

/// `radii` are those of the ring from which rays begin.
static InnerPoint better_center(const SectionCut& cut, const Eigen::VectorXd& radii,
                                const EnhancementSettings& settings) {
  const auto count = static_cast<Index>(radii.size());
  for (Index rays = count * settings.more_rays;; rays *= 2) {
    const Eigen::VectorXd angles = even_angles(rays);
    Eigen::VectorXd begin(rays);
    for (Index i = 0; i < rays; ++i) begin[i] = radii[i * count / rays];
    const CastRadii cast = cast_radii(cut, angles, begin);
    const std::vector<RayMatch> matches = find_matches(cast);
    if (matches.empty()) {
      if (!settings.mend || rays > 576 || cut.contains(Vec2::Zero())) return {};
      continue;
    }
    InnerPoint inner{inner_point(matches, angles, cast.radii), {}};
    for (const RayMatch& match : matches)
      inner.matches.push_back({cast.radii[match.positive] * direction(angles[match.positive]),
                               cast.radii[match.negative] * direction(angles[match.negative])});
    // Between the two sides of a bent section: back onto one of them.
    if (settings.mend && !cut.contains(inner.center))
      inner.center = middle_of_longest_way(cut, angles[matches[matches.size() / 2].positive]);
    return inner;
  }
}

static SectionCut cut_of(const TriangleMesh& surface, const Points& centers, const SectionFrames& frames,
                         Eigen::Index k) {
  const Vec3 x = frames.first_rays.col(k), y = frames.normals.col(k).cross(frames.first_rays.col(k));
  return {surface, centers.col(k), x, y};
}

/// Radii that found nothing take the mean of those that did.
static Eigen::VectorXd filled(const CastRadii& cast, const Eigen::VectorXd& before) {
  Real sum = 0;
  int count = 0;
  for (Eigen::Index i = 0; i < cast.radii.size(); ++i) {
    if (!cast.found[static_cast<std::size_t>(i)] || cast.radii[i] <= 0) continue;
    sum += cast.radii[i];
    ++count;
  }
  if (count == 0) return before;
  Eigen::VectorXd radii = cast.radii;
  for (Eigen::Index i = 0; i < radii.size(); ++i)
    if (!cast.found[static_cast<std::size_t>(i)] || radii[i] <= 0) radii[i] = sum / count;
  return radii;
}

EnhancedSections enhance(const Points& line, const Vec3& first, const Eigen::MatrixXd& radii,
                         const TriangleMesh& surface, const EnhancementSettings& settings) {
  const Eigen::Index sections = line.cols();
  assert(radii.cols() == sections && radii.rows() >= 6 && radii.rows() % 2 == 0 && settings.more_rays >= 1);
  const std::vector<bool> none(static_cast<std::size_t>(sections));
  EnhancedSections result{line, section_frames(line, first, settings.planes), radii, none, none, {}};
  const SectionFrames planes = result.frames;
  for (Eigen::Index k = 0; k < sections; ++k) {
    const SectionCut cut = cut_of(surface, line, planes, k);
    if (cut.empty()) continue;
    const InnerPoint inner = better_center(cut, radii.col(k), settings);
    const Vec3 x = planes.first_rays.col(k), y = planes.normals.col(k).cross(x), old = line.col(k);
    const auto placed = [&](const Vec2& point) -> Vec3 { return old + point.x() * x + point.y() * y; };
    result.centers.col(k) = placed(inner.center);
    for (const auto& [positive, negative] : inner.matches)
      result.matches.push_back({static_cast<Index>(k), placed(positive), placed(negative)});
  }
  result.frames = section_frames(result.centers, first, settings.planes);
  const Eigen::VectorXd angles = even_angles(static_cast<Index>(radii.rows()));
  for (Eigen::Index k = 0; k < sections; ++k) {
    const SectionCut cut = cut_of(surface, result.centers, result.frames, k);
    result.cut[static_cast<std::size_t>(k)] = !cut.empty();
    result.inside[static_cast<std::size_t>(k)] = cut.contains(Vec2::Zero());
    if (!cut.empty()) result.radii.col(k) = filled(cast_radii(cut, angles, radii.col(k)), radii.col(k));
  }
  result.centers.col(0) = line.col(0);
  result.centers.col(sections - 1) = line.col(sections - 1);
  return result;
}

}  // namespace gracilis
