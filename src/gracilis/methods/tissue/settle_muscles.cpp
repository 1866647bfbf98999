#include <gracilis/methods/tissue/settle_muscles.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/methods/tissue/seen_surface.hpp>
#include <gracilis/methods/tissue/settle.hpp>
#include <gracilis/methods/tissue/settle_joined.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis::tissue {

namespace {

/// How far muscles are thought to move before they look at each other again, over how far they did in the last step.
constexpr Real moves_expected = 2;
/// How much of its volume the pressure that keeps it may give a muscle back: one that is crushed between bones has no
/// place to grow.
constexpr Real most_given_back = 0.02;
/// How much of what is missing is asked for at once: all of it is too much where a muscle is not at rest yet.
constexpr Real asked_at_once = 0.5;

/// How many times as stiff a muscle's contact with others is as when it is passive.
Real stiffer_when_active(const TissueSettings& settings, Real active_tension) {
  if (!(settings.neighbor_stiffness > 0)) return 1;
  return std::max(1.0, settings.neighbor_per_tension * active_tension / settings.neighbor_stiffness);
}

void look_at_neighbors(TissueMuscles& tissues, std::vector<MovingMuscle>& moving, const Look& look) {
  // What is seen of them meets, and the tissue gives way by as much.
  std::vector<Points> seen(moving.size()), tissue(moving.size());
  parallel_for_each(moving.size(), [&](std::size_t m) {
    tissue[m] = surface_at(tissues.muscles[m], moving[m].nodes);
    seen[m] = enclosing_surface(tissues.muscles[m], moving[m].nodes, tissue[m]);
  });
  std::vector<std::vector<ContactPlane>> planes = contact_planes(tissues.neighbors, seen, look);
  std::vector<Real> stiffer;
  for (std::size_t m = 0; m < moving.size(); ++m)
    stiffer.push_back(stiffer_when_active(tissues.muscles[m].settings, moving[m].active_tension));
  for (std::size_t m = 0; m < moving.size(); ++m) {
    for (ContactPlane& plane : planes[m]) {
      // Alike for both, so that they press on each other with the same force.
      const std::size_t other = plane.muscle < 0 ? m : static_cast<std::size_t>(plane.muscle);
      plane.share *= std::max(stiffer[m], stiffer[other]);
      plane.least += plane.normal.dot(tissue[m].col(plane.point) - seen[m].col(plane.point));
    }
    set_planes(tissues.muscles[m], std::move(planes[m]), moving[m].equilibrium.around);
  }
}

/// The pressure under which the muscle's cells would grow by their own volume, Pa.
Real bulk_of(const PreparedTissue& muscle, const std::vector<CellLaw>& laws) {
  Real volume = 0, gives_way = 0;
  for (std::size_t c = 0; c < laws.size(); ++c) {
    const Real filled = filled_volume(muscle.lattice, muscle.lattice.cells[c]);
    volume += filled;
    gives_way += filled / (laws[c].bulk + laws[c].matrix.lambda);
  }
  return volume / gives_way;
}

/// What keeps the muscle's volume, by the method of multipliers (Nocedal and Wright 2006, chapter 17.3).
void note_pressure(const PreparedTissue& muscle, const Points& nodes, Equilibrium& found) {
  if (!(muscle.settings.bulk_modulus > 0)) return;
  const Real bulk = bulk_of(muscle, found.laws), most = most_given_back * bulk;
  const Real missing = 1 - filled_volume_ratio(muscle.lattice, nodes);
  found.next_pressure = std::clamp(found.around.laws.pressure + asked_at_once * missing * bulk, -most, most);
}

int iterations_of(const TissueMuscles& tissues, std::size_t m) {
  return (tissues.muscles[m].settings.minimizer_iterations + tissues.rounds - 1) / tissues.rounds;
}

void note(const PreparedTissue& muscle, const Minimized& done, MovingMuscle& moving) {
  moving.done = done;
  moving.iterations += done.iterations;
  require_finite(muscle, moving.nodes.allFinite());
  note_pressure(muscle, moving.nodes, moving.equilibrium);
}

void settle_alone(const TissueMuscles& tissues, std::size_t m, MovingMuscle& moving) {
  const PreparedTissue& muscle = tissues.muscles[m];
  note(muscle, settle(muscle, moving.equilibrium.around, *moving.metric, iterations_of(tissues, m), moving.nodes),
       moving);
}

/// The muscles of a group, whose time counts for the first of them.
void settle_group(const TissueMuscles& tissues, const std::vector<std::size_t>& group,
                  std::vector<MovingMuscle>& moving) {
  std::vector<JoinedTissue> joined;
  int iterations = 0;
  for (const std::size_t m : group) {
    joined.push_back({m, &tissues.muscles[m], &moving[m].equilibrium.around, moving[m].metric, &moving[m].nodes});
    iterations = std::max(iterations, iterations_of(tissues, m));
  }
  Minimized done;
  timed(moving[group.front()], [&] { done = settle_joined(tissues.ends, joined, iterations); });
  for (const std::size_t m : group) note(tissues.muscles[m], done, moving[m]);
}

void settle_all(const TissueMuscles& tissues, std::vector<MovingMuscle>& moving) {
  for (MovingMuscle& each : moving) each.equilibrium.around.laws.pressure = each.equilibrium.next_pressure;
  parallel_for_each(moving.size() + tissues.groups_joined.size(), [&](std::size_t i) {
    if (i >= moving.size())
      settle_group(tissues, tissues.groups_joined[i - moving.size()], moving);
    else if (!tissues.is_joined[i])
      timed(moving[i], [&] { settle_alone(tissues, i, moving[i]); });
  });
}

/// How far nodes moved at most, m.
Real settle_round(TissueMuscles& tissues, std::vector<MovingMuscle>& moving, const Look& look) {
  std::vector<Points> before;
  for (const MovingMuscle& each : moving) before.push_back(each.nodes);
  const auto settled = [&](const Look& as) {
    look_at_neighbors(tissues, moving, as);
    settle_all(tissues, moving);
    Real squared = 0;
    for (std::size_t m = 0; m < moving.size(); ++m)
      squared = std::max(squared, (moving[m].nodes - before[m]).colwise().squaredNorm().maxCoeff());
    return std::sqrt(squared);
  };
  const Real moved = settled(look);
  if (moved <= look.largest_move || look.largest_move == neighbor_reach) return moved;
  for (std::size_t m = 0; m < moving.size(); ++m) moving[m].nodes = before[m];
  return settled({look.self});
}

}  // namespace

