#pragma once

#include <gracilis/io/scene/scene_reader.hpp>
#include <gracilis/view/session/moment_arm_files.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace gracilis {

/// A coordinate that goes from one value to another, or stays at one. Degrees, or mm where it is a translation.
struct CoordinateRange {
  std::string name;
  Real from = 0, to = 0;
  Real step = 0;  ///< more than 0; 0: it stays at `from`

  bool moves() const { return step != 0; }  ///< from one value to another
};

/// "NAME=FROM:TO:STEP" or "NAME=VALUE", as `--coord` has it. Throws ConfigurationError.
CoordinateRange parse_coordinate_range(const std::string& text);

/// Makes the scene's motion one through the range of the coordinate that moves, or through all combinations where
/// several do, the first fastest (motion_over_grid); with others where they are said to be, or at their capture value.
/// Returns those that move. Throws ConfigurationError where there is no such coordinate, one is given twice, none
/// moves, or there are more frames than the scene allows.
std::vector<MovedCoordinate> move_through(const std::vector<CoordinateRange>& ranges, LoadedScene& loaded);

/// Where a range's run folder is by default: runs/NAME_rom.
std::filesystem::path range_folder(const Scene& scene);

}  // namespace gracilis
