#include <gracilis/prepare/prepare_surfaces.hpp>

#include <gracilis/geometry/nearest_triangle.hpp>
#include <gracilis/prepare/comparisons.hpp>
#include <gracilis/prepare/estimates.hpp>
#include <gracilis/prepare/reshaping.hpp>
#include <gracilis/prepare/separation.hpp>
#include <gracilis/prepare/smoothing.hpp>
#include <gracilis/prepare/solids.hpp>
#include <gracilis/prepare/surface_repair.hpp>
#include <gracilis/prepare/thickness.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>

namespace gracilis {
namespace {

using Say = std::function<void(const std::string&)>;

constexpr int passes = 3;
constexpr Real farthest_rounding = 0.0012;  ///< m
constexpr Real told_displacement = 0.0001;  ///< m; less is how triangles approximate a curved surface
constexpr Real most_left = 0.001;           ///< m of a gap that may be missed
constexpr Real most_growth = 0.05;          ///< of a volume by pulling apart; more is no overlap that was taken away

std::vector<TriangleMesh> meshes_of(const std::vector<NamedSurface>& surfaces) {
  std::vector<TriangleMesh> meshes;
  for (const NamedSurface& surface : surfaces) meshes.push_back(surface.mesh);
  return meshes;
}

/// Self-intersections that rounding and pulling apart may have made. True when there were any.
bool untangle(TriangleMesh& mesh, const std::string& name, const PrepareSettings& settings, const TimeLimit& limit) {
  if (!cuts_itself(mesh, limit)) return false;
  const Real volume = volume_of(mesh);
  const Index before = mesh.face_count();
  mesh = fix_surface(mesh, name, limit).mesh;
  // A grid's triangles, where it was rebuilt.
  if (settings.edge_length > 0 && mesh.face_count() > 2 * before) mesh = coarsened(mesh, settings.edge_length, limit);
  give_volume_back(mesh, volume, settings.volume_tolerance, limit);
  return true;
}

/// Spikes and rims are rounded as far as the volume can be given back.
void round_in_place(TriangleMesh& mesh, const PrepareSettings& settings, const TimeLimit& limit) {
  TriangleMesh rounded = mesh;
  round_off(rounded, sharpest_turn, settings.rounding_rounds, farthest_rounding);
  const Real volume = volume_of(mesh);
  const auto is_kept = [&] { return volume_error(rounded, volume) <= settings.volume_tolerance; };
  if (settings.volume_tolerance < 1 && !is_kept()) set_volume(rounded, volume, limit);
  if (settings.volume_tolerance >= 1 || is_kept()) mesh = std::move(rounded);
}

/// A muscle by itself, before the others are looked at.
struct Shaped {
  TriangleMesh repaired, mesh;
  std::vector<std::string> repairs;
};

Shaped shaped(const NamedSurface& muscle, const PrepareSettings& settings, const Say& say) {
  const TimeLimit limit(settings.time_limit);
  say("repairing " + muscle.name);
  FixedSurface fixed = fix_surface(muscle.mesh, muscle.name, limit);
  Shaped result{std::move(fixed.mesh), {}, std::move(fixed.repairs)};
  if (muscle.largest_piece) result.repaired = largest_piece(result.repaired);
  result.mesh = result.repaired;
  smooth_surface(result.mesh, settings.smoothing_rounds);
  if (settings.edge_length > 0 && !has_edges_about(result.mesh, settings.edge_length)) {
    say("remeshing " + muscle.name);
    result.mesh =
        reshaped(result.mesh, settings, limit, [&](const std::string& text) { say(muscle.name + ": " + text); });
  } else {
    round_in_place(result.mesh, settings, limit);
  }
  untangle(result.mesh, muscle.name, settings, limit);
  if (!is_solid(result.mesh)) result.mesh = fix_surface(result.mesh, muscle.name, limit).mesh;
  return result;
}

/// The same; where it cannot be prepared none, and what is wrong with it is added to `problems`.
std::optional<Shaped> shaped_if_possible(const NamedSurface& muscle, const PrepareSettings& settings, const Say& say,
                                         std::vector<Problem>& problems) try {
  return shaped(muscle, settings, say);
} catch (const OutOfTime&) {
  problems.push_back(out_of_time(muscle.name, settings));
  return std::nullopt;
} catch (const InputError& error) {
  problems.insert(problems.end(), error.problems().begin(), error.problems().end());
  return std::nullopt;
}

/// How far separation took the surfaces: the distance of every vertex to the surface as it was before.
void report_displacements(const std::vector<TriangleMesh>& before, const std::vector<TriangleMesh>& after,
                          PreparationReport& report) {
  for (std::size_t m = 0; m < before.size(); ++m) {
    PreparedMuscleReport& muscle = report.muscles[m];
    const NearestTriangle nearest(before[m]);
    for (Index v = 0; v < after[m].vertex_count(); ++v) {
      const Real moved = nearest.query(after[m].vertices.col(v)).distance;
      if (moved <= told_displacement) continue;
      ++muscle.vertices_moved;
      muscle.mean_displacement += moved;
      muscle.max_displacement = std::max(muscle.max_displacement, moved);
    }
    if (muscle.vertices_moved > 0) muscle.mean_displacement /= muscle.vertices_moved;
  }
}

std::string name_of(Index surface, const std::vector<NamedSurface>& muscles, const std::vector<NamedSurface>& bones) {
  const auto s = static_cast<std::size_t>(surface);
  return s < muscles.size() ? muscles[s].name : bones[s - muscles.size()].name;
}

/// The bodies of muscles by their names, where any are given.
std::optional<std::vector<Index>> bodies_of(const std::optional<std::vector<std::string>>& muscles,
                                            const std::vector<NamedSurface>& names,
                                            const std::vector<std::size_t>& muscle_of) {
  if (!muscles) return std::nullopt;
  std::vector<Index> bodies;
  for (std::size_t b = 0; b < muscle_of.size(); ++b)
    if (std::find(muscles->begin(), muscles->end(), names[muscle_of[b]].name) != muscles->end())
      bodies.push_back(static_cast<Index>(b));
  return bodies;
}

/// One pass of separation of the muscles' pieces, each of which is a body. Takes what it moved off each muscle's
/// `budget` (m), which the first pass makes.
Real separate_pieces(std::vector<TriangleMesh>& muscles, const std::vector<TriangleMesh>& bones,
                     SeparationSettings apart, const std::vector<NamedSurface>& names, std::vector<Real>& budget,
                     const TimeLimit& limit) {
  std::vector<TriangleMesh> bodies;
  std::vector<std::size_t> muscle_of;
  for (std::size_t m = 0; m < muscles.size(); ++m)
    for (TriangleMesh& piece : pieces_of(muscles[m])) {
      bodies.push_back(std::move(piece));
      muscle_of.push_back(m);
      if (!budget.empty()) apart.at_most.push_back(budget[m]);
    }
  for (const std::size_t m : muscle_of) apart.apart_from.push_back(bodies_of(names[m].apart_from, names, muscle_of));
  const SeparationResult result = separate(bodies, bones, apart, limit);
  std::vector<Real> lacked(muscles.size(), 0), moved(muscles.size(), 0);
  std::vector<std::vector<TriangleMesh>> pieces(muscles.size());
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const std::size_t m = muscle_of[b];
    lacked[m] = std::max(lacked[m], result.lacked[b]);
    moved[m] = std::max(moved[m], result.moved[b]);
    pieces[m].push_back(std::move(bodies[b]));
  }
  for (std::size_t m = 0; m < muscles.size(); ++m) {
    muscles[m] = merged(pieces[m]);
    if (budget.size() <= m) budget.push_back(apart.farthest * lacked[m]);
    budget[m] = std::max(Real{0}, budget[m] - moved[m]);
  }
  return result.shortfall;
}

/// By how much the worst gap is missed as things are, m.
Real what_is_left(std::vector<TriangleMesh> muscles, const std::vector<NamedSurface>& names,
                  const std::vector<TriangleMesh>& bones, SeparationSettings apart) {
  apart.rounds = 0;
  std::vector<Real> budget;
  return separate_pieces(muscles, bones, apart, names, budget, TimeLimit());
}

/// Pulls overlaps apart, unless they are to stay. A muscle that this made swell stays as it was, and so do all where
/// more triangles cut each other than before. Tells whether it succeeded.
bool pull_apart(std::vector<TriangleMesh>& muscles, const std::vector<NamedSurface>& names,
                const std::vector<TriangleMesh>& bones, const PrepareSettings& settings, Real& shortfall) {
  std::size_t bodies = bones.size();
  for (const TriangleMesh& muscle : muscles) bodies += pieces_of(muscle).size();
  if (bodies < 2) return true;
  const SeparationSettings apart{.muscle_gap = settings.muscle_gap, .bone_gap = settings.bone_gap};
  if (settings.keep_overlaps) {
    shortfall = what_is_left(muscles, names, bones, apart);
    return true;
  }
  const TimeLimit limit(settings.time_limit * static_cast<Real>(muscles.size()));
  const std::vector<TriangleMesh> before = muscles;
  std::vector<Real> budget;
  try {
    for (int pass = 1;; ++pass) {
      shortfall = separate_pieces(muscles, bones, apart, names, budget, limit);
      if (pass == passes) break;
      // Triangles may have suffered; mending them may bring surfaces close again.
      bool mended = false;
      for (std::size_t m = 0; m < muscles.size(); ++m) {
        if (settings.edge_length > 0 && budget[m] > 0 && muscles[m].vertices != before[m].vertices &&
            !has_edges_about(muscles[m], settings.edge_length)) {
          muscles[m] = remeshed(muscles[m], settings, limit);
          mended = true;
        }
        mended = untangle(muscles[m], names[m].name, settings, limit) || mended;
      }
      if (!mended) break;
    }
    bool done = shortfall <= most_left;
    for (std::size_t m = 0; m < muscles.size(); ++m) {
      if (is_solid(muscles[m]) && volume_of(muscles[m]) <= (1 + most_growth) * volume_of(before[m])) continue;
      muscles[m] = before[m];
      done = false;
    }
    if (crossings_between(muscles, bones) <= crossings_between(before, bones)) {
      if (!done) shortfall = what_is_left(muscles, names, bones, apart);
      return done;
    }
  } catch (const OutOfTime&) {
  } catch (const InputError&) {  // untangling left nothing
  }
  muscles = before;
  shortfall = what_is_left(muscles, names, bones, apart);
  return false;
}

/// What stays is as a bone to the others.
void require_separable(std::vector<NamedSurface> muscles, std::vector<NamedSurface> bones) {
  const auto first_staying =
      std::stable_partition(muscles.begin(), muscles.end(), [](const NamedSurface& each) { return !each.stays(); });
  std::move(first_staying, muscles.end(), std::back_inserter(bones));
  muscles.erase(first_staying, muscles.end());
  require_apart(muscles, bones);
}

/// Muscles that are shaped, with the others among bones: pulled apart and measured. Throws InputError naming muscles
/// that lie in other surfaces.
PreparedSurfaces finished(const std::vector<NamedSurface>& muscles, std::vector<Shaped> shapes,
                          const std::vector<NamedSurface>& bones, const PrepareSettings& settings, const Say& say) {
  PreparedSurfaces result;
  PreparationReport& report = result.report;
  const std::vector<TriangleMesh> obstacles = meshes_of(bones);
  std::vector<TriangleMesh> repaired;
  std::vector<NamedSurface> closed;
  for (Shaped& muscle : shapes) {
    const std::string& name = muscles[repaired.size()].name;
    const std::optional<std::vector<std::string>>& apart_from = muscles[repaired.size()].apart_from;
    report.muscles.push_back({.name = name, .repairs = std::move(muscle.repairs)});
    repaired.push_back(muscle.repaired);
    closed.push_back({name, std::move(muscle.repaired), false, apart_from});
    result.muscles.push_back(std::move(muscle.mesh));
  }
  if (!settings.keep_overlaps) require_separable(std::move(closed), bones);
  const Crossings before = count_crossings(meshes_of(muscles), obstacles);
  const std::vector<TriangleMesh> apart_from = result.muscles;
  if (muscles.size() + bones.size() > 1 && !settings.keep_overlaps) say("pulling overlaps apart");
  report.pulled_apart = pull_apart(result.muscles, muscles, obstacles, settings, report.largest_shortfall);
  if (!report.pulled_apart) say("overlaps could not be pulled apart everywhere; check the places of the surfaces");
  report_displacements(apart_from, result.muscles, report);

  say("measuring");
  const Crossings after = count_crossings(result.muscles, obstacles);
  for (std::size_t m = 0; m < muscles.size(); ++m) {
    PreparedMuscleReport& muscle = report.muscles[m];
    const TriangleMesh& mesh = result.muscles[m];
    muscle.faces_before = muscles[m].mesh.face_count();
    muscle.faces_after = mesh.face_count();
    muscle.pieces = static_cast<Index>(pieces_of(mesh).size());
    muscle.volume_before = volume_of(repaired[m]);
    muscle.volume_after = volume_of(mesh);
    const SurfaceDistance there = distance_from_to(mesh, repaired[m]), back = distance_from_to(repaired[m], mesh);
    muscle.hausdorff = std::max(there.largest, back.largest);
    muscle.mean_distance = there.mean;
    muscle.sharp_edges_before = sharp_edge_count(repaired[m], sharpest_turn);
    muscle.sharp_edges_after = sharp_edge_count(mesh, sharpest_turn);
  }
  Crossings all = before;
  all.insert(after.begin(), after.end());
  for (const auto& each : all) {
    const auto& pair = each.first;
    const auto count = [&](const Crossings& crossings) {
      const auto found = crossings.find(pair);
      return found == crossings.end() ? 0 : found->second;
    };
    if (pair.first == pair.second) {
      report.muscles[static_cast<std::size_t>(pair.first)].self_intersections_before = count(before);
      report.muscles[static_cast<std::size_t>(pair.first)].self_intersections_after = count(after);
    } else {
      report.pairs.push_back(
          {name_of(pair.first, muscles, bones), name_of(pair.second, muscles, bones), count(before), count(after)});
    }
  }
  return result;
}

/// Takes out the muscles that the error names, and tells of them in `problems`. Throws it again where it names none.
void leave_out(const InputError& error, std::vector<NamedSurface>& muscles, std::vector<Shaped>& shapes,
               std::vector<Problem>& problems) {
  std::vector<NamedSurface> others;
  std::vector<Shaped> their_shapes;
  for (std::size_t m = 0; m < muscles.size(); ++m) {
    const auto is_meant = [&](const Problem& problem) { return problem.where == muscles[m].name; };
    if (std::any_of(error.problems().begin(), error.problems().end(), is_meant)) continue;
    others.push_back(std::move(muscles[m]));
    their_shapes.push_back(std::move(shapes[m]));
  }
  if (others.size() == muscles.size()) throw InputError(error.problems());
  problems.insert(problems.end(), error.problems().begin(), error.problems().end());
  muscles = std::move(others);
  shapes = std::move(their_shapes);
}

}  // namespace

