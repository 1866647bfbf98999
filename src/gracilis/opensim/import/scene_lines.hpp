#pragma once

#include <gracilis/opensim/reader/model.hpp>

#include <string>
#include <vector>

namespace gracilis::opensim {

/// What a scene file says of a muscle's line beyond its points in the capture pose: the path's own points, with those
/// that come, go and move, and the surfaces that it runs around. Empty where the points stay as they are. What a scene
/// cannot say is added to `left_out`: such points stay as they are at `coordinates`. `line` is the table that it
/// belongs to, "muscles.action_line" or, of a sheet's head, "muscles.action_line.heads".
std::string line_path_text(const Model& model, const Muscle& muscle, const std::vector<RigidTransform>& poses,
                           const Eigen::VectorXd& coordinates, const std::string& line,
                           std::vector<std::string>& left_out);

}  // namespace gracilis::opensim
