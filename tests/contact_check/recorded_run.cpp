#include "recorded_run.hpp"

#include <gracilis/core/errors.hpp>
#include <gracilis/io/mesh/mesh_reader.hpp>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <fstream>
#include <sstream>

namespace gracilis::contact_check {

namespace fs = std::filesystem;

static constexpr Real rigid_tolerance = 2e-6;  // m

static fs::path file_of(const RecordedRun& run, const std::string& name, int frame) {
  return run.folder / "frames" / fmt::format("{}_{:04}.vtp", name, frame);
}

static std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  return cells;
}

static std::vector<std::string> measured_muscles(const fs::path& table) {
  std::ifstream file(table);
  std::string line;
  std::getline(file, line);
  const std::vector<std::string> header = cells(line);
  const auto column = std::find(header.begin(), header.end(), "muscle") - header.begin();
  std::vector<std::string> names;
  while (std::getline(file, line)) {
    const std::vector<std::string> row = cells(line);
    if (column >= static_cast<std::ptrdiff_t>(row.size())) continue;
    const std::string& name = row[static_cast<std::size_t>(column)];
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  if (names.empty())
    throw InputError({table.string(), "", "names no muscle", "give a folder that `gracilis run` wrote"});
  return names;
}

RecordedRun open_run(const fs::path& folder) {
  RecordedRun run{folder, measured_muscles(folder / "measures.csv"), {}, 0};
  const std::string end = "_0000.vtp";
  if (!fs::is_directory(folder / "frames"))
    throw InputError({folder.string(), "", "has no folder 'frames'", "run it with --layout surfaces"});
  for (const fs::directory_entry& entry : fs::directory_iterator(folder / "frames")) {
    const std::string file = entry.path().filename().string();
    if (file.front() == '.' || !file.ends_with(end)) continue;
    const std::string name = file.substr(0, file.size() - end.size());
    if (std::find(run.muscles.begin(), run.muscles.end(), name) == run.muscles.end()) run.bones.push_back(name);
  }
  std::sort(run.bones.begin(), run.bones.end());
  std::vector<std::string> names = run.muscles;
  names.insert(names.end(), run.bones.begin(), run.bones.end());
  const auto is_there = [&](const std::string& name) { return fs::exists(file_of(run, name, run.frame_count)); };
  while (std::all_of(names.begin(), names.end(), is_there)) ++run.frame_count;
  return run;
}

std::vector<Points> read_points(const RecordedRun& run, const std::vector<std::string>& names, int frame) {
  std::vector<Points> points;
  for (const std::string& name : names) points.push_back(read_mesh(file_of(run, name, frame), 1).vertices);
  return points;
}

std::vector<char> moves_with(const Points& bone_rest, const Points& bone_now, const Points& rest, const Points& now) {
  const Eigen::Affine3d motion(Eigen::umeyama(bone_rest, bone_now, false));
  const Eigen::VectorXd distances = (motion * rest - now).colwise().norm();
  std::vector<char> with(static_cast<std::size_t>(rest.cols()));
  for (std::size_t v = 0; v < with.size(); ++v) with[v] = distances[static_cast<Index>(v)] <= rigid_tolerance;
  return with;
}

Judge judge_of(const RecordedRun& run) {
  std::vector<JudgedMuscle> muscles;
  std::vector<JudgedBone> bones;
  for (const std::string& name : run.bones) bones.push_back({name, read_mesh(file_of(run, name, 0), 1)});
  for (const std::string& name : run.muscles) {
    const TriangleMesh mesh = read_mesh(file_of(run, name, 0), 1);
    muscles.push_back({name, mesh, std::vector<char>(static_cast<std::size_t>(mesh.vertex_count()), 0)});
  }
  // Per muscle and bone, vertices that have moved with the bone so far.
  std::vector<std::vector<std::vector<char>>> with(muscles.size());
  for (std::size_t m = 0; m < muscles.size(); ++m)
    with[m].assign(bones.size(), std::vector<char>(muscles[m].attached.size(), 1));
  for (int frame = 0; frame < run.frame_count; frame += std::max(1, run.frame_count / 8)) {
    const std::vector<Points> now = read_points(run, run.muscles, frame),
                              bones_now = read_points(run, run.bones, frame);
    for (std::size_t m = 0; m < muscles.size(); ++m) {
      for (std::size_t b = 0; b < bones.size(); ++b) {
        const std::vector<char> moves =
            moves_with(bones[b].rest.vertices, bones_now[b], muscles[m].rest.vertices, now[m]);
        for (std::size_t v = 0; v < moves.size(); ++v) with[m][b][v] = with[m][b][v] && moves[v];
      }
    }
  }
  for (std::size_t m = 0; m < muscles.size(); ++m) {
    for (const std::vector<char>& moves : with[m])
      for (std::size_t v = 0; v < moves.size(); ++v) muscles[m].attached[v] = muscles[m].attached[v] || moves[v];
  }
  return Judge(std::move(muscles), std::move(bones));
}

}  // namespace gracilis::contact_check
