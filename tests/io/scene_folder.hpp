#pragma once

#include <gracilis/core/errors.hpp>
#include <gracilis/io/scene/scene_reader.hpp>

#include "shapes.hpp"

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace gracilis {

/// A folder that lives as long as one test, with a small scene in it: two boxes as bones, 10 mm apart, and a box
/// between them as the muscle.
///
///   pelvis (upper box)   z = 30 ... 40 mm
///   muscle               z = 11 ... 29 mm
///   femur (lower box)    z =  0 ... 10 mm
class SceneFolder {
 public:
  SceneFolder() : path_(std::filesystem::temp_directory_path() / ("gracilis_scene_" + std::to_string(getpid()))) {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
    write_box("femur.ply", 0, 10);
    write_box("muscle.ply", 11, 29);
    write_box("pelvis.ply", 30, 40);
  }
  ~SceneFolder() { std::filesystem::remove_all(path_); }

  std::filesystem::path path(const std::string& name) const { return path_ / name; }

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories(path(name).parent_path());
    std::ofstream(path(name)) << text;
    return path(name);
  }

  /// A 10 mm wide box from z = bottom to top, in millimetres.
  void write_box(const std::string& name, Real bottom, Real top) const {
    std::ostringstream text;
    text << "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n"
            "element face 12\nproperty list uchar int vertex_indices\nend_header\n";
    for (int i = 0; i < 8; ++i)
      text << (i & 1) * 10 << ' ' << (i >> 1 & 1) * 10 << ' ' << (i & 4 ? top : bottom) << '\n';
    for (const char* face :
         {"0 2 1", "1 2 3", "4 5 6", "5 7 6", "0 1 4", "1 5 4", "2 6 3", "3 6 7", "0 4 2", "2 4 6", "1 3 5", "3 7 5"}) {
      text << "3 " << face << '\n';
    }
    write(name, text.str());
  }

 private:
  std::filesystem::path path_;
};

/// A scene file that reads without a problem.
inline std::string good_scene() {
  return R"(schema = 1
name = "boxes"
[[bones]]
name = "pelvis"
file = "pelvis.ply"
unit = "mm"
[[bones]]
name = "femur"
file = "femur.ply"
unit = "mm"
[[joints]]
name = "hip"
parent = "pelvis"
child = "femur"
center = [5, 5, 20]
center_unit = "mm"
[[joints.axes]]
coordinate = "flexion"
axis = [1, 0, 0]
capture_deg = 2
range_deg = [-10, 20]
[[muscles]]
name = "muscle"
file = "muscle.ply"
unit = "mm"
[[muscles.attachments]]
name = "top"
end = "origin"
bone = "pelvis"
bone_distance_mm = 2
[[muscles.attachments]]
name = "bottom"
end = "insertion"
bone = "femur"
bone_distance_mm = 2
[motion]
coordinates = ["flexion"]
key_poses_deg = [[0], [10]]
)";
}

/// The text with the first `from` replaced, which must be there.
inline std::string with(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("the text has no '" + from + "'");
  return text.replace(at, from.size(), to);
}

}  // namespace gracilis
