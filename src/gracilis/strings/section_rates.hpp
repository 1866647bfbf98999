#pragma once

#include <gracilis/strings/muscle_strings.hpp>

#include <vector>

namespace gracilis::strings {

/// The derivative of v / |v| by v; zero where v is.
Eigen::Matrix3d rate_of_unit(const Vec3& v);

/// How fast the cross-sections turn where nodes move: the derivative of `section_turns`, at one state of the strings.
class SectionRates {
 public:
  SectionRates(const MuscleStrings& muscle, const Points& places);

  /// Of each inner section (columns 1 to nodes - 2), rad per unit of `rates` (3 × nodes of all strings, m per unit).
  Points turning(const Points& rates) const;
  /// Adds to `rates` what the transposed of `turning` makes of `weights` (3 × nodes of a string).
  void add_transposed(const Points& weights, Points& rates) const;

  /// The rotation from the capture pose.
  const Eigen::Matrix3d& turn(Index section) const { return turns_[static_cast<std::size_t>(section)]; }

 private:
  const MuscleStrings& muscle_;
  std::vector<Eigen::Matrix3d> turns_;
  std::vector<Eigen::Matrix3d> softness_;   ///< per section: from a moment to a turn
  Points arms_;                             ///< per node: where its section has turned it about the center, m
  Points directions_;                       ///< per section: where it has turned its direction, times its spread
  std::vector<Eigen::Matrix3d> mean_rate_;  ///< per section: of the unit mean direction, by the sum
  std::vector<Eigen::Matrix3d> unit_rate_;  ///< per node: of its unit direction, by its neighbors' difference
};

}  // namespace gracilis::strings
