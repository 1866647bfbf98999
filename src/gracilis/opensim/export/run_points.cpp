#include <gracilis/opensim/export/run_points.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/io/atomic_file.hpp>
#include <gracilis/io/run/recorded_run.hpp>
#include <gracilis/opensim/export/muscle_element.hpp>
#include <gracilis/opensim/export/muscle_points.hpp>
#include <gracilis/opensim/export/muscle_text.hpp>
#include <gracilis/opensim/export/xml_text.hpp>
#include <gracilis/opensim/import/muscle_heads.hpp>
#include <gracilis/opensim/reader/crossed_coordinates.hpp>
#include <gracilis/opensim/reader/model_reader.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace gracilis::opensim {

/// The muscle in the poses in which it has a length: those of the samples where they hold fibers, else the run's
/// frames.
static KnownFibers known_fibers(const RecordedRun& run, const LengthSamples& samples, const MuscleLengths& muscle,
                                const std::vector<std::vector<RigidTransform>>& poses, std::vector<Index> bodies,
                                Index count) {
  KnownFibers known;
  known.bodies = std::move(bodies);
  std::vector<Eigen::Index> rows;
  for (std::size_t pose = 0; pose < poses.size(); ++pose) {
    const auto row = static_cast<Eigen::Index>(pose);
    if (!std::isfinite(muscle.lengths[row])) continue;
    Points line = muscle.fibers.empty() ? mean_fiber(recorded_fibers(run, muscle.name, static_cast<int>(pose)), count)
                                        : muscle.fibers[pose];
    if (line.cols() == 0) return {};
    rows.push_back(row);
    known.lines.push_back(std::move(line));
    std::vector<RigidTransform>& of_bodies = known.poses.emplace_back();
    for (const Index body : known.bodies) of_bodies.push_back(poses[pose][static_cast<std::size_t>(body)]);
  }
  known.samples.coordinates = samples.coordinates(rows, Eigen::all);
  known.samples.muscles = {{muscle.name, muscle.lengths(rows),
                            muscle.arms.cols() > 0 ? Eigen::MatrixXd(muscle.arms(rows, Eigen::all))
                                                   : Eigen::MatrixXd(static_cast<Eigen::Index>(rows.size()), 0)}};
  return known;
}

/// The bodies that the muscle's points may be put on: of one that the model lacks any.
static std::vector<Index> bodies_for(const Model& model, const Muscle* own) {
  if (own) return bodies_between(model, own->path);
  std::vector<Index> all(model.bodies.size());
  std::iota(all.begin(), all.end(), Index{0});
  return all;
}

PointExport export_points(const std::filesystem::path& folder, const std::filesystem::path& model_file,
                          const Model& model, const LengthSamples& samples, Index count,
                          const std::filesystem::path& out) {
  const XmlFile file = read_xml(model_file);
  const RecordedRun run = open_recorded_run(folder);
  const Eigen::Index pose_count = samples.spread ? samples.coordinates.rows() : run.frame_count;
  if (samples.coordinates.rows() < pose_count)
    throw InputError({folder.string(), "", "has fewer rows of fiber lengths than frames", "run the scene again"});
  Skeleton skeleton(model);
  std::vector<std::vector<RigidTransform>> poses;
  for (Eigen::Index row = 0; row < pose_count; ++row) {
    skeleton.place(samples.coordinates.row(row));
    poses.push_back(skeleton.poses());
  }
  PointExport result;
  std::string text;
  std::vector<KnownFibers> written;
  for (const MuscleLengths& each : samples.muscles) {
    const Index index = index_of(model.muscles, each.name);
    const Muscle* own = index < 0 ? nullptr : &model.muscles[static_cast<std::size_t>(index)];
    const std::vector<std::string> heads = own ? std::vector<std::string>{} : heads_in_model(model, each.name);
    for (const std::string& head : heads) {
      result.left_out.push_back(part_of_sheet(head, each.name));
      text += own_muscle_text(file, head);
    }
    if (!heads.empty()) continue;
    if (own && own->path.points.empty()) {
      result.left_out.push_back(fmt::format("{}: its path is a function", each.name));
      text += own_muscle_text(file, each.name);
      continue;
    }
    std::vector<FiberPoint> points;
    std::string why = "it follows the model's line";
    KnownFibers known;
    if (!(own && samples.follow_lines)) {
      known = known_fibers(run, samples, each, poses, bodies_for(model, own), count);
      points = points_of(skeleton, known, own, why);
    }
    if (points.empty()) {
      result.left_out.push_back(fmt::format("{}: {}", each.name, why));
      if (own) text += own_muscle_text(file, each.name);
      continue;
    }
    const Muscle along = muscle_along(skeleton, points, each.name, own, samples.coordinates.row(0));
    text += own ? own_muscle_text_along(file, model, along) : muscle_text(model, along);
    written.push_back(std::move(known));
  }
  if (text.empty()) throw InputError({folder.string(), "", "has no fibers", "run the scene with fibers"});
  write_text_atomically(out, fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\" ?>\n<OpenSimDocument "
                                         "Version=\"{}\">\n  <ForceSet name=\"{}\">\n    <objects>\n{}    "
                                         "</objects>\n  </ForceSet>\n</OpenSimDocument>\n",
                                         std::max(model.version, 30000), xml_text(folder.filename().string()), text));
  Model read = model;
  read_force_set(out, true, read);
  Skeleton read_skeleton(read);
  for (const KnownFibers& known : written) {
    const MuscleLengths& muscle = known.samples.muscles[0];
    const Index index = index_of(model.muscles, muscle.name);
    const Path* own = index < 0 ? nullptr : &model.muscles[static_cast<std::size_t>(index)].path;
    const Path& path = read.muscles[static_cast<std::size_t>(index_of(read.muscles, muscle.name))].path;
    result.written.push_back(
        {muscle.name, path.points.size(), point_errors(read_skeleton, path, own, known), muscle.arms.cols() == 0});
  }
  return result;
}

}  // namespace gracilis::opensim
