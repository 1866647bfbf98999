#include <gracilis/io/scene/line_path_reader.hpp>

#include <gracilis/anatomy/joints/joint_pose.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>

namespace gracilis {

static RigidTransform frame_of(TomlReader& table, const std::string& place) {
  const Vec3 angles = table.vector("orientation_xyz_rad").value_or(Vec3::Zero());
  RigidTransform frame = RigidTransform::Identity();
  frame.translation() = table.required_vector(place).value_or(Vec3::Zero()) / 1000;
  frame.linear() = (Eigen::AngleAxisd(angles.x(), Vec3::UnitX()) * Eigen::AngleAxisd(angles.y(), Vec3::UnitY()) *
                    Eigen::AngleAxisd(angles.z(), Vec3::UnitZ()))
                       .toRotationMatrix();
  return frame;
}

/// x = { coordinate = "knee_angle_r", curve_deg = [[at, mm, mm per degree], ...] }, or curve_mm, or { mm = 3 }.
static void read_component(TomlReader table, std::string& coordinate, HermiteCurve& curve) {
  if (const std::optional<Real> value = table.number("mm")) curve = {{0}, {*value / 1000}, {0}};
  coordinate = table.text("coordinate").value_or("");
  for (const auto& [key, unit] : {std::pair{"curve_deg", radians(1)}, std::pair{"curve_mm", 0.001}}) {
    const std::optional<Eigen::MatrixXd> rows = table.rows(key, 3);
    if (!rows) continue;
    for (Eigen::Index i = 0; i < rows->rows(); ++i) {
      curve.knots.push_back((*rows)(i, 0) * unit);
      curve.values.push_back((*rows)(i, 1) / 1000);
      curve.slopes.push_back((*rows)(i, 2) / 1000 / unit);
    }
    if (!std::is_sorted(curve.knots.begin(), curve.knots.end()))
      table.add_problem(key, std::string("the places of '") + key + "' fall");
  }
  if (curve.knots.empty()) {
    Problem problem = table.place();
    problem.what = "a component of a moving point has no value";
    problem.remedy = "give 'mm', or 'coordinate' with 'curve_deg' or 'curve_mm'";
    table.add_problem(problem);
  }
  table.reject_unknown_keys();
}

static LinePoint read_point(TomlReader table, std::string& body, std::array<std::string, 4>& coordinates) {
  LinePoint point;
  body = table.required_text("body");
  point.moving = table.has("x") || table.has("y") || table.has("z");
  if (!point.moving) {
    point.place = table.required_vector("point_mm").value_or(Vec3::Zero()) / 1000;
  } else {
    point.frame = frame_of(table, "frame_mm");
    const char* names[3] = {"x", "y", "z"};
    for (std::size_t i = 0; i < 3; ++i)
      if (std::optional<TomlReader> component = table.table(names[i]))
        read_component(std::move(*component), coordinates[i + 1], point.moves_to[i]);
  }
  coordinates[0] = table.text("condition").value_or("");
  for (const auto& [key, unit] : {std::pair{"range_deg", radians(1)}, std::pair{"range_mm", 0.001}})
    if (const std::optional<Eigen::Vector2d> range = table.pair(key)) {
      point.range_min = range->x() * unit;
      point.range_max = range->y() * unit;
    }
  if (coordinates[0].empty() != !(table.has("range_deg") || table.has("range_mm")))
    table.add_problem("condition", "'condition' and 'range_deg' (or 'range_mm') need each other");
  table.reject_unknown_keys();
  return point;
}

/// The number of one of `names`, of which there are several; adds a problem when `text` is none of them.
template <class Names>
static int named(TomlReader& table, const char* key, const std::string& text, const Names& names) {
  const auto found = std::find(names.begin(), names.end(), text);
  if (found != names.end()) return static_cast<int>(found - names.begin());
  const auto last = std::prev(names.end());
  table.add_problem(key,
                    fmt::format("'{}' must be \"{}\" or \"{}\"", key, fmt::join(names.begin(), last, "\", \""), *last));
  return 0;
}

static PlacedWrap read_wrap(TomlReader table, std::string& body) {
  PlacedWrap wrap;
  body = table.required_text("body");
  WrapSurface& surface = wrap.surface;
  surface.kind = static_cast<WrapSurface::Kind>(named(table, "kind", table.required_text("kind"), wrap_kind_names));
  wrap.frame = frame_of(table, "center_mm");
  surface.radius = table.number("radius_mm", {0, 1e9}).value_or(0) / 1000;
  surface.length = table.number("length_mm", {0, 1e12}).value_or(0) / 1000;
  surface.radii = table.vector("radii_mm").value_or(Vec3::Zero()) / 1000;
  surface.ring_radius = table.number("ring_radius_mm", {0, 1e9}).value_or(0) / 1000;
  surface.hand = static_cast<int>(table.number("hand", {-1, 1}).value_or(0));
  const std::string side = table.text("side").value_or("");
  if (!side.empty()) {
    if (side.size() != 2 || (side[0] != '+' && side[0] != '-') || side[1] < 'x' || side[1] > 'z')
      table.add_problem("side", "'side' must be \"+x\", \"-x\", \"+y\", \"-y\", \"+z\" or \"-z\"");
    surface.side_axis = std::clamp(side.back() - 'x', 0, 2);
    surface.side_sign = side[0] == '-' ? -1 : 1;
  }
  if (const std::optional<std::string> plane = table.text("plane"))
    wrap.plane = static_cast<WrapSurface::Plane>(named(table, "plane", *plane, wrap_plane_names));
  wrap.first_point = static_cast<int>(table.number("first_point", {0, 1e6}).value_or(0));
  wrap.last_point = static_cast<int>(table.number("last_point", {0, 1e6}).value_or(1e6));
  table.reject_unknown_keys();
  return wrap;
}

LinePathDescription read_line_path(TomlReader& line) {
  LinePathDescription description;
  for (TomlReader& point : line.tables("path")) {
    description.point_bodies.emplace_back();
    description.coordinates.emplace_back();
    description.path.points.push_back(
        read_point(std::move(point), description.point_bodies.back(), description.coordinates.back()));
  }
  for (TomlReader& wrap : line.tables("wraps")) {
    description.wrap_bodies.emplace_back();
    description.path.wraps.push_back(read_wrap(std::move(wrap), description.wrap_bodies.back()));
  }
  return description;
}

LinePath place_line_path(const LinePathDescription& description, const Scene& scene,
                         const std::function<Index(const std::string&)>& body_index) {
  LinePath path = description.path;
  const std::vector<std::string> names = coordinate_names(scene);
  const std::vector<Real> capture = capture_coordinates(scene);
  const auto find = [&](const std::string& name) {
    LineCoordinate coordinate;
    const auto found = static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
    if (found < names.size()) coordinate = {static_cast<Index>(found), capture[found]};
    return coordinate;
  };
  for (std::size_t i = 0; i < path.points.size(); ++i) {
    LinePoint& point = path.points[i];
    point.body = body_index(description.point_bodies[i]);
    point.condition = find(description.coordinates[i][0]);
    for (std::size_t k = 0; k < 3; ++k) point.moves_with[k] = find(description.coordinates[i][k + 1]);
  }
  for (std::size_t i = 0; i < path.wraps.size(); ++i) path.wraps[i].body = body_index(description.wrap_bodies[i]);
  return path;
}

}  // namespace gracilis
