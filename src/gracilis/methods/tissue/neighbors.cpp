#include <gracilis/methods/tissue/neighbors.hpp>

#include <gracilis/anatomy/overlap/rest_overlap.hpp>
#include <gracilis/core/parallel.hpp>
#include <gracilis/core/sort_unique.hpp>
#include <gracilis/dynamics/contact/mesh/particle_normals.hpp>
#include <gracilis/dynamics/contact/surface/penetration_repair.hpp>
#include <gracilis/dynamics/contact/surface/vertex_face_search.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/rotations.hpp>
#include <gracilis/geometry/topology.hpp>
#include <gracilis/scene/attached_vertices.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace gracilis::tissue {

namespace {

/// Parts of a surface nearer than this at rest are neighbors, in edges.
constexpr Real neighborhood_edges = 4;
/// Forces of two muscles that differ by more, or by a larger angle (rad), are not of one contact.
constexpr Real most_evened = 1.25, most_turned = 0.1;

/// All surfaces near a common origin, where single precision is fine enough.
struct PlacedSurfaces {
  Vec3 origin = Vec3::Zero();
  std::vector<Particles> particles;
  std::vector<Eigen::Matrix3Xf> normals;
};

/// The muscles listed; of the others nothing.
PlacedSurfaces place(Neighbors& neighbors, const std::vector<Points>& shapes, const std::vector<std::size_t>& muscles) {
  PlacedSurfaces placed;
  placed.origin = shapes.front().rowwise().mean();
  placed.particles.resize(shapes.size());
  placed.normals.resize(shapes.size());
  parallel_for_each(muscles.size(), [&](std::size_t i) {
    const std::size_t m = muscles[i];
    const Points seen = shapes[m].colwise() - placed.origin;
    placed.particles[m] = make_particles(seen, (neighbors.areas[m].array() > 0).cast<Real>());
    placed.normals[m].resize(3, seen.cols());
    particle_normals(neighbors.world.surfaces[m], placed.particles[m], placed.normals[m]);
    refit(neighbors.world.surfaces[m], placed.particles[m], neighbors.trees[m]);
  });
  return placed;
}

PlacedSurfaces place(Neighbors& neighbors, const std::vector<Points>& shapes) {
  std::vector<std::size_t> all(shapes.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return place(neighbors, shapes, all);
}

/// A vertex and how it stands to another surface, to the face of that which is nearest.
struct SeenVertex {
  Index vertex = 0, face = 0;
  PointGap gap;
};

std::vector<SeenVertex> see_within(const Neighbors& neighbors, const PlacedSurfaces& placed, Index from, Index to,
                                   Real reach) {
  const auto probe = static_cast<std::size_t>(from), target = static_cast<std::size_t>(to);
  std::vector<VertexFaceCandidate> touches;
  find_near({neighbors.world.surfaces[probe], placed.particles[probe], neighbors.trees[probe]}, Eigen::Vector3f::Zero(),
            {neighbors.world.surfaces[target], placed.particles[target], neighbors.trees[target]},
            static_cast<float>(reach), touches);
  std::vector<SeenVertex> seen;
  for (const VertexFaceCandidate& touch : touches)
    seen.push_back(
        {touch.particle, touch.face,
         point_gap(placed.particles[probe].position(touch.particle), neighbors.world.surfaces[target],
                   NearestFace{touch.face, touch.barycentric}, placed.particles[target], placed.normals[target])});
  return seen;
}

/// Whether vertices that were not seen may lie inside the other surface, deeper than it was looked: one of them is next
/// to a vertex that was seen, and behind what that sees of the other surface.
bool may_hide(const ContactSurface& surface, const Particles& particles, const std::vector<SeenVertex>& seen) {
  std::vector<char> is_seen(static_cast<std::size_t>(particles.count()), 0);
  for (const SeenVertex& each : seen) is_seen[static_cast<std::size_t>(each.vertex)] = 1;
  for (const SeenVertex& each : seen)
    for (const Index e : surface.edges_at(each.vertex)) {
      const std::array<Index, 2>& ends = surface.edges[static_cast<std::size_t>(e)].ends;
      const Index next = ends[0] == each.vertex ? ends[1] : ends[0];
      if (is_seen[static_cast<std::size_t>(next)]) continue;
      const Eigen::Vector3f way = particles.position(next) - particles.position(each.vertex);
      if (each.gap.distance + each.gap.normal.dot(way) < 0) return true;
    }
  return false;
}

/// As far as all that may meet, which have gaps of up to `widest_gap` (m).
std::vector<SeenVertex> see(const Neighbors& neighbors, const PlacedSurfaces& placed, Index from, Index to,
                            Real widest_gap, const Look& look) {
  const Real reach = std::min(neighbor_reach, widest_gap + 2 * look.largest_move);
  std::vector<SeenVertex> seen = see_within(neighbors, placed, from, to, reach);
  const auto probe = static_cast<std::size_t>(from);
  if (reach < neighbor_reach && may_hide(neighbors.world.surfaces[probe], placed.particles[probe], seen))
    seen = see_within(neighbors, placed, from, to, neighbor_reach);
  return seen;
}

/// Where folds of a surface come near each other from outside. What lies back to back has tissue in between.
std::vector<SeenVertex> see_itself(const Neighbors& neighbors, const PlacedSurfaces& placed, const SelfMeeting& self) {
  const auto m = static_cast<std::size_t>(self.muscle);
  const ContactSurface& surface = neighbors.world.surfaces[m];
  const SelfRule rule = {surface,   self.rest_points,    self.rest_normals,
                         self.rest, placed.particles[m], self.neighborhood};
  std::vector<VertexFaceCandidate> touches;
  find_self({surface, placed.particles[m], neighbors.trees[m]}, rule, static_cast<float>(self_reach), touches);
  std::vector<SeenVertex> seen;
  for (const VertexFaceCandidate& touch : touches)
    if (touch.side > 0)
      seen.push_back({touch.particle, touch.face,
                      point_gap(placed.particles[m].position(touch.particle), surface,
                                NearestFace{touch.face, touch.barycentric}, placed.particles[m], placed.normals[m])});
  return seen;
}

std::vector<Real> gaps_at_rest(const std::vector<SeenVertex>& seen, Index count, Real gap) {
  std::vector<Real> gaps(static_cast<std::size_t>(count), gap);
  for (const SeenVertex& each : seen)
    gaps[static_cast<std::size_t>(each.vertex)] = std::min(gap, static_cast<Real>(each.gap.distance));
  return gaps;
}

/// Areas that free vertices stand for, m²: attached ones go with their bones and feel no muscle.
Eigen::VectorXd free_areas(const Muscle& muscle) {
  Eigen::VectorXd areas = vertex_areas(muscle.surface.vertices, muscle.surface.faces);
  const std::vector<char> attached = attached_vertices(muscle);
  for (Index v = 0; v < areas.size(); ++v)
    if (attached[static_cast<std::size_t>(v)]) areas[v] = 0;
  return areas;
}

Real widest(const std::vector<Real>& gaps) {
  Real most = 0;
  for (const Real gap : gaps) most = std::max(most, std::abs(gap));
  return most;
}

SelfMeeting meeting_of(const TriangleMesh& surface, Index muscle, const PlacedSurfaces& placed) {
  const auto m = static_cast<std::size_t>(muscle);
  SelfMeeting self;
  self.muscle = muscle;
  self.rest = placed.particles[m];
  self.rest_points = positions_of(self.rest);
  self.rest_normals = placed.normals[m];
  const std::vector<MeshEdge> edges = build_topology(surface.faces, surface.vertex_count()).edges;
  self.neighborhood = static_cast<float>(neighborhood_edges * mean_edge_length(edges, surface.vertices));
  return self;
}

/// What vertices of one muscle keep to another.
struct Meeting {
  Index from = 0, to = 0;             ///< muscles; to -1: its own surface
  const std::vector<Real>& gaps;      ///< m, per vertex
  const std::vector<float>& deepest;  ///< as SurfacePair has it
  Real stiffness = 0;                 ///< N/m³
};

/// A muscle's planes to another and the force that they will push it by, N, once it has settled.
struct FoundPlanes {
  std::vector<ContactPlane> planes;
  std::vector<Vec3> places;  ///< m, of their vertices
  Vec3 force = Vec3::Zero();
  Real deepest = 0;          ///< m, of the free vertices that lie in the other
  bool lies_deeper = false;  ///< any of these than the two did around it at rest
};

/// Each of the two surfaces goes half of the way, or may come as near.
FoundPlanes planes_of(const Neighbors& neighbors, const PlacedSurfaces& placed, const std::vector<SeenVertex>& seen,
                      const Meeting& meeting) {
  FoundPlanes found;
  const auto from = static_cast<std::size_t>(meeting.from);
  for (const SeenVertex& each : seen) {
    const Vec3 normal = each.gap.normal.cast<Real>();
    if (normal.isZero(0)) continue;
    const Vec3 p = placed.origin + placed.particles[from].position(each.vertex).cast<Real>();
    const Real gap = meeting.gaps[static_cast<std::size_t>(each.vertex)];
    const auto distance = static_cast<Real>(each.gap.distance);
    const Real lacking = gap - distance;
    if (neighbors.areas[from][each.vertex] > 0) {
      found.deepest = std::max(found.deepest, -distance);
      found.lies_deeper |= -distance > static_cast<Real>(depth_at_rest(meeting.deepest, each.vertex));
    }
    const bool faces_it = placed.normals[from].col(each.vertex).dot(each.gap.normal) < 0;
    found.planes.push_back({each.vertex, meeting.to, normal, normal.dot(p) + lacking / 2,
                            faces_it ? std::max(gap, 0.0) / 2 : std::numeric_limits<Real>::infinity()});
    found.places.push_back(p);
    if (lacking > 0) found.force += meeting.stiffness * neighbors.areas[from][each.vertex] * lacking / 2 * normal;
  }
  return found;
}

/// Turns and scales planes so that their force is that.
void press_by(const Vec3& force, FoundPlanes& found) {
  Eigen::AngleAxisd turn(turn_from_to(found.force, force));
  turn.angle() = std::min(turn.angle(), most_turned);
  const Real share = std::clamp(force.norm() / found.force.norm(), 1 / most_evened, most_evened);
  for (std::size_t i = 0; i < found.planes.size(); ++i) {
    ContactPlane& plane = found.planes[i];
    const Vec3 turned = turn * plane.normal;
    plane.least += (turned - plane.normal).dot(found.places[i]);
    plane.normal = turned;
    plane.share = share;
  }
}

/// Two surfaces sample what they press on each other differently. Makes both forces their mean.
void even_out(FoundPlanes& first, FoundPlanes& second) {
  const Vec3 mean = (first.force - second.force) / 2;
  if (!(mean.dot(first.force) > 0 && mean.dot(second.force) < 0)) return;
  press_by(mean, first);
  press_by(-mean, second);
}

/// The vertices that lie in another surface, no deeper than `reach` (m).
std::vector<VertexFaceCandidate> inside(const Neighbors& neighbors, const PlacedSurfaces& placed, Index from, Index to,
                                        Real reach) {
  std::vector<VertexFaceCandidate> found;
  for (const SeenVertex& each : see_within(neighbors, placed, from, to, reach))
    if (each.gap.distance < 0) found.push_back({each.vertex, each.face, 1, each.gap.distance, each.gap.barycentric});
  return found;
}

void append(const std::vector<ContactPlane>& found, std::vector<ContactPlane>& planes) {
  planes.insert(planes.end(), found.begin(), found.end());
}

}  // namespace

Neighbors prepare_neighbors(const Scene& scene, const std::vector<MeetingSettings>& settings) {
  Neighbors neighbors;
  std::vector<Points> shapes;
  for (const Muscle& muscle : scene.muscles) {
    shapes.push_back(muscle.surface.vertices);
    neighbors.areas.push_back(free_areas(muscle));
    neighbors.world.surfaces.push_back(build_contact_surface(muscle.surface.faces, muscle.surface.vertex_count()));
    neighbors.trees.push_back(build_patch_tree(neighbors.world.surfaces.back(), shapes.back().cast<float>()));
  }
  for (const MeetingSettings& each : settings) neighbors.stiffness.push_back(each.stiffness);
  const PlacedSurfaces placed = place(neighbors, shapes);
  const auto gaps_of = [&](Index muscle, Index other) {
    const auto m = static_cast<std::size_t>(muscle);
    return gaps_at_rest(see_within(neighbors, placed, muscle, other, neighbor_reach),
                        static_cast<Index>(shapes[m].cols()), settings[m].gap);
  };
  std::vector<std::vector<char>> is_free;
  for (const Eigen::VectorXd& areas : neighbors.areas) {
    is_free.emplace_back();
    for (const Real area : areas) is_free.back().push_back(area > 0);
  }
  const std::vector<RestOverlap> overlaps = rest_overlaps(scene);
  auto overlap = overlaps.begin();
  const auto count = static_cast<Index>(shapes.size());
  for (Index a = 0; a < count; ++a) {
    neighbors.world.rest.push_back(positions_of(placed.particles[static_cast<std::size_t>(a)]));
    for (Index b = a + 1; b < count; ++b) {
      neighbors.pairs.push_back({a, b, gaps_of(a, b), gaps_of(b, a)});
      NeighborPair& pair = neighbors.pairs.back();
      pair.widest = std::max(widest(pair.first_gaps), widest(pair.second_gaps));
      SurfacePair& of_seen = neighbors.world.pairs.emplace_back();
      of_seen.first = a, of_seen.second = b;
      if (overlap == overlaps.end() || overlap->first != a || overlap->second != b) continue;
      const auto surface = [&](Index m) -> RestSurface {
        return {shapes[static_cast<std::size_t>(m)], is_free[static_cast<std::size_t>(m)]};
      };
      DepthsAround depths = depths_around(*overlap++, surface(a), surface(b));
      of_seen.first_deepest = std::move(depths.of_first), of_seen.second_deepest = std::move(depths.of_second);
    }
  }
  for (std::size_t m = 0; m < settings.size(); ++m) {
    if (!settings[m].self) continue;
    SelfMeeting self = meeting_of(scene.muscles[m].surface, static_cast<Index>(m), placed);
    self.gaps = gaps_at_rest(see_itself(neighbors, placed, self), self.rest.count(), settings[m].gap);
    neighbors.selves.push_back(std::move(self));
  }
  return neighbors;
}

std::vector<std::vector<ContactPlane>> contact_planes(Neighbors& neighbors, const std::vector<Points>& shapes,
                                                      const Look& look) {
  std::vector<std::vector<ContactPlane>> planes(shapes.size());
  if (neighbors.none()) return planes;
  const PlacedSurfaces placed = place(neighbors, shapes);
  for (std::size_t i = 0; i < neighbors.pairs.size(); ++i) {
    NeighborPair& pair = neighbors.pairs[i];
    const SurfacePair& at_rest = neighbors.world.pairs[i];
    const auto a = static_cast<std::size_t>(pair.first), b = static_cast<std::size_t>(pair.second);
    FoundPlanes first =
        planes_of(neighbors, placed, see(neighbors, placed, pair.first, pair.second, pair.widest, look),
                  {pair.first, pair.second, pair.first_gaps, at_rest.first_deepest, neighbors.stiffness[a]});
    FoundPlanes second =
        planes_of(neighbors, placed, see(neighbors, placed, pair.second, pair.first, pair.widest, look),
                  {pair.second, pair.first, pair.second_gaps, at_rest.second_deepest, neighbors.stiffness[b]});
    pair.deepest_seen = std::max(first.deepest, second.deepest);
    pair.lies_deeper = first.lies_deeper || second.lies_deeper;
    even_out(first, second);
    append(first.planes, planes[a]);
    append(second.planes, planes[b]);
  }
  for (SelfMeeting& self : neighbors.selves) {
    if (look.self == SelfLook::anew)
      self.planes =
          planes_of(neighbors, placed, see_itself(neighbors, placed, self), {self.muscle, -1, self.gaps, {}, 0}).planes;
    append(self.planes, planes[static_cast<std::size_t>(self.muscle)]);
  }
  for (std::vector<ContactPlane>& each : planes)
    std::stable_sort(each.begin(), each.end(),
                     [](const ContactPlane& a, const ContactPlane& b) { return a.point < b.point; });
  return planes;
}

std::vector<Points> ways_apart(Neighbors& neighbors, const std::vector<Points>& shapes, Real moved) {
  std::vector<Points> ways(shapes.size(), Points(3, 0));
  std::vector<std::size_t> pairs, muscles;
  for (std::size_t i = 0; i < neighbors.pairs.size(); ++i) {
    const NeighborPair& pair = neighbors.pairs[i];
    if (!pair.lies_deeper) continue;
    pairs.push_back(i);
    for (const Index m : {pair.first, pair.second}) muscles.push_back(static_cast<std::size_t>(m));
  }
  if (pairs.empty()) return ways;
  sort_unique(muscles);
  PlacedSurfaces placed = place(neighbors, shapes, muscles);
  ContactWorldState state;
  state.candidates.resize(neighbors.pairs.size());
  parallel_for_each(pairs.size(), [&](std::size_t i) {
    const NeighborPair& pair = neighbors.pairs[pairs[i]];
    const Real reach = std::min(neighbor_reach, pair.deepest_seen + moved);
    state.candidates[pairs[i]].near_second = inside(neighbors, placed, pair.first, pair.second, reach);
    state.candidates[pairs[i]].near_first = inside(neighbors, placed, pair.second, pair.first, reach);
  });
  state.normals = std::move(placed.normals);
  const std::vector<Particles> before = placed.particles;
  std::vector<Particles*> particles;
  for (Particles& each : placed.particles) particles.push_back(&each);
  const std::vector<char> is_moved = repair_penetrations(neighbors.world, state, particles);
  for (std::size_t m = 0; m < is_moved.size(); ++m)
    if (is_moved[m]) ways[m] = (positions_of(placed.particles[m]) - positions_of(before[m])).cast<Real>();
  return ways;
}

}  // namespace gracilis::tissue
