#include <gracilis/io/run/run_layout.hpp>

#include <gracilis/core/errors.hpp>

#include <fmt/format.h>

namespace gracilis {

namespace fs = std::filesystem;

std::string name_of(RunLayout layout) { return layout == RunLayout::compact ? "compact" : "surfaces"; }

std::optional<RunLayout> run_layout_called(const std::string& name) {
  for (const RunLayout layout : run_layouts)
    if (name == name_of(layout)) return layout;
  return std::nullopt;
}

RunLayout layout_of(const fs::path& folder, RunLayout otherwise) {
  if (fs::exists(shapes_file(folder, 0))) return RunLayout::compact;
  // Frames of the other layout, or a run of before there were two.
  const bool has_frames = fs::is_directory(folder / "frames") && !fs::is_empty(folder / "frames");
  return has_frames ? RunLayout::surfaces : otherwise;
}

fs::path frame_file(const fs::path& folder, const std::string& name, int number) {
  return folder / "frames" / fmt::format("{}_{:04}.vtp", name, number);
}

fs::path shapes_file(const fs::path& folder, int number) {
  return folder / "shapes" / fmt::format("{:04}.vtp", number);
}

fs::path fibers_file(const fs::path& folder, int number) {
  return folder / "fibers" / fmt::format("{:04}.vtp", number);
}

fs::path bone_file(const fs::path& folder, const std::string& name) { return folder / "bones" / (name + ".vtp"); }

fs::path file_of_surface(const fs::path& folder, RunLayout layout, const std::string& name, int number) {
  return layout == RunLayout::compact ? shapes_file(folder, number) : frame_file(folder, name, number);
}

std::string piece_of_muscle(RunLayout layout, const std::string& muscle) {
  return layout == RunLayout::compact ? muscle : "";
}

void require_finite(const Eigen::Ref<const Eigen::MatrixXd>& numbers, const fs::path& file, const std::string& what) {
  if (numbers.allFinite()) return;
  throw InputError({file.string(), "", "has " + what + " that is not finite", "run the scene again"});
}

void require_vertices(const fs::path& file, Index count, Index of_frame_0) {
  if (count == of_frame_0) return;
  throw InputError({file.string(), "", fmt::format("has {} vertices, but frame 0 has {}", count, of_frame_0),
                    "run the scene again"});
}

}  // namespace gracilis