TissueMuscles prepare_tissues(const Scene& scene, const std::vector<DistanceField>& fields,
                              const std::vector<SignedDistance>& distances) {
  TissueMuscles tissues;
  tissues.muscles.resize(scene.muscles.size());
  parallel_for_each(scene.muscles.size(), [&](std::size_t m) {
    tissues.muscles[m] = prepare_tissue(scene, scene.muscles[m], fields, distances);
  });
  tissues.ends = ends_on_muscles(scene, tissues.muscles);
  prepare_joints(tissues.ends, tissues.muscles);
  tissues.groups_joined = joined_groups(tissues.ends, tissues.muscles.size());
  tissues.is_joined.assign(tissues.muscles.size(), 0);
  for (const std::vector<std::size_t>& group : tissues.groups_joined)
    for (const std::size_t m : group) tissues.is_joined[m] = 1;
  std::vector<MeetingSettings> meetings;
  bool any_self = false;
  for (const PreparedTissue& muscle : tissues.muscles) {
    tissues.rounds = std::max(tissues.rounds, muscle.settings.contact_rounds);
    meetings.push_back(
        {muscle.settings.neighbor_gap, muscle.settings.neighbor_stiffness, muscle.settings.self_contact});
    any_self = any_self || muscle.settings.self_contact;
  }
  if (tissues.rounds > 0 && (tissues.muscles.size() > 1 || any_self))
    tissues.neighbors = prepare_neighbors(scene, meetings);
  if (tissues.neighbors.none()) tissues.rounds = 1;
  return tissues;
}

void require_finite(const PreparedTissue& muscle, bool is_finite) {
  if (!is_finite) throw QualityError("muscle " + muscle.name + ": a vertex position is not finite; check the pose");
}

Real settle_muscles(TissueMuscles& tissues, Real expected_move, std::vector<MovingMuscle>& moving) {
  if (tissues.neighbors.none()) {
    settle_all(tissues, moving);
    return expected_move;
  }
  Real furthest = 0;
  for (int round = 0; round < tissues.rounds; ++round) {
    // Folds move little between rounds, so muscles look at themselves once a step.
    const SelfLook self = round == 0 ? SelfLook::anew : SelfLook::kept;
    furthest = std::max(furthest, settle_round(tissues, moving, {self, expected_move}));
  }
  return std::min(neighbor_reach, moves_expected * furthest);
}

}  // namespace gracilis::tissue
