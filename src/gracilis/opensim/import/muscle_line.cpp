#include <gracilis/opensim/import/muscle_line.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/geometry/polylines.hpp>
#include <gracilis/opensim/import/belly_length.hpp>
#include <gracilis/opensim/paths/muscle_path.hpp>
#include <gracilis/scene/section_line.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace gracilis::opensim {

/// The path's points now, those that coincide once; with their bodies.
struct Line {
  Points points;
  std::vector<Index> bodies;
};

/// Points on wrap surfaces are 30 degrees apart at most; others less than 0.1 mm apart become one.
static Line line_of(const Model& model, const Muscle& muscle, const std::vector<RigidTransform>& poses,
                    const Eigen::VectorXd& coordinates) {
  std::vector<Index> bodies;
  const Points all = line_through(current_points(model, muscle.path, poses, coordinates),
                                  placed_wraps(model, muscle.path, poses), radians(30), &bodies);
  Line line;
  for (Eigen::Index i = 0; i < all.cols(); ++i) {
    const Eigen::Index n = line.points.cols();
    if (n > 0 && (line.points.col(n - 1) - all.col(i)).norm() < 1e-4) continue;
    line.points.conservativeResize(3, n + 1);
    line.points.col(n) = all.col(i);
    line.bodies.push_back(bodies[static_cast<std::size_t>(i)]);
  }
  return line;
}

/// Origin's and insertion's tendon lengths on a line of this length, m. Slack lengths, and rest lengths by which
/// bellies grow, are those that fit_to_skeleton has scaled where the model was brought into another skeleton.
static std::pair<Real, Real> tendons_of(const Muscle& muscle, const VolumeSettings& settings, Real line) {
  const Real slack = muscle.tendon_slack_length;
  switch (settings.tendon) {
    case TendonPlace::beyond_belly:
      return {0, line - belly_on_line(muscle, settings.specific_tension, line)};
    case TendonPlace::half_at_insertion:
      return {0, slack / 2};
    case TendonPlace::whole_at_insertion:
      return {0, slack};
    case TendonPlace::both_ends:
      return {slack / 2, slack / 2};
  }
  return {0, slack / 2};
}

/// How often each part is halved so that sections are no farther apart than this (m) on average; once at least.
static int scaling_for(const Points& line, Real distance) {
  int scaling = 1;
  while (scaling < 16 && polyline_length(line) / std::ldexp(static_cast<Real>(line.cols() - 1), scaling) > distance)
    ++scaling;
  return scaling;
}

Index part_count(Real length, Real longest) { return static_cast<Index>(std::ceil(length / longest - 1e-9)); }

MuscleLine muscle_line(const Model& model, const Muscle& muscle, const std::vector<RigidTransform>& poses,
                       const Eigen::VectorXd& coordinates, const VolumeSettings& settings) {
  const Line line = line_of(model, muscle, poses, coordinates);
  const Real length = line.points.cols() < 2 ? 0 : polyline_length(line.points);
  if (!(length > 1e-3))
    throw InputError({model.name, muscle.name, "has no path through space of 1 mm or more", "leave the muscle out"});
  if (!(length < 10))
    throw InputError({model.name, muscle.name, fmt::format("has a path of {:.3g} m", length),
                      "longer than any muscle: check the places of its points"});
  if (!(muscle.max_isometric_force > 0))
    throw InputError({model.name, muscle.name, "has no force, so it has no volume", "leave the muscle out"});
  if (!(muscle.optimal_fiber_length < 10))
    throw InputError({model.name, muscle.name,
                      fmt::format("has an optimal fiber length of {:.3g} m", muscle.optimal_fiber_length),
                      "longer than any fiber: check its unit, which is m"});
  // Models have fibers that lean to either side, or nearly across; scenes know 0 to 89 degrees.
  const Real pennation = std::min(std::abs(muscle.pennation_angle_at_optimal), radians(89));
  const MuscleSize size{muscle.max_isometric_force, muscle.optimal_fiber_length, pennation, settings.specific_tension};
  if (!(tendon_radius(size) < length / 4))
    throw InputError({model.name, muscle.name,
                      fmt::format("has a force of {:.3g} N on a line of {:.3g} m", muscle.max_isometric_force, length),
                      "its tendon would be thicker than long: check the force"});
  const auto [origin_tendon, tendon] = tendons_of(muscle, settings, length);
  // A fifth of the line at least is belly.
  const Real share = std::min(1.0, 0.8 * length / std::max(tendon + origin_tendon, 1e-9));

  MuscleLine result{{line.points, line.bodies, settings.rays}, size, share};
  if (settings.scaling || settings.tendon_sections)
    result.line.scaling = settings.scaling.value_or(scaling_for(line.points, settings.section_distance));
  else
    result.line.shares = even_shares(std::max<Index>(2, part_count(length, settings.section_distance)));
  result.line.tendon = share * tendon;
  result.line.origin_tendon = share * origin_tendon;
  result.line.optimal_fiber = muscle.optimal_fiber_length;
  result.line.pennation = pennation;
  result.line.name = muscle.name;
  result.line.max_isometric_force = muscle.max_isometric_force;
  return result;
}

Eigen::VectorXd radii_at(const MuscleLine& muscle, const std::vector<Real>& places) {
  const Eigen::VectorXd positions = Eigen::VectorXd::Map(places.data(), static_cast<Eigen::Index>(places.size()));
  return spindle_radii(muscle.size, positions, muscle.line.tendon, muscle.line.origin_tendon);
}

}  // namespace gracilis::opensim
