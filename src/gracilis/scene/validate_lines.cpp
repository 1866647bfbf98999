#include <gracilis/scene/validate_lines.hpp>

#include <gracilis/scene/section_line.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>

namespace gracilis {
namespace {

struct LineValidation {
  const Scene& scene;
  std::vector<Problem> problems;

  void add(const std::string& where, const std::string& what, const std::string& remedy = "") {
    problems.push_back({"", where, what, remedy});
  }

  void check_body(const std::string& where, Index body) {
    if (body < 0 || body >= static_cast<Index>(scene.bodies.size()))
      add(where, "refers to body number " + std::to_string(body) + ", which does not exist");
  }

  void check_coordinate(const std::string& where, const LineCoordinate& coordinate) {
    Index count = 0;
    for (const Joint& joint : scene.joints) count += static_cast<Index>(joint.axes.size());
    if (coordinate.index >= count || !std::isfinite(coordinate.capture))
      add(where, "its line depends on a coordinate that does not exist");
  }

  void check_path(const std::string& where, const LinePath& path) {
    if (path.points.size() == 1) add(where, "its line has a path of one point", "give two or more, or none");
    for (const LinePoint& point : path.points) {
      check_body(where, point.body);
      check_coordinate(where, point.condition);
      for (const LineCoordinate& coordinate : point.moves_with) check_coordinate(where, coordinate);
      bool finite = point.place.allFinite() && point.frame.matrix().allFinite();
      for (const HermiteCurve& curve : point.moves_to) {
        const auto sound = [](Real x) { return std::isfinite(x); };
        for (const auto* numbers : {&curve.knots, &curve.values, &curve.slopes})
          finite =
              finite && numbers->size() == curve.knots.size() && std::all_of(numbers->begin(), numbers->end(), sound);
        finite = finite && std::is_sorted(curve.knots.begin(), curve.knots.end());
      }
      if (!finite) add(where, "a point of its line has no place", "correct [[muscles.action_line.path]]");
    }
    for (const PlacedWrap& wrap : path.wraps) {
      check_body(where, wrap.body);
      const WrapSurface& s = wrap.surface;
      const bool ellipsoid = s.kind == WrapSurface::Kind::ellipsoid, torus = s.kind == WrapSurface::Kind::torus;
      const Real least = ellipsoid ? s.radii.minCoeff()
                         : torus   ? std::min(s.radius, s.ring_radius - s.radius)
                                   : s.radius;
      if (!wrap.frame.matrix().allFinite() || !(least > 0) || !s.radii.allFinite())
        add(where, "a surface that its line runs around has no size", "correct [[muscles.action_line.wraps]]");
    }
  }

  /// Whether the line has points to run through.
  bool check_points(const std::string& where, const ActionLine& line) {
    for (const Index body : line.bodies) check_body(where, body);
    check_path(where, line.path);
    if (line.points.allFinite() && line.points.cols() >= 2 &&
        line.points.cols() == static_cast<Index>(line.bodies.size()) && line.scaling >= 0 && line.scaling <= 16)
      return true;
    add(where, "its action line needs two points or more with a body each", "correct [muscles.action_line]");
    return false;
  }

  /// How many sections a sheet has; 0 where its heads do not say.
  std::int64_t check_heads(const std::string& where, const ActionLine& sheet) {
    if (sheet.heads.size() < 2) add(where, "a sheet needs the lines of two heads or more");
    if (sheet.side < 1 || 2 * sheet.side > sheet.rays - 4)
      add(where, "its sections need a part or more along each side, and two corners or more around each edge",
          "correct 'side' and 'rays' of [muscles.action_line]");
    bool sound = !sheet.heads.empty();
    const std::size_t sections = sound ? sheet.heads[0].shares.size() : 0;
    for (const ActionLine& head : sheet.heads) {
      sound = check_points(where + ", head '" + head.name + "'", head) && sound;
      if (head.shares.size() == sections && head.heads.empty() && are_shares(head.shares)) continue;
      add(where, "its heads need ascending shares from 0 to 1, as many each, two or more",
          "correct 'shares' of [[muscles.action_line.heads]]");
      sound = false;
    }
    return sound ? static_cast<std::int64_t>(sections) : 0;
  }

  /// The same of a line.
  static std::int64_t made_sections(const ActionLine& line, std::int64_t vertices) {
    const std::int64_t sections = section_count(line);
    const bool counted = !line.tendon_sections || !line.shares.empty() || line.rays * sections + 2 > vertices;
    return counted ? sections : section_line(line).centers.cols();
  }

  /// The surface must have as many vertices as its sections ask for.
  void check_line(const std::string& where, const Muscle& muscle) {
    const ActionLine& line = muscle.action_line;
    if (line.rays < 6 || line.rays % 2 != 0) add(where, "its sections must have an even number of corners, 6 or more");
    const std::int64_t vertices = muscle.surface.vertex_count();
    if (line.heads.empty() && !line.shares.empty() && !are_shares(line.shares))
      add(where, "its sections need ascending shares from 0 to 1, two or more", "correct [muscles.action_line]");
    const std::int64_t sections = !line.heads.empty()         ? check_heads(where, line)
                                  : check_points(where, line) ? made_sections(line, vertices)
                                                              : 0;
    if (sections == 0) return;
    if (vertices != line.rays * sections + 2)
      add(where,
          "its surface has " + std::to_string(vertices) + " vertices; " + std::to_string(sections) +
              " sections and two ends have " + std::to_string(line.rays * sections + 2),
          "give the surface that was made for this line");
    if (line.centers.cols() > 0 && (line.centers.cols() != sections || !line.centers.allFinite()))
      add(where,
          "its action line has " + std::to_string(line.centers.cols()) + " centers for " + std::to_string(sections) +
              " sections",
          "give one for each, or none");
  }
};

}  // namespace

std::vector<Problem> line_problems(const Scene& scene) {
  LineValidation validation{scene, {}};
  for (const Muscle& muscle : scene.muscles)
    if (muscle.action_line.rays > 0) validation.check_line("muscle '" + muscle.name + "'", muscle);
  return validation.problems;
}

}  // namespace gracilis
