#include <gracilis/scene/section_line.hpp>

#include <gracilis/geometry/polylines.hpp>
#include <gracilis/geometry/section_frames.hpp>

#include <algorithm>
#include <cmath>
#include <functional>

namespace gracilis {

/// Sections that nearly coincide would have no plane between them, m.
static constexpr Real least_distance = 1e-4;

static void add_section(SectionLine& sections, Real place) {
  const std::vector<Real> places = distances_along(sections.centers);
  const auto next = std::lower_bound(places.begin(), places.end(), place);
  if (next == places.begin() || next == places.end()) return;
  if (*next - place < least_distance || place - *(next - 1) < least_distance) return;
  const Eigen::Index k = next - places.begin(), count = sections.centers.cols();
  Points centers(3, count + 1);
  centers << sections.centers.leftCols(k), points_along(sections.centers, {place}),
      sections.centers.rightCols(count - k);
  sections.centers = std::move(centers);
  sections.tendon_ends.push_back(static_cast<Index>(k));
}

/// Each head's sections, which are as many.
static Points mean_of_heads(const std::vector<ActionLine>& heads) {
  Points mean = section_line(heads[0]).centers;
  for (std::size_t h = 1; h < heads.size(); ++h) mean += section_line(heads[h]).centers;
  return mean / static_cast<Real>(heads.size());
}

static Points points_at_shares(const ActionLine& line) {
  std::vector<Real> places = line.shares;
  for (Real& place : places) place *= polyline_length(line.points);
  return points_along(line.points, places);
}

SectionLine section_line(const ActionLine& line) {
  if (!line.heads.empty()) return {mean_of_heads(line.heads), {}};
  if (!line.shares.empty()) return {points_at_shares(line), {}};
  SectionLine sections{subdivide_line(line.points, line.scaling), {}};
  if (!line.tendon_sections) return sections;
  if (line.origin_tendon > 0) add_section(sections, line.origin_tendon);
  if (line.tendon > 0) add_section(sections, polyline_length(line.points) - line.tendon);
  // Where tendons overlap, what ends first lies behind.
  if (sections.tendon_ends.size() == 2 && sections.tendon_ends[1] <= sections.tendon_ends[0])
    sections.tendon_ends = {sections.tendon_ends[1], sections.tendon_ends[0] + 1};
  return sections;
}

std::int64_t section_count(const ActionLine& line) {
  if (!line.shares.empty()) return static_cast<std::int64_t>(line.shares.size());
  return (static_cast<std::int64_t>(line.points.cols() - 1) << line.scaling) + 1;
}

bool are_shares(const std::vector<Real>& shares) {
  const auto within = [](Real share) { return share >= 0 && share <= 1; };
  return shares.size() >= 2 && std::all_of(shares.begin(), shares.end(), within) &&
         std::adjacent_find(shares.begin(), shares.end(), std::greater_equal<>()) == shares.end();
}

std::vector<Real> even_shares(Index parts) {
  std::vector<Real> shares;
  for (Index i = 0; i <= parts; ++i) shares.push_back(static_cast<Real>(i) / parts);
  return shares;
}

ActionLine middle_line(const Muscle& muscle) {
  ActionLine line = muscle.action_line;
  if (line.heads.empty()) return line;
  line.points = section_line(line).centers;
  line.centers.resize(3, line.points.cols());
  for (Eigen::Index k = 0; k < line.centers.cols(); ++k)
    line.centers.col(k) = muscle.surface.vertices.middleCols(k * line.rays, line.rays).rowwise().mean();
  line.heads.clear();
  return line;
}

}  // namespace gracilis
