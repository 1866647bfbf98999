#pragma once

#include <gracilis/anatomy/joints/joint_control.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace gracilis {

/// Which samples of a joint control unit are asked in some poses.
struct AskedSamples {
  std::vector<std::string> coordinates;
  Eigen::MatrixXd samples;  ///< samples × coordinates, degrees
  Eigen::MatrixXd poses;    ///< poses × coordinates, degrees
  std::vector<int> asked;   ///< per sample: in how many poses it is among the neighbors
  int used() const;         ///< samples that are asked in some pose
};

/// `poses`: poses × the unit's coordinates, rad.
AskedSamples asked_samples(const JointControlUnit& unit, const Eigen::MatrixXd& poses);

/// Into a folder, which is made where there is none: neighbors.csv, a row per sample, and A_B.svg for every two
/// coordinates (A.svg where there is one): all samples, those that are asked, and the poses. Throws InputError.
void write_asked_samples(const std::filesystem::path& folder, const AskedSamples& asked);

}  // namespace gracilis
