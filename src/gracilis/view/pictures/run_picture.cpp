#include <gracilis/view/pictures/run_picture.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/core/parallel.hpp>
#include <gracilis/io/suggestions.hpp>
#include <gracilis/io/tables/force_table.hpp>
#include <gracilis/view/pictures/preview.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gracilis {

const std::vector<std::string>& view_names() {
  static const std::vector<std::string> names = {"anterior",      "posterior",     "lateral",      "medial",
                                                 "superior",      "inferior",      "anteromedial", "anterolateral",
                                                 "posteromedial", "posterolateral"};
  return names;
}

Vec3 view_direction(const RecordedRun& run, const std::string& view) {
  const auto left = std::count_if(run.muscles.begin(), run.muscles.end(),
                                  [](const std::string& name) { return name.ends_with("_l"); });
  const bool left_side = 2 * left > static_cast<std::ptrdiff_t>(run.muscles.size());
  const Vec3 lateral = left_side ? Vec3(-run.axes.right()) : run.axes.right();
  Vec3 direction = Vec3::Zero();
  // Longer names begin with "antero" and "postero".
  if (view.starts_with("anter")) direction += run.axes.anterior;
  if (view.starts_with("poster")) direction -= run.axes.anterior;
  if (view.ends_with("lateral")) direction += lateral;
  if (view.ends_with("medial")) direction -= lateral;
  // Not exactly from above: up in the picture then is anterior.
  if (view == "superior") direction = run.axes.superior - 0.001 * run.axes.anterior;
  if (view == "inferior") direction = -run.axes.superior - 0.001 * run.axes.anterior;
  return direction.normalized();
}

std::string pose_caption(const RecordedRun& run, int frame) {
  std::string caption;
  int shown = 0;
  for (Index i = 0; i < run.coordinate_values.cols(); ++i) {
    const Real value = run.coordinate_values(frame, i);
    const bool changed = std::abs(value - run.coordinate_values(0, i)) >= 0.5 && std::abs(value) >= 0.5;
    if (!changed && i != main_coordinate(run)) continue;
    // A whole body has more coordinates than a caption has room.
    if (++shown > 3) return fmt::format("frame {}, {:.2f} s", frame, run.times[static_cast<std::size_t>(frame)]);
    const CoordinateLabel label = coordinate_label(run.coordinates[static_cast<std::size_t>(i)]);
    caption += fmt::format("{}{} {:.0f}{}", caption.empty() ? "" : ", ", label.name, value + 0.0, label.unit);
  }
  return caption.empty() ? fmt::format("frame {}", frame) : caption;
}

/// Of methods whose muscles are under tension.
static void require_forces(const RecordedRun& run, ColorBy color_by) {
  if ((color_by != ColorBy::stress && color_by != ColorBy::tension) || std::filesystem::exists(run.folder / force_file))
    return;
  throw ConfigurationError({run.folder.string(), "", "the run knows no forces",
                            "run the scene again with --set method=tissue, or color by something else"});
}

RunPainter::RunPainter(const RecordedRun& run, RunPictureOptions options) : run_(run), options_(std::move(options)) {
  for (const std::string& name : options_.muscles) {
    if (std::find(run.muscles.begin(), run.muscles.end(), name) != run.muscles.end()) continue;
    throw ConfigurationError(
        {run.folder.string(), "", "the run has no muscle '" + name + "'", suggestion(name, run.muscles)});
  }
  if (options_.color_by == ColorBy::fiber_strain || options_.color_by == ColorBy::tension) options_.fibers = true;
  require_forces(run, options_.color_by);
  for (const std::string& bone : run.bones) bones_.push_back(recorded_surface(run, bone, 0));
  if (options_.color_by == ColorBy::bone_gap)
    for (const TriangleMesh& bone : bones_) distances_.emplace_back(bone);
  if (options_.color_by == ColorBy::tension) tensions_ = recorded_tensions(run);
  for (const std::string& muscle : run.muscles) {
    if (options_.color_by == ColorBy::edge_stretch) stretches_.emplace_back(recorded_surface(run, muscle, 0));
    if (options_.fibers) lengths_.push_back(polyline_lengths(recorded_fibers(run, muscle, 0)));
  }
}

bool RunPainter::shown(const std::string& muscle) const {
  return options_.muscles.empty() ||
         std::find(options_.muscles.begin(), options_.muscles.end(), muscle) != options_.muscles.end();
}

/// A measure of one muscle in one frame; nan when the run does not have it.
static Real measured(const RecordedRun& run, const std::string& measure, int frame, std::size_t muscle) {
  const Eigen::MatrixXd values = measure_of(run, measure);
  return values.size() == 0 ? std::nan("") : values(frame, static_cast<Index>(muscle));
}

