#include <gracilis/view/pictures/run_picture.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/core/parallel.hpp>
#include <gracilis/core/words_of_name.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/rotations.hpp>
#include <gracilis/geometry/topology.hpp>
#include <gracilis/io/suggestions.hpp>
#include <gracilis/io/tables/force_table.hpp>
#include <gracilis/view/pictures/muscle_colors.hpp>
#include <gracilis/view/pictures/pose_caption.hpp>
#include <gracilis/view/pictures/preview.hpp>
#include <gracilis/view/pictures/recorded_look.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>

namespace gracilis {

const std::vector<std::string>& view_names() {
  static const std::vector<std::string> names = {"anterior",      "posterior",     "lateral",      "medial",
                                                 "superior",      "inferior",      "anteromedial", "anterolateral",
                                                 "posteromedial", "posterolateral"};
  return names;
}

/// Whether most muscles are named for the left.
static bool is_left_sided(const RecordedRun& run) {
  const auto left = std::count_if(run.muscles.begin(), run.muscles.end(),
                                  [](const std::string& name) { return name.ends_with("_l"); });
  return 2 * left > static_cast<std::ptrdiff_t>(run.muscles.size());
}

Vec3 view_direction(const RecordedRun& run, const std::string& view) {
  const Vec3 lateral = is_left_sided(run) ? Vec3(-run.axes.right()) : run.axes.right();
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

/// Where the preview looks, unless another view is named.
static CameraDirection view_of(const RecordedRun& run, const std::string& view) {
  const bool known = run.preview_looking.cross(run.preview_up).norm() > 0.1;
  if (view.empty() && known) return {run.preview_looking.normalized(), run.preview_up.normalized()};
  return {-view_direction(run, view.empty() ? "lateral" : view), run.axes.superior};
}

static CameraDirection camera_of(const RecordedRun& run, const RunPictureOptions& options) {
  CameraDirection camera = view_of(run, options.view);
  if (options.turn == 0 && options.tilt == 0) return camera;
  camera.looking = Eigen::AngleAxisd(options.turn, camera.up) * camera.looking;
  const Vec3 right = camera.looking.cross(camera.up).normalized();
  const Eigen::AngleAxisd rising(-options.tilt, right);
  return {rising * camera.looking, rising * camera.up};
}

/// Of methods whose muscles are under tension.
static void require_forces(const RecordedRun& run, ColorBy color_by) {
  if ((color_by != ColorBy::stress && color_by != ColorBy::tension) || std::filesystem::exists(run.folder / force_file))
    return;
  throw ConfigurationError({run.folder.string(), "", "the run knows no forces",
                            "run the scene again with --set method=tissue, or color by something else"});
}

RunPainter::RunPainter(const RecordedRun& run, RunPictureOptions options)
    : run_(run), options_(std::move(options)), captions_(captioned_frames(run)) {
  find_focus();
  require_names();
  if (options_.color_by == ColorBy::fiber_strain || options_.color_by == ColorBy::tension) options_.fibers = true;
  require_forces(run, options_.color_by);
  for (const std::string& bone : run.bones) bones_.push_back(recorded_surface(run, bone, 0));
  if (options_.color_by == ColorBy::bone_gap)
    for (const TriangleMesh& bone : bones_) distances_.emplace_back(bone);
  if (options_.arrow_scale > 0) arrows_.emplace(run, options_.arrow_scale);
  if (options_.color_by == ColorBy::tension) tensions_ = recorded_tensions(run);
  for (const std::string& muscle : run.muscles) {
    if (options_.color_by == ColorBy::natural) looks_.push_back(recorded_look(run, muscle));
    if (evens()) evened_.emplace_back(recorded_surface(run, muscle, 0));
    if (options_.color_by == ColorBy::edge_stretch) stretches_.emplace_back(recorded_surface(run, muscle, 0));
    if (options_.fibers) lengths_.push_back(polyline_lengths(recorded_fibers(run, muscle, 0)));
  }
  // Surfaces stay as closed as they were recorded first.
  for (const std::vector<std::string>* all : {&run.bones, &run.muscles})
    for (const std::string& name : *all)
      if (const TriangleMesh mesh = recorded_surface(run, name, 0);
          is_closed(mesh.faces) && enclosed_volume(mesh.vertices, mesh.faces) > 0)
        solids_.insert(name);
}

static bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

void RunPainter::require_names() const {
  std::vector<std::string> all = run_.muscles;
  all.insert(all.end(), run_.bones.begin(), run_.bones.end());
  const auto require = [&](const std::string& name, const std::vector<std::string>& known, const char* what) {
    if (contains(known, name)) return;
    throw ConfigurationError(
        {run_.folder.string(), "", fmt::format("the run has no {} '{}'", what, name), suggestion(name, known)});
  };
  for (const std::string& name : options_.muscles) require(name, run_.muscles, "muscle");
  for (const std::string& name : options_.bones) require(name, run_.bones, "bone");
  for (const std::string& name : options_.hidden) require(name, all, "muscle or bone");
  if (!focus_.empty()) require(focus_, all, "muscle or bone");
}

/// "psoas_r:insertion" is what is attached there.
void RunPainter::find_focus() {
  focus_ = options_.focus;
  for (const auto& [row, end] : {std::pair{0, ":origin"}, {1, ":insertion"}}) {
    if (!focus_.ends_with(end)) continue;
    focus_.resize(focus_.size() - std::strlen(end));
    if (!contains(run_.muscles, focus_)) return;
    const Points tissue = recorded_tissue(run_, focus_);
    for (Index v = 0; v < tissue.cols(); ++v)
      if (tissue(row, v) > 0.5) focus_end_.push_back(v);
    if (focus_end_.empty())
      throw ConfigurationError(
          {run_.folder.string(), "", fmt::format("{} has no {}", focus_, end + 1), "focus on " + focus_});
    return;
  }
}

Points RunPainter::framed_points(const std::string& name, int frame) const {
  const Points all = recorded_surface(run_, name, frame).vertices;
  return focus_end_.empty() ? all : Points(all(Eigen::all, focus_end_));
}

std::vector<std::string> RunPainter::framed_names() const {
  std::vector<std::string> names;
  for (const std::vector<std::string>* all : {&run_.bones, &run_.muscles})
    for (const std::string& name : *all)
      if (shown(name) && framed(name)) names.push_back(name);
  return names;
}

Real RunPainter::extent() const {
  Eigen::AlignedBox3d box;
  for (const std::string& name : framed_names()) box.extend(bounding_box(framed_points(name, 0)));
  return box.isEmpty() ? 0 : box.diagonal().norm() / options_.zoom;
}

bool RunPainter::shown(const std::string& name) const {
  if (contains(options_.hidden, name)) return false;
  const bool is_bone = contains(run_.bones, name);
  if (is_bone && options_.without_bones) return false;
  const std::vector<std::string>& chosen = is_bone ? options_.bones : options_.muscles;
  // Seen from the middle, the body's other half would stand before all that is looked at.
  const bool other_side = name.ends_with(is_left_sided(run_) ? "_r" : "_l");
  if (chosen.empty() && other_side && options_.view.ends_with("medial")) return false;
  return chosen.empty() || contains(chosen, name);
}

/// By the scale, and remembered for what its bar says.
Color RunPainter::color_of(Real value) const {
  if (std::isfinite(value)) seen_ = {std::min(seen_.first, value), std::max(seen_.second, value)};
  return color_at(color_scale(options_.color_by), value);
}

/// A measure of one muscle in one frame; nan when the run does not have it.
static Real measured(const RecordedRun& run, const std::string& measure, int frame, std::size_t muscle) {
  const Eigen::MatrixXd values = measure_of(run, measure);
  return values.size() == 0 ? std::nan("") : values(frame, static_cast<Index>(muscle));
}

Points RunPainter::vertex_colors(std::size_t muscle, const TriangleMesh& mesh, int frame) const {
  const ColorScale& scale = color_scale(options_.color_by);
  Points colors(3, mesh.vertex_count());
  const auto all = [&](Real value) { colors.colwise() = color_of(value); };
  switch (options_.color_by) {
    case ColorBy::natural:
      return natural_colors(looks_[muscle], run_.muscles[muscle]);
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
        colors.col(v) = color_of(v < stresses.size() ? std::log10(std::max(1.0, stresses[v])) : std::nan(""));
      break;
    }
    case ColorBy::tension:
    case ColorBy::fiber_strain:
      colors.colwise() = flesh_color();
      break;
    case ColorBy::edge_stretch: {
      const std::vector<Real> ratios = stretches_[muscle].of(mesh.vertices);
      for (Index v = 0; v < colors.cols(); ++v)
        colors.col(v) = color_of(std::log2(ratios[static_cast<std::size_t>(v)]));
      break;
    }
    case ColorBy::bone_gap: {
      std::vector<RigidTransform> to_rest;
      for (std::size_t b = 0; b < bones_.size(); ++b)
        to_rest.push_back(
            rigid_motion(bones_[b].vertices, recorded_surface(run_, run_.bones[b], frame).vertices).inverse());
      Eigen::VectorXd gaps = Eigen::VectorXd::Constant(mesh.vertex_count(), scale.high);
      parallel_for(mesh.vertex_count(), 256, [&](Index begin, Index end) {
        for (Index v = begin; v < end; ++v)
          for (std::size_t b = 0; b < distances_.size(); ++b)
            gaps[v] = std::min(gaps[v], distances_[b].query(to_rest[b] * mesh.vertices.col(v), scale.high).distance);
      });
      for (Index v = 0; v < gaps.size(); ++v) colors.col(v) = color_of(gaps[v]);
    }
  }
  return colors;
}

PaintedLines RunPainter::fibers(std::size_t muscle, int frame) const {
  PaintedLines painted;
  painted.lines = recorded_fibers(run_, run_.muscles[muscle], frame);
  painted.color =
      options_.color_by == ColorBy::natural ? fiber_paint(run_.muscles[muscle]) : muscle_color(run_.muscles[muscle]);
  painted.radius = 0.0006;
  painted.fades = true;
  if (options_.color_by == ColorBy::tension && frame < tensions_[muscle].rows())
    for (const Real tension : tensions_[muscle].row(frame))
      painted.colors.push_back(color_of(std::log10(std::max(1e-9, tension))));
  if (options_.color_by != ColorBy::fiber_strain) return painted;
  const std::vector<Real> lengths = polyline_lengths(painted.lines);
  for (std::size_t i = 0; i < std::min(lengths.size(), lengths_[muscle].size()); ++i)
    painted.colors.push_back(color_of(std::log2(lengths[i] / lengths_[muscle][i])));
  return painted;
}

Panel RunPainter::panel(int frame) const {
  Panel panel;
  const CameraDirection camera = camera_of(run_, options_);
  panel.looking = camera.looking;
  panel.up = camera.up;
  panel.has_own_camera = !options_.focus.empty();  // what is in focus moves from pose to pose, and is looked at in each
  panel.caption = pose_caption(captions_, frame);
  // Beside colors that mean something bones step back; lines have a gray middle, so there gray would say "as at rest".
  const bool of_lines = options_.color_by == ColorBy::fiber_strain || options_.color_by == ColorBy::tension;
  const Color bone = shows_values() && !of_lines ? Color(0.72, 0.74, 0.75) : bone_color();
  for (const std::string& name : run_.bones)
    if (shown(name)) {
      panel.surfaces.push_back({"", recorded_surface(run_, name, frame), bone, 1, framed(name) && focus_end_.empty()});
      panel.surfaces.back().solid = solids_.contains(name);
    }
  for (std::size_t m = 0; m < run_.muscles.size(); ++m) {
    if (!shown(run_.muscles[m])) continue;
    const std::string name = options_.color_by == ColorBy::muscle ? words_of_name(run_.muscles[m]) : "";
    PaintedSurface surface{name, recorded_surface(run_, run_.muscles[m], frame), muscle_color(run_.muscles[m])};
    surface.framed = framed(run_.muscles[m]) && focus_end_.empty();
    surface.solid = solids_.contains(run_.muscles[m]);
    surface.opacity = options_.fibers || draws_arrows() ? std::min(options_.opacity, 0.3) : options_.opacity;
    if (!framed(run_.muscles[m]))
      surface.opacity = std::min(surface.opacity, 0.25);  // the one in focus is seen through
    surface.colors = vertex_colors(m, surface.mesh, frame);
    if (options_.color_by == ColorBy::natural) surface.stripes = looks_[m].stripes;
    std::vector<PaintedSurface> arrows;
    if (arrows_) arrows = arrows_->of(m, surface.mesh, frame);
    if (options_.corrections.times > 0)
      arrows = correction_arrows(run_, run_.muscles[m], surface.mesh.vertices, frame, options_.corrections);
    if (evens()) surface.mesh.vertices = evened_[m].of(surface.mesh.vertices);
    for (PaintedSurface& arrow : arrows) arrow.framed = surface.framed;
    panel.surfaces.push_back(std::move(surface));
    std::move(arrows.begin(), arrows.end(), std::back_inserter(panel.surfaces));
    if (options_.fibers) panel.lines.push_back(fibers(m, frame));
    if (options_.fibers) panel.lines.back().framed = panel.surfaces.back().framed;
  }
  if (!focus_end_.empty()) panel.room = framed_points(focus_, frame);
  return panel;
}

std::vector<int> telling_frames(const RecordedRun& run, int first) {
  std::vector<Pose> poses(static_cast<std::size_t>(run.frame_count - first));
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Eigen::VectorXd row = run.coordinate_values.row(static_cast<Index>(i) + first);
    poses[i].coordinates.assign(row.begin(), row.end());
  }
  std::vector<int> frames = preview_frames(poses, run.frame_count - first);
  for (int& frame : frames) frame += first;
  return frames;
}

