#include <gracilis/scene/section_line.hpp>

#include <gracilis/geometry/polylines.hpp>
#include <gracilis/geometry/section_frames.hpp>

#include <algorithm>
#include <cmath>

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

SectionLine section_line(const ActionLine& line) {
  SectionLine sections{subdivide_line(line.points, line.scaling), {}};
  if (!line.tendon_sections) return sections;
  if (line.origin_tendon > 0) add_section(sections, line.origin_tendon);
  if (line.tendon > 0) add_section(sections, polyline_length(line.points) - line.tendon);
  // Where tendons overlap, what ends first lies behind.
  if (sections.tendon_ends.size() == 2 && sections.tendon_ends[1] <= sections.tendon_ends[0])
    sections.tendon_ends = {sections.tendon_ends[1], sections.tendon_ends[0] + 1};
  return sections;
}

}  // namespace gracilis
