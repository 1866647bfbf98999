#include <gracilis/anatomy/fibers/fascicles.hpp>

#include <gracilis/anatomy/fibers/aponeurosis_guides.hpp>
#include <gracilis/anatomy/fibers/fiber_containment.hpp>
#include <gracilis/anatomy/fibers/guide_tracts.hpp>
#include <gracilis/anatomy/fibers/traced_fibers.hpp>
#include <gracilis/core/parallel.hpp>

namespace gracilis {

static constexpr Index grid_nodes = 10000;       ///< of the grid that directions are given on
static constexpr Real depth_of_fascicle = 1e-4;  ///< m below the surface at least
static constexpr Real end_depth_of_fascicle = 1e-5;

/// Fascicles along the field as the muscle wants them.
static Polylines drawn_fascicles(const Muscle& muscle, const FiberRoom& room, const FiberField& field) {
  std::vector<Points> lines = evenly_traced(room, field, muscle.fibers.count);
  parallel_for_each(lines.size(), [&](std::size_t i) {
    Points& line = lines[i];
    line = resampled(line, muscle.fibers.segments);
    Points inner = line.middleCols(1, line.cols() - 2), ends(3, 2);
    ends << line.leftCols(1), line.rightCols(1);
    move_inside(muscle.surface, room.distance(), depth_of_fascicle, inner);
    move_inside(muscle.surface, room.distance(), end_depth_of_fascicle, ends);
    line << ends.leftCols(1), inner, ends.rightCols(1);
  });
  return join(lines);
}

/// A field that fits the muscle's tracts, or lines between its ends, best.
static Polylines fascicles_along(const Muscle& muscle, const Polylines& guides) {
  const FiberRoom room(muscle.surface, aponeuroses_of(muscle), grid_nodes);
  std::vector<DirectionSample> samples = samples_of_tracts(room.grid(), guides);
  if (samples.empty()) return {};
  turn_along(room.grid(), inner_origin_to_insertion(room.grid(), muscle), samples);
  return drawn_fascicles(muscle, room, fitted_field(room.grid(), std::move(samples)));
}

/// Fascicles at the pennation angle, between the belly's broad sides.
static Polylines fascicles_aslant(const Muscle& muscle) {
  const FiberRoom room(muscle.surface, aponeuroses_of(muscle), grid_nodes);
  const std::vector<DirectionSample> samples = pennate_directions(room.grid(), muscle);
  if (samples.empty()) return {};
  const Real smoothing = 2 * room.grid().step();
  const Points vectors = smooth_directions(room.grid(), samples, smoothing, Points::Zero(3, room.grid().count()));
  return drawn_fascicles(muscle, room, FiberField(room.grid(), vectors, smoothing));
}

Polylines fascicles_of(const Muscle& muscle) {
  constexpr Index lines_between = 400;
  if (muscle.tracts.count() > 0) return fascicles_along(muscle, muscle.tracts);
  if (muscle.fibers.ends == FiberEnds::attachments) return {};
  const bool is_known = !muscle.aponeuroses.empty() || attachments_are_spread(muscle);
  if (is_known) return fascicles_along(muscle, lines_between_ends(muscle, lines_between));
  return muscle.fibers.ends == FiberEnds::aponeuroses ? fascicles_aslant(muscle) : Polylines{};
}

}  // namespace gracilis