PreparedSurfaces prepare_surfaces(const std::vector<NamedSurface>& muscles, const std::vector<NamedSurface>& bones,
                                  const PrepareSettings& settings, const Say& say) {
  require_affordable(muscles, bones, settings);
  std::vector<Shaped> shapes;
  std::vector<Problem> problems;
  for (const NamedSurface& muscle : muscles)
    if (std::optional<Shaped> shape = shaped_if_possible(muscle, settings, say, problems))
      shapes.push_back(std::move(*shape));
  if (!problems.empty()) throw InputError(std::move(problems));
  return finished(muscles, std::move(shapes), bones, settings, say);
}

PreparedSurfaces prepare_possible(const std::vector<NamedSurface>& muscles, const std::vector<NamedSurface>& bones,
                                  const PrepareSettings& settings, const Say& say, std::vector<Problem>& problems) {
  require_affordable({}, bones, settings);
  std::vector<NamedSurface> possible;
  std::vector<Shaped> shapes;
  for (const NamedSurface& muscle : muscles) try {
      require_affordable({muscle}, {}, settings);
      std::optional<Shaped> shape = shaped_if_possible(muscle, settings, say, problems);
      if (!shape) continue;
      shapes.push_back(std::move(*shape));
      possible.push_back(muscle);
    } catch (const InputError& error) {
      problems.insert(problems.end(), error.problems().begin(), error.problems().end());
    }
  while (!possible.empty()) try {
      return finished(possible, shapes, bones, settings, say);
    } catch (const InputError& error) {
      leave_out(error, possible, shapes, problems);
    }
  return {};
}

}  // namespace gracilis
