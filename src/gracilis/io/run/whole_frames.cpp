#include <gracilis/io/run/whole_frames.hpp>

#include <gracilis/io/input_file.hpp>
#include <gracilis/io/run/measures_table.hpp>
#include <gracilis/io/run/run_folder.hpp>
#include <gracilis/io/tables/fiber_table.hpp>
#include <gracilis/io/text_cells.hpp>
#include <gracilis/io/value_reader.hpp>

#include <algorithm>
#include <map>
#include <vector>

namespace gracilis {

namespace fs = std::filesystem;

namespace {

/// What measures.csv says about one muscle in one frame.
struct Measured {
  int rows = 0;
  bool has_fibers = false;
};

/// Per frame, in the scene's order of muscles.
using MeasuredFrames = std::map<Index, std::vector<Measured>>;

}  // namespace

/// Calls `use` for every line that ends with a line break: what stands behind the last one was cut off.
template <class Use>
static void for_whole_lines(std::string_view text, Use&& use) {
  for (std::size_t begin = 0, end = 0; (end = text.find('\n', begin)) != std::string_view::npos; begin = end + 1)
    use(text.substr(begin, end - begin));
}

static MeasuredFrames read_measured(const fs::path& path, const Scene& scene) {
  MeasuredFrames frames;
  const std::string text = text_if_there(path), head = measures_header(scene);
  const std::vector<std::string_view> columns = cells_of(std::string_view(head).substr(0, head.size() - 1));
  const auto at = [&](std::string_view name) {
    return static_cast<std::size_t>(std::find(columns.begin(), columns.end(), name) - columns.begin());
  };
  const std::size_t muscle_at = at("muscle"), fibers_at = at("fiber_strain_mean");
  for_whole_lines(text, [&](std::string_view line) {
    const std::vector<std::string_view> cells = cells_of(line);
    Index frame = 0;
    if (cells.size() != columns.size() || !parse_index(cells[0], frame)) return;
    const auto muscle = std::find_if(scene.muscles.begin(), scene.muscles.end(),
                                     [&](const Muscle& each) { return each.name == cells[muscle_at]; });
    if (muscle == scene.muscles.end()) return;
    std::vector<Measured>& measured = frames[frame];
    measured.resize(scene.muscles.size());
    Measured& row = measured[static_cast<std::size_t>(muscle - scene.muscles.begin())];
    ++row.rows;
    // Earlier versions wrote nan where there are none.
    row.has_fibers = !cells[fibers_at].empty() && cells[fibers_at] != "nan";
  });
  return frames;
}

/// Rows behind the head that are there to their end.
static int count_fiber_rows(const fs::path& path) {
  const std::string text = text_if_there(path);
  int lines = 0, head = -1;
  for_whole_lines(text, [&](std::string_view line) {
    if (head < 0 && line == "endheader") head = lines + 2;
    ++lines;
  });
  return head < 0 ? 0 : std::max(0, lines - head);
}

int count_frames(const fs::path& folder, const Scene& scene) {
  if (scene.muscles.empty()) return 0;
  const MeasuredFrames measured = read_measured(folder / "measures.csv", scene);
  const int fiber_rows = count_fiber_rows(folder / "fiber_lengths.sto");
  const bool compact = layout_of(folder) == RunLayout::compact;
  const auto is_whole = [&](int number) {
    const auto found = measured.find(number);
    if (found == measured.end()) return false;
    for (std::size_t m = 0; m < scene.muscles.size(); ++m) {
      const std::string& name = scene.muscles[m].name;
      if (found->second[m].rows != 1) return false;
      if (found->second[m].has_fibers && number >= fiber_rows) return false;
      if (compact) continue;
      if (!is_there(frame_file(folder, name, number))) return false;
      if (found->second[m].has_fibers && !is_there(fiber_file(folder, name, number))) return false;
    }
    // A compact frame's own file is the last that is written of it.
    if (compact) return is_there(shapes_file(folder, number));
    return std::all_of(scene.bones.begin(), scene.bones.end(),
                       [&](const Bone& bone) { return is_there(frame_file(folder, bone.name, number)); });
  };
  int count = 0;
  while (is_whole(count)) ++count;
  return count;
}

}  // namespace gracilis
