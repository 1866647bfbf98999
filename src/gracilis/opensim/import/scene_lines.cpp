#include <gracilis/opensim/import/scene_lines.hpp>

#include <gracilis/opensim/import/scene_joints.hpp>
#include <gracilis/opensim/import/toml_text.hpp>
#include <gracilis/opensim/paths/muscle_path.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace gracilis::opensim {

static std::string frame_text(const char* place, const RigidTransform& frame) {
  return fmt::format("{} = {}\norientation_xyz_rad = {}\n", place, toml_vector(1000 * frame.translation()),
                     toml_vector(frame.linear().eulerAngles(0, 1, 2)));
}

/// Places at which cubic pieces between them, with the function's slopes, are the function, or hardly differ from it.
static std::vector<Real> knots_of(const Function& function, const Coordinate& coordinate) {
  if (function.kind == Function::Kind::spline || function.kind == Function::Kind::piecewise_linear)
    return function.knots;
  std::vector<Real> knots;
  const int parts = function.kind == Function::Kind::linear ? 1 : 64;
  const Real low = std::max(coordinate.range_min, -10.0), high = std::min(coordinate.range_max, 10.0);
  for (int i = 0; i <= parts; ++i) knots.push_back(low + std::max(high - low, 1e-3) * i / parts);
  return knots;
}

/// Those of them within the coordinate's range, and the range's ends.
static std::vector<Real> places_of(const Function& function, const Coordinate& coordinate) {
  const Real least = coordinate.range_min, most = coordinate.range_max;
  std::vector<Real> places = knots_of(function, coordinate);
  std::erase_if(places, [&](Real place) { return !(place > least && place < most); });
  if (std::isfinite(least)) places.insert(places.begin(), least);
  if (std::isfinite(most) && most > least) places.push_back(most);
  return places;
}

/// Rows of a curve: place, value, slope; of pieces that are straight, both slopes at each bend. Where the coordinate's
/// range ends the curve becomes level: there the point stays.
static std::vector<Vec3> curve_of(const Function& function, const Coordinate& coordinate) {
  const std::vector<Real> places = places_of(function, coordinate);
  std::vector<Vec3> rows;
  const auto add = [&](Real place, Real slope) { rows.emplace_back(place, value(function, {place}), slope); };
  if (std::isfinite(coordinate.range_min)) add(places.front(), 0);
  if (function.kind == Function::Kind::piecewise_linear) {
    for (std::size_t i = 0; i + 1 < places.size(); ++i) {
      const Real left = places[i], right = places[i + 1];
      const Real slope = (value(function, {right}) - value(function, {left})) / (right - left);
      add(left, slope);
      add(right, slope);
    }
  } else {
    for (const Real place : places) add(place, derivative(function, {place}, {0}));
  }
  if (std::isfinite(coordinate.range_max)) add(places.back(), 0);
  return rows;
}

static std::string component_text(const Model& model, const Function& function, Index with, Real otherwise) {
  const auto scene = with < 0 ? std::nullopt : scene_coordinate(model, with);
  if (!scene) return fmt::format("{{ mm = {} }}", 1000 * otherwise);
  const Real unit = scene->translation ? 1000 : degrees(1);
  std::vector<std::string> rows;
  for (const Vec3& row : curve_of(function, model.coordinates[static_cast<std::size_t>(with)]))
    rows.push_back(fmt::format("[{}, {}, {}]", unit * (scene->slope * row[0] + scene->offset), 1000 * row[1],
                               1000 * row[2] / scene->slope / unit));
  if (scene->slope < 0) std::reverse(rows.begin(), rows.end());
  return fmt::format("{{ coordinate = {}, curve_{} = [{}] }}", toml_text(scene->name),
                     scene->translation ? "mm" : "deg", fmt::join(rows, ", "));
}

static std::string condition_text(const Model& model, const PathPoint& point) {
  const auto scene = scene_coordinate(model, point.condition);
  if (!scene) return "";
  const Real unit = scene->translation ? 1000 : degrees(1);
  Real low = scene->slope * point.range_min + scene->offset, high = scene->slope * point.range_max + scene->offset;
  if (scene->slope < 0) std::swap(low, high);
  return fmt::format("condition = {}\nrange_{} = [{}, {}]\n", toml_text(scene->name), scene->translation ? "mm" : "deg",
                     unit * scene_bound(low), unit * scene_bound(high));
}

