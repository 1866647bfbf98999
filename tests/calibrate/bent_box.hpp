#pragma once

#include "io/scene_folder.hpp"

#include <filesystem>
#include <string>

namespace gracilis {

/// Two bodies that a hinge at the origin joins, and a muscle in front of it whose taut strings lie against a shaft when
/// it bends: what fascia ties them by (tie_length) decides about their lengths and arms. A run through 100 degrees
/// takes a tenth of a second.
inline const std::string bent_box = R"(schema = 1
name = "bent"
method = "strings"
[fibers]
count = 8
segments = 10
[settings]
strings = 8
segments = 12
iterations = 40
tie_length = 0.025
[distance_field]
cell_size = 0.002
[[bones]]
name = "shaft"
body = "pelvis"
box = { center_mm = [0, 0, 20], size_mm = [12, 10, 40], cells = [2, 2, 6] }
[[bones]]
name = "top"
body = "pelvis"
box = { center_mm = [0, -9, 33], size_mm = [12, 10, 4] }
[[bones]]
name = "bottom"
body = "femur"
box = { center_mm = [0, -9, -33], size_mm = [12, 10, 4] }
[[joints]]
name = "hip"
parent = "pelvis"
child = "femur"
center = [0, 0, 0]
[[joints.axes]]
coordinate = "flexion"
axis = [1, 0, 0]
range_deg = [-60, 60]
[[muscles]]
name = "front"
box = { center_mm = [0, -10, 0], size_mm = [8, 6, 60], cells = [2, 2, 12] }
[[muscles.attachments]]
name = "top"
end = "origin"
bone = "top"
bone_distance_mm = 2
[[muscles.attachments]]
name = "bottom"
end = "insertion"
bone = "bottom"
bone_distance_mm = 2
[motion]
coordinates = ["flexion"]
key_poses_deg = [[0], [10]]
)";

/// Arms about flexion in a table beside it, and what may change.
inline const std::string aim_at_arms = R"([[targets]]
kind = "moment_arms"
file = "arms.csv"
coordinate = "flexion"
muscles = ["front"]
[[parameters]]
key = "tie_length"
bounds = [0.004, 0.1]
scale = "log"
)";

/// A folder with that scene in it.
struct BentFolder : SceneFolder {
  BentFolder() { write("bent.toml", bent_box); }
};

}  // namespace gracilis
