#include <gracilis/anatomy/fibers/inner_fibers.hpp>

#include <gracilis/anatomy/attachments/attachment_samples.hpp>
#include <gracilis/anatomy/fibers/fiber_containment.hpp>
#include <gracilis/anatomy/fibers/fiber_knots.hpp>
#include <gracilis/anatomy/fibers/fiber_template.hpp>
#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/assignment.hpp>
#include <gracilis/geometry/harmonic_field.hpp>
#include <gracilis/geometry/isocontours.hpp>
#include <gracilis/geometry/measures.hpp>

#include <algorithm>
#include <limits>
#include <numeric>

namespace gracilis {

namespace {

constexpr Index loop_points = 128;
constexpr Index working_segments = 60;  ///< while fibers are smoothed, whatever the resolution asked for
constexpr Real least_depth = 1e-4;      ///< m below the surface at least
constexpr Real end_depth = 1e-5;        ///< m, of the ends

/// Fibers that are smoothed without a limit hardly know where sections were.
bool keeps_to_sections(const FiberSettings& settings) { return settings.smoothing_reach < unlimited_smoothing; }

Eigen::VectorXd field_on(const Muscle& muscle, const MeshTopology& topology) {
  std::vector<Index> fixed;
  std::vector<Real> values;
  for (const Attachment& attachment : muscle.attachments)
    for (const Index v : attachment.vertices) {
      fixed.push_back(v);
      values.push_back(attachment.end == AttachmentEnd::insertion ? 1 : 0);
    }
  const Eigen::Map<const Eigen::VectorXd> given(values.data(), static_cast<Index>(values.size()));
  return harmonic_fields(muscle.surface.vertices, topology, fixed, given).col(0);
}

/// Values of the field with equal areas of surface between them, attachments left out.
std::vector<Real> levels_of_equal_area(const Muscle& muscle, const Eigen::VectorXd& field, int count) {
  const Eigen::VectorXd areas = vertex_areas(muscle.surface.vertices, muscle.surface.faces);
  std::vector<Index> order;
  Real total = 0;
  for (Index v = 0; v < field.size(); ++v) {
    if (field[v] <= 1e-9 || field[v] >= 1 - 1e-9) continue;
    order.push_back(v);
    total += areas[v];
  }
  std::sort(order.begin(), order.end(), [&](Index a, Index b) { return field[a] < field[b]; });
  std::vector<Real> levels;
  Real passed = 0;
  for (const Index v : order) {
    passed += areas[v];
    // The outermost levels keep clear of the attachments' ragged rims.
    const Real wanted = (static_cast<Real>(levels.size()) + 0.75) / (count + 0.5) * total;
    if (passed >= wanted && static_cast<int>(levels.size()) < count && (levels.empty() || field[v] > levels.back()))
      levels.push_back(field[v]);
  }
  return levels;
}

/// The same closed line, beginning where its points lie nearest to those of `before`. Both have as many points.
Points aligned(const Points& loop, const Points& before) {
  const Eigen::Index n = loop.cols();
  // About their middles, so that no digits are lost where they are far from the origin.
  const Points a = loop.colwise() - loop.rowwise().mean(), b = before.colwise() - before.rowwise().mean();
  Eigen::Index best = 0;
  Real largest = -std::numeric_limits<Real>::infinity();
  for (Eigen::Index shift = 0; shift < n; ++shift) {
    const Real product = a.rightCols(n - shift).cwiseProduct(b.leftCols(n - shift)).sum() +
                         a.leftCols(shift).cwiseProduct(b.rightCols(shift)).sum();
    if (product > largest) largest = product, best = shift;
  }
  Points result(3, n);
  result << loop.rightCols(n - best), loop.leftCols(best);
  return result;
}

/// A contour that goes around the muscle as one closed line, resampled. Without points where it does not.
Points single_contour(const Muscle& muscle, const MeshTopology& topology, const Eigen::VectorXd& field, Real level) {
  const std::vector<Points> loops = isocontours(muscle.surface, topology, field, level);
  const bool is_single =
      !loops.empty() && (loops.size() == 1 || closed_length(loops[1]) <= closed_length(loops[0]) / 4);
  return is_single ? resampled_loop(loops[0], loop_points) : Points(3, 0);
}

/// Contours that go around the muscle, ascending, and their levels.
struct Contours {
  std::vector<Points> loops;
  std::vector<Real> levels;
  int left_out = 0;
};

/// Halves ways between contours that are longer than half of their girth: on a thin tendon, which has little area,
/// there would be few.
void fill_in(const Muscle& muscle, const MeshTopology& topology, const Eigen::VectorXd& field, Contours& contours) {
  constexpr int most_halvings = 3;
  const auto is_wide = [&](const Points& a, const Points& b) {
    return (a.rowwise().mean() - b.rowwise().mean()).norm() > (closed_length(a) + closed_length(b)) / 4;
  };
  for (int halving = 0; halving < most_halvings; ++halving) {
    Contours filled;
    for (std::size_t i = 0; i < contours.loops.size(); ++i) {
      if (i > 0 && is_wide(filled.loops.back(), contours.loops[i])) {
        const Real level = (contours.levels[i - 1] + contours.levels[i]) / 2;
        if (Points between = single_contour(muscle, topology, field, level); between.cols() > 0) {
          filled.loops.push_back(std::move(between));
          filled.levels.push_back(level);
        }
      }
      filled.loops.push_back(std::move(contours.loops[i]));
      filled.levels.push_back(contours.levels[i]);
    }
    contours.loops = std::move(filled.loops);
    contours.levels = std::move(filled.levels);
  }
}

Contours contours_around(const Muscle& muscle, const MeshTopology& topology, const Eigen::VectorXd& field, int levels) {
  Contours contours;
  for (const Real level : levels_of_equal_area(muscle, field, levels)) {
    Points loop = single_contour(muscle, topology, field, level);
    if (loop.cols() == 0) {
      ++contours.left_out;
    } else {
      contours.loops.push_back(std::move(loop));
      contours.levels.push_back(level);
    }
  }
  if (keeps_to_sections(muscle.fibers)) fill_in(muscle, topology, field, contours);
  return contours;
}

}  // namespace

Eigen::VectorXd origin_to_insertion(const Muscle& muscle) {
  return field_on(muscle, build_topology(muscle.surface.faces, muscle.surface.vertex_count()));
}

Sections cut_into_sections(const Muscle& muscle, int levels) {
  const MeshTopology topology = build_topology(muscle.surface.faces, muscle.surface.vertex_count());
  Sections sections;
  Contours around = contours_around(muscle, topology, field_on(muscle, topology), levels);
  std::vector<Points>& contours = around.loops;
  sections.left_out = around.left_out;
  if (contours.empty()) return sections;

  // The middle contour decides where the corners lie; the angular parameter spreads from it to both ends.
  const std::size_t middle = contours.size() / 2;
  for (std::size_t i = middle + 1; i < contours.size(); ++i) contours[i] = aligned(contours[i], contours[i - 1]);
  for (std::size_t i = middle; i-- > 0;) contours[i] = aligned(contours[i], contours[i + 1]);
  Real aspect = 1;
  const SquareCorners corners = square_corners(contours[middle], aspect);

  std::vector<Vec3> centers = {attachment_center(muscle, AttachmentEnd::origin)};
  for (std::size_t i = 0; i < contours.size(); ++i) {
    const Points& contour = contours[i];
    std::optional<SectionMap> map = SectionMap::build(contour, corners);
    if (!map) {
      ++sections.left_out;
      continue;
    }
    sections.maps.push_back(std::move(*map));
    sections.levels.push_back(around.levels[i]);
    centers.emplace_back(contour.rowwise().mean());
  }
  centers.push_back(attachment_center(muscle, AttachmentEnd::insertion));
  std::vector<Real> passed = {0};
  for (std::size_t i = 1; i < centers.size(); ++i)
    passed.push_back(passed.back() + (centers[i] - centers[i - 1]).norm());
  for (std::size_t i = 1; i + 1 < centers.size(); ++i) sections.shares.push_back(passed[i] / passed.back());
  const Real width = aspect / (1 + aspect) * closed_length(contours[middle]) / 2;
  sections.slenderness = passed.back() / width;
  return sections;
}

namespace {

/// The assignment of end points to fibers that lie at `from` in the section next to them. Both point sets are brought
/// to the same center first: only how they lie within their sets counts.
std::vector<Index> assign_ends(const Points& from, const Points& ends) {
  const Points a = from.colwise() - from.rowwise().mean(), b = ends.colwise() - ends.rowwise().mean();
  Eigen::MatrixXd costs(a.cols(), b.cols());
  for (Index i = 0; i < a.cols(); ++i) costs.row(i) = (b.colwise() - a.col(i)).colwise().squaredNorm();
  return cheapest_assignment(costs);
}

/// Per fiber its points in all sections, then the two ends put before and after.
std::vector<Points> knots_of_fibers(const Muscle& muscle, const Sections& sections, const FiberCourse& course) {
  const Index count = muscle.fibers.count;
  const auto inner = static_cast<Index>(sections.maps.size());
  const std::vector<Eigen::Vector2d> starts = spread_over_square(count);
  std::vector<Points> knots(static_cast<std::size_t>(count), Points(3, inner + 2));
  parallel_for(count, 4, [&](Index begin, Index end) {
    for (Index f = begin; f < end; ++f)
      for (Index k = 0; k < inner; ++k) {
        const Eigen::Vector2d at = course(starts[static_cast<std::size_t>(f)], static_cast<std::size_t>(k));
        knots[static_cast<std::size_t>(f)].col(k + 1) = sections.maps[static_cast<std::size_t>(k)].at(at.x(), at.y());
      }
  });

  const Points origins = attachment_samples(muscle, AttachmentEnd::origin, count);
  const Points insertions = attachment_samples(muscle, AttachmentEnd::insertion, count);
  const auto column = [&](Index k) {
    Points points(3, count);
    for (Index f = 0; f < count; ++f) points.col(f) = knots[static_cast<std::size_t>(f)].col(k);
    return points;
  };
  // Without any section fibers go straight from end to end.
  const std::vector<Index> to_origin = assign_ends(inner > 0 ? column(1) : insertions, origins);
  const std::vector<Index> to_insertion = inner > 0 ? assign_ends(column(inner), insertions) : std::vector<Index>();
  for (Index f = 0; f < count; ++f) {
    Points& line = knots[static_cast<std::size_t>(f)];
    line.col(0) = origins.col(to_origin[static_cast<std::size_t>(f)]);
    line.col(inner + 1) = insertions.col(inner > 0 ? to_insertion[static_cast<std::size_t>(f)] : f);
  }
  return knots;
}

}  // namespace

Polylines inner_fibers(const Muscle& muscle) {
  if (muscle.fibers.count == 0) return {};
  const Sections sections = cut_into_sections(muscle);
  return fibers_through(muscle, sections, [&](const Eigen::Vector2d& start, std::size_t section) {
    return template_point(muscle.fibers, start, sections.shares[section], sections.slenderness);
  });
}

Polylines fibers_through(const Muscle& muscle, const Sections& sections, const FiberCourse& course) {
  std::vector<Points> lines = knots_of_fibers(muscle, sections, course);
  const bool keeps = keeps_to_sections(muscle.fibers);
  const std::vector<Eigen::Matrix3d> extents = keeps ? inverse_extents(sections.maps) : std::vector<Eigen::Matrix3d>();
  const SignedDistance distance(muscle.surface);
  parallel_for(static_cast<Index>(lines.size()), 1, [&](Index begin, Index end) {
    for (Index f = begin; f < end; ++f) {
      Points& line = lines[static_cast<std::size_t>(f)];
      Points first = line.leftCols(1), last = line.rightCols(1);
      move_inside(muscle.surface, distance, end_depth, first);
      move_inside(muscle.surface, distance, end_depth, last);
      line.col(0) = first;
      line.rightCols(1) = last;
      std::vector<Eigen::Matrix3d> limits;
      if (keeps) {
        const FiberKnots knots = without_turning_back({line, extents});
        limits = smoothing_limits(knots, muscle.fibers.smoothing_reach, working_segments + 1);
        line = knots.line;
      }
      line = resampled(centripetal_spline(line, 6), working_segments);
      smooth_inside(muscle.surface, distance, least_depth, muscle.fibers.smoothing, line, limits);
      line = resampled(line, muscle.fibers.segments);
      // Cutting corners may have led out again.
      Points inner = line.middleCols(1, line.cols() - 2);
      move_inside(muscle.surface, distance, least_depth, inner);
      line.middleCols(1, line.cols() - 2) = inner;
    }
  });
  return join(lines);
}

}  // namespace gracilis
