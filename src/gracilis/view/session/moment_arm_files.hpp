#pragma once

#include <gracilis/scene/scene.hpp>
#include <gracilis/simulate/arm_comparison.hpp>
#include <gracilis/view/session/moment_arm_tables.hpp>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace gracilis {

/// How a muscle acts in a coordinate's motion, over all poses.
struct MuscleArms {
  std::string muscle, coordinate;
  bool translation = false;  ///< of the coordinate: arms are then m per m by which the muscle shortens
  Real least = 0, most = 0;  ///< m per rad
  Real largest_step = 0;     ///< of that between neighbors, per degree (m)
  std::vector<std::pair<std::string, ArmComparison>> beside = {};  ///< references by their sources
};

/// What a range of motion told.
struct MomentArmReport {
  std::vector<MuscleArms> muscles;    ///< by coordinate
  std::vector<std::string> lines;     ///< per muscle and reference, for people
  std::vector<std::string> warnings;  ///< why there are none, or none to compare
};

/// Writes the moment arms of a run folder about the coordinates that its motion moves (those that its method knows, or
/// else what its fiber lengths say). Of translations: how much muscles shorten. The scene's motion is the range; rows
/// before it only led there.
/// - Of one coordinate: moment_arms.sto, where the method knows forces with `<muscle>_by_force`, moment over tension,
///   too; plots/moment_arms*.svg; and beside `references`, as far as they are of this coordinate, reference.csv.
/// - Of several, whose values are all combined, without references:
///   for each `moment_arms_about_<coordinate>.sto`,
///   and per muscle `plots/moment_arms_about_<coordinate>_<muscle>.svg`.
/// Precondition: at least one. Throws InputError.
MomentArmReport write_moment_arms(const std::filesystem::path& folder, const Scene& scene,
                                  const std::vector<MovedCoordinate>& moved, const std::vector<ArmCurve>& references);

}  // namespace gracilis
