#pragma once

#include <gracilis/scene/scene.hpp>

#include <cstdint>
#include <vector>

namespace gracilis {

/// Where the sections of a line lie in the capture pose, from origin to insertion.
struct SectionLine {
  Points centers;                  ///< m
  std::vector<Index> tendon_ends;  ///< sections that are there for an end of a tendon alone, ascending
};

/// Of a line with shares, as heads of sheets have them, the points there; of a sheet, the mean of its heads' (both
/// without ends of tendons). Else the line's points with every part between them halved `scaling` times (Laclé 2014,
/// eq. 3.19), and, where it has `tendon_sections`, the points where its tendons end, walked along it (eqs. 3.11 to
/// 3.15): none where one of the others lies within 0.1 mm. Precondition: two points or more, scaling 0 to 16.
SectionLine section_line(const ActionLine& line);

/// How many sections a line that is no sheet has without those for ends of tendons, counted before they are made: a
/// file may ask for more than there is room for. Same preconditions.
std::int64_t section_count(const ActionLine& line);

/// Whether these can be a line's shares: ascending, from 0 to 1, two or more.
bool are_shares(const std::vector<Real>& shares);

/// Shares of a line that divide it into so many equal parts, 1 or more.
std::vector<Real> even_shares(Index parts);

/// A sheet's as one line through the middles of its sections, which are those of its surface; any other's as it is. It
/// knows no bodies.
ActionLine middle_line(const Muscle& muscle);

}  // namespace gracilis