Points RunPainter::vertex_colors(std::size_t muscle, const TriangleMesh& mesh, int frame) const {
  const ColorScale& scale = color_scale(options_.color_by);
  Points colors(3, mesh.vertex_count());
  const auto all = [&](Real value) { colors.colwise() = color_at(scale, value); };
  switch (options_.color_by) {
    case ColorBy::muscle:
      return Points(3, 0);
    case ColorBy::activation:
      all(measured(run_, "activation", frame, muscle));
      break;
    case ColorBy::volume:
      all(measured(run_, "volume_ratio", frame, muscle) - 1);
      break;
    case ColorBy::stress: {
      const Eigen::VectorXd stresses = recorded_fiber_stresses(run_, run_.muscles[muscle], frame);
      for (Index v = 0; v < colors.cols(); ++v)
        colors.col(v) = color_at(scale, v < stresses.size() ? std::log10(std::max(1.0, stresses[v])) : std::nan(""));
      break;
    }
    case ColorBy::tension:
    case ColorBy::fiber_strain:
      colors.colwise() = Color::Constant(0.8);
      break;
    case ColorBy::edge_stretch: {
      const std::vector<Real> ratios = stretches_[muscle].of(mesh.vertices);
      for (Index v = 0; v < colors.cols(); ++v)
        colors.col(v) = color_at(scale, std::log2(ratios[static_cast<std::size_t>(v)]));
      break;
    }
    case ColorBy::bone_gap: {
      std::vector<RigidTransform> to_rest;
      for (std::size_t b = 0; b < bones_.size(); ++b)
        to_rest.push_back(
            rigid_motion(bones_[b].vertices, recorded_surface(run_, run_.bones[b], frame).vertices).inverse());
      parallel_for(mesh.vertex_count(), 256, [&](Index begin, Index end) {
        for (Index v = begin; v < end; ++v) {
          Real gap = scale.high;
          for (std::size_t b = 0; b < distances_.size(); ++b)
            gap = std::min(gap, distances_[b].query(to_rest[b] * mesh.vertices.col(v), scale.high).distance);
          colors.col(v) = color_at(scale, gap);
        }
      });
    }
  }
  return colors;
}

PaintedLines RunPainter::fibers(std::size_t muscle, int frame) const {
  PaintedLines painted;
  painted.lines = recorded_fibers(run_, run_.muscles[muscle], frame);
  painted.color = Color(0.45, 0.08, 0.08);
  painted.radius = 0.0006;
  if (options_.color_by == ColorBy::tension && frame < tensions_[muscle].rows())
    for (const Real tension : tensions_[muscle].row(frame))
      painted.colors.push_back(color_at(color_scale(ColorBy::tension), std::log10(std::max(1e-9, tension))));
  if (options_.color_by != ColorBy::fiber_strain) return painted;
  const std::vector<Real> lengths = polyline_lengths(painted.lines);
  for (std::size_t i = 0; i < std::min(lengths.size(), lengths_[muscle].size()); ++i)
    painted.colors.push_back(color_at(color_scale(ColorBy::fiber_strain), std::log2(lengths[i] / lengths_[muscle][i])));
  return painted;
}

Panel RunPainter::panel(int frame) const {
  Panel panel;
  panel.looking = -view_direction(run_, options_.view);
  panel.up = run_.axes.superior;
  panel.caption = pose_caption(run_, frame);
  // Beside colors that mean something bones step back.
  const Color bone = options_.color_by == ColorBy::muscle ? bone_color() : Color(0.72, 0.74, 0.75);
  for (const std::string& name : run_.bones) panel.surfaces.push_back({"", recorded_surface(run_, name, frame), bone});
  for (std::size_t m = 0; m < run_.muscles.size(); ++m) {
    if (!shown(run_.muscles[m])) continue;
    std::string name = options_.color_by == ColorBy::muscle ? run_.muscles[m] : "";
    std::replace(name.begin(), name.end(), '_', ' ');
    PaintedSurface surface{name, recorded_surface(run_, run_.muscles[m], frame),
                           muscle_color(static_cast<Index>(m), options_.palette)};
    surface.opacity = options_.fibers ? std::min(options_.opacity, 0.3) : options_.opacity;
    surface.colors = vertex_colors(m, surface.mesh, frame);
    panel.surfaces.push_back(std::move(surface));
    if (options_.fibers) panel.lines.push_back(fibers(m, frame));
  }
  return panel;
}

std::vector<int> telling_frames(const RecordedRun& run) {
  std::vector<Pose> poses(static_cast<std::size_t>(run.frame_count));
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Eigen::VectorXd row = run.coordinate_values.row(static_cast<Index>(i));
    poses[i].coordinates.assign(row.begin(), row.end());
  }
  return preview_frames(poses, run.frame_count);
}

Points RunPainter::room() const {
  std::vector<Points> parts;
  std::vector<std::string> names = run_.bones;
  for (const std::string& muscle : run_.muscles)
    if (shown(muscle)) names.push_back(muscle);
  const int step = std::max(1, run_.frame_count / 12);
  for (int frame = 0; frame < run_.frame_count; frame += step)
    for (const std::string& name : names) parts.push_back(recorded_surface(run_, name, frame).vertices);
  return join(parts).points;
}

Picture run_picture(const std::vector<RecordedRun>& runs, const std::vector<RunPainter>& painters,
                    const std::vector<int>& frames, const RunPictureOptions& options) {
  Picture picture;
  picture.columns =
      runs.size() > 1 && frames.size() == 1 ? static_cast<int>(runs.size()) : static_cast<int>(frames.size());
  picture.scale_bar = true;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    for (const int frame : frames) {
      Panel panel = painters[r].panel(nearest_pose(runs[0], frame, runs[r]));
      if (runs.size() > 1) panel.caption = runs[r].folder.filename().string() + ": " + panel.caption;
      picture.panels.push_back(std::move(panel));
    }
  }
  const ColorScale& scale = color_scale(options.color_by);
  if (!scale.colors.empty()) picture.color_bar = ColorBar{scale.title, scale.colors, scale.ticks};
  return picture;
}

}  // namespace gracilis