/// Where no axis of the scene follows a coordinate alone, what depends on it cannot be said.
static void tell_unknown(const Model& model, const Muscle& muscle, const PathPoint& point,
                         std::vector<std::string>& left_out) {
  for (const Index coordinate : {point.condition, point.moves_with[0], point.moves_with[1], point.moves_with[2]})
    if (coordinate >= 0 && !scene_coordinate(model, coordinate))
      left_out.push_back(fmt::format(
          "muscle '{}', point '{}': depends on the coordinate '{}', which no axis of its joint follows alone; "
          "it stays as in the capture pose",
          muscle.name, point.name, model.coordinates[static_cast<std::size_t>(coordinate)].name));
}

static std::string wrap_text(const Model& model, const PlacedWrap& wrap, const std::string& line) {
  const WrapSurface& surface = wrap.surface;
  std::string text = fmt::format(
      "\n[[{}.wraps]]\nkind = \"{}\"\nbody = {}\n{}", line, wrap_kind_names[static_cast<std::size_t>(surface.kind)],
      toml_text(model.bodies[static_cast<std::size_t>(wrap.body)].name), frame_text("center_mm", wrap.frame));
  if (surface.kind == WrapSurface::Kind::ellipsoid)
    text += fmt::format("radii_mm = {}\nplane = \"{}\"\n", toml_vector(1000 * surface.radii),
                        wrap_plane_names[static_cast<std::size_t>(wrap.plane)]);
  else
    text += fmt::format("radius_mm = {}\n", 1000 * surface.radius);
  if (surface.kind == WrapSurface::Kind::cylinder) text += fmt::format("length_mm = {}\n", 1000 * surface.length);
  if (surface.kind == WrapSurface::Kind::torus)
    text += fmt::format("ring_radius_mm = {}\n", 1000 * surface.ring_radius);
  if (surface.hand != 0) text += fmt::format("hand = {}\n", surface.hand);
  if (surface.side_sign != 0)
    text += fmt::format("side = \"{}{}\"\n", surface.side_sign < 0 ? '-' : '+', "xyz"[surface.side_axis]);
  return text + fmt::format("first_point = {}\nlast_point = {}\n", wrap.first_point, wrap.last_point);
}

std::string line_path_text(const Model& model, const Muscle& muscle, const std::vector<RigidTransform>& poses,
                           const Eigen::VectorXd& coordinates, const std::string& line,
                           std::vector<std::string>& left_out) {
  const Path& path = muscle.path;
  const bool stays = std::none_of(path.points.begin(), path.points.end(),
                                  [](const PathPoint& point) { return point.moving || point.condition >= 0; });
  if (stays && path.wraps.empty()) return "";
  std::string text;
  std::vector<PlacedWrap> wraps = placed_wraps(model, path, poses);
  int number = 0;
  for (std::size_t i = 0; i < path.points.size(); ++i, ++number) {
    const PathPoint& point = path.points[i];
    tell_unknown(model, muscle, point, left_out);
    const std::string condition = point.condition < 0 ? "" : condition_text(model, point);
    if (point.condition >= 0 && condition.empty() && !is_active(point, coordinates)) {
      // It is never there, and those behind it are counted without it.
      for (PlacedWrap& wrap : wraps)
        for (int* end : {&wrap.first_point, &wrap.last_point})
          if (*end > number || (*end == number && end == &wrap.last_point)) --*end;
      --number;
      continue;
    }
    const auto body = static_cast<std::size_t>(point.body);
    text += fmt::format("\n[[{}.path]]\nbody = {}\n", line, toml_text(model.bodies[body].name)) + condition;
    const Vec3 location = location_of(model, point, coordinates);
    if (!point.moving) {
      text += fmt::format("point_mm = {}\n", toml_vector(1000 * (poses[body] * location)));
      continue;
    }
    text += frame_text("frame_mm", poses[body]);
    const char* names[3] = {"x", "y", "z"};
    for (std::size_t k = 0; k < 3; ++k)
      text += fmt::format(
          "{} = {}\n", names[k],
          component_text(model, point.moves_to[k], point.moves_with[k], location[static_cast<Eigen::Index>(k)]));
  }
  for (const PlacedWrap& wrap : wraps) text += wrap_text(model, wrap, line);
  return text;
}

}  // namespace gracilis::opensim
