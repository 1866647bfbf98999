#include <gracilis/anatomy/fibers/superficial_fibers.hpp>

#include <gracilis/anatomy/fibers/inner_fibers.hpp>
#include <gracilis/geometry/nearest_triangle.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

namespace gracilis {

namespace {

constexpr Index pieces_per_span = 16;
constexpr Real least_gap = 1e-3;  ///< between the places of neighboring lines

/// Per section the place a of a line across the muscle, where it passes it.
std::vector<std::optional<Real>> places_of(const Points& line, const Muscle& muscle, const Eigen::VectorXd& field,
                                           const NearestTriangle& surface, const Sections& sections) {
  const Points smooth = centripetal_spline(line, pieces_per_span);
  std::vector<Real> values;
  for (Index i = 0; i < smooth.cols(); ++i) {
    const NearestPoint found = surface.query(smooth.col(i));
    Real value = 0;
    for (int k = 0; k < 3; ++k) value += found.barycentric[k] * field[muscle.surface.faces(k, found.face)];
    values.push_back(value);
  }
  std::vector<std::optional<Real>> places(sections.maps.size());
  for (std::size_t s = 0; s < places.size(); ++s) {
    const Real level = sections.levels[s];
    for (std::size_t i = 1; i < values.size() && !places[s]; ++i) {
      if ((values[i - 1] < level) == (values[i] < level)) continue;
      const Real share = (level - values[i - 1]) / (values[i] - values[i - 1]);
      const auto column = static_cast<Index>(i);
      places[s] =
          sections.maps[s].nearest(smooth.col(column - 1) + share * (smooth.col(column) - smooth.col(column - 1))).x();
    }
  }
  return places;
}

/// What is missing takes the value of the nearest section that has one. False when none has.
bool fill_gaps(std::vector<std::optional<Real>>& places) {
  std::optional<Real> last;
  const auto visit = [&](std::optional<Real>& place) {
    if (place) {
      last = place;
    } else {
      place = last;
    }
  };
  std::for_each(places.begin(), places.end(), visit);
  std::for_each(places.rbegin(), places.rend(), visit);
  return last.has_value();
}

/// The course that leads every start between its two lines, per section.
class Course {
 public:
  explicit Course(const std::vector<std::vector<Real>>& places) {
    const std::size_t sections = places[0].size();
    std::vector<Real> labels(places.size());
    for (std::size_t line = 0; line < places.size(); ++line)
      labels[line] = std::accumulate(places[line].begin(), places[line].end(), Real{0}) / Real(sections);
    std::vector<std::size_t> order(places.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return labels[a] < labels[b]; });
    curves_.resize(sections);
    for (std::size_t s = 0; s < sections; ++s) {
      Points knots(3, static_cast<Index>(places.size()) + 2);  // label, place, 0
      knots.col(0).setZero();
      Index count = 1;
      for (const std::size_t line : order) {
        // Lines that cross or touch in a section keep their order all the same.
        const Vec3 before = knots.col(count - 1);
        if (labels[line] < before.x() + least_gap || labels[line] > 1 - least_gap) continue;
        knots.col(count++) = Vec3(labels[line], std::clamp(places[line][s], before.y() + least_gap, 1 - least_gap), 0);
      }
      knots.col(count++) = Vec3(1, 1, 0);
      curves_[s] = centripetal_spline(knots.leftCols(count), pieces_per_span);
    }
  }

  Eigen::Vector2d at(const Eigen::Vector2d& start, std::size_t section) const {
    const Points& curve = curves_[section];
    for (Index i = 1; i < curve.cols(); ++i) {
      if (curve(0, i) < start.x()) continue;
      const Real width = curve(0, i) - curve(0, i - 1);
      const Real share = width > 0 ? (start.x() - curve(0, i - 1)) / width : 0;
      const Real place = curve(1, i - 1) + share * (curve(1, i) - curve(1, i - 1));
      return {std::clamp(place, Real{0.01}, Real{0.99}), start.y()};
    }
    return start;
  }

 private:
  std::vector<Points> curves_;  ///< per section: place over label
};

}  // namespace

Polylines filled_between(const Muscle& muscle, const Polylines& lines) {
  if (muscle.fibers.count == 0) return {};
  const Sections sections = cut_into_sections(muscle);
  const Eigen::VectorXd field = origin_to_insertion(muscle);
  const NearestTriangle surface(muscle.surface);
  std::vector<std::vector<Real>> places;
  for (Index i = 0; i < lines.count(); ++i) {
    std::vector<std::optional<Real>> found = places_of(lines.line(i), muscle, field, surface, sections);
    if (!fill_gaps(found)) continue;
    std::vector<Real>& known = places.emplace_back();
    for (const std::optional<Real>& place : found) known.push_back(*place);
  }
  if (places.empty()) {
    Muscle plain = muscle;
    plain.fibers.shape = FiberTemplate::parallel;
    return inner_fibers(plain);
  }
  const Course course(places);
  return fibers_through(muscle, sections,
                        [&](const Eigen::Vector2d& start, std::size_t s) { return course.at(start, s); });
}

}  // namespace gracilis