Points RunPainter::room(int first) const {
  constexpr int most_frames = 36;
  const std::vector<std::string> names = framed_names();
  const std::vector<int> frames = spread_frames(run_.frame_count - first, most_frames);
  const CameraDirection camera = camera_of(run_, options_);
  const Vec3 right = camera.looking.cross(camera.up).normalized();
  Eigen::Matrix3d axes;
  axes << right, right.cross(camera.looking), camera.looking;
  std::vector<Points> corners(frames.size());
  parallel_for_each(frames.size(), [&](std::size_t i) {
    corners[i].resize(3, 2 * static_cast<Index>(names.size()));
    for (std::size_t n = 0; n < names.size(); ++n) {
      const Points seen = axes.transpose() * framed_points(names[n], first + frames[i]);
      corners[i].col(2 * static_cast<Index>(n)) = seen.rowwise().minCoeff();
      corners[i].col(2 * static_cast<Index>(n) + 1) = seen.rowwise().maxCoeff();
    }
  });
  Points all = join(corners).points;
  if (all.cols() == 0) return all;
  Points room(3, 2);
  room << all.rowwise().minCoeff(), all.rowwise().maxCoeff();
  return axes * room;
}

static ColorBar color_bar_of(const ColorScale& scale, const std::vector<RunPainter>& painters) {
  std::pair<Real, Real> seen = painters.front().values_seen();
  for (const RunPainter& painter : painters)
    seen = {std::min(seen.first, painter.values_seen().first), std::max(seen.second, painter.values_seen().second)};
  return {scale.title, scale.colors, ticks_for(scale, seen)};
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
  if (!scale.colors.empty()) picture.color_bar = color_bar_of(scale, painters);
  picture.zoom = options.zoom;
  return picture;
}

}  // namespace gracilis
