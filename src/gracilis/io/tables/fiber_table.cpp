#include <gracilis/io/tables/fiber_table.hpp>

#include <gracilis/anatomy/joints/joint_pose.hpp>
#include <gracilis/io/atomic_file.hpp>
#include <gracilis/io/input_file.hpp>

#include <fmt/format.h>

namespace gracilis {

std::string fiber_lengths_head(const Scene& scene, const std::vector<MuscleFibers>& fibers, int rows) {
  std::string labels = "time";
  std::size_t columns = 1;
  for (const std::string& coordinate : coordinate_names(scene)) {
    labels += "\t" + coordinate;
    ++columns;
  }
  for (std::size_t m = 0; m < fibers.size(); ++m) {
    if (fibers[m].lengths.empty()) continue;
    const std::string& name = scene.muscles[m].name;
    labels += "\t" + name;
    for (std::size_t f = 0; f < fibers[m].lengths.size(); ++f) labels += fmt::format("\t{}_f{:03}", name, f);
    columns += 1 + fibers[m].lengths.size();
  }
  return fmt::format("fiber_lengths\nversion=1\nnRows={}\nnColumns={}\ninDegrees=yes\nendheader\n{}\n", rows, columns,
                     labels);
}

std::string fiber_lengths_row(const Scene& scene, const Pose& pose, const std::vector<MuscleFibers>& fibers) {
  std::string row = fmt::format("{}", pose.time);
  std::size_t coordinate = 0;
  for (const Joint& joint : scene.joints)
    for (const JointAxis& axis : joint.axes) {
      if (coordinate >= pose.coordinates.size()) break;
      const Real value = pose.coordinates[coordinate++];
      row += fmt::format("\t{}", axis.translation ? value : degrees(value));
    }
  for (const MuscleFibers& muscle : fibers) {
    if (muscle.lengths.empty()) continue;
    row += fmt::format("\t{:.9g}", muscle.mean_length);
    for (const Real length : muscle.lengths) row += fmt::format("\t{:.9g}", length);
  }
  return row + "\n";
}

void truncate_fiber_lengths(const std::filesystem::path& path, int rows, int announced) {
  if (!is_there(path)) return;
  const std::string text = text_if_there(path);
  const std::size_t end = text.find("endheader\n"), labels = text.find('\n', end + 10);
  if (end == std::string::npos || labels == std::string::npos) {
    std::filesystem::remove(path);
    return;
  }
  std::size_t last = labels + 1;
  int kept = 0;
  for (; kept < rows; ++kept) {
    const std::size_t next = text.find('\n', last);
    if (next == std::string::npos) break;  // what an interruption cut off
    last = next + 1;
  }
  std::string head = text.substr(0, labels + 1);
  const std::size_t count = head.find("nRows="), after = head.find('\n', count);
  if (count < after && after != std::string::npos)
    head.replace(count, after - count, fmt::format("nRows={}", announced));
  write_text_atomically(path, head + text.substr(labels + 1, last - labels - 1));
}

std::filesystem::path fiber_file(const std::filesystem::path& folder, const std::string& muscle, int number) {
  return folder / "fibers" / fmt::format("{}_{:04}.vtp", muscle, number);
}

}  // namespace gracilis
