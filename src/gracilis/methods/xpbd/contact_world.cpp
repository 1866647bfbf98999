#include <gracilis/methods/xpbd/contact_world.hpp>

#include <gracilis/dynamics/coloring.hpp>
#include <gracilis/dynamics/contact/mesh/particle_normals.hpp>
#include <gracilis/dynamics/contact/surface/broad_phase.hpp>
#include <gracilis/dynamics/havlicek_2024/virtual_edge_seeds.hpp>
#include <gracilis/geometry/topology.hpp>
#include <gracilis/methods/xpbd/rest_gaps.hpp>
#include <gracilis/methods/xpbd/settings.hpp>
#include <gracilis/scene/setting_values.hpp>

#include <algorithm>

namespace gracilis::xpbd {

namespace {

/// Mean edges around a place that belong to it and do not meet it.
constexpr float neighborhood_edges = 4;
/// How far parts of one surface are looked for from each other: mean edges, but m at least.
constexpr float self_reach_edges = 0.5f, least_self_reach = 0.001f;

float mean_edge(const SurfaceSystem& system) {
  double sum = 0;
  for (Index slot : system.distances.slot) sum += system.distances.rest_length[static_cast<std::size_t>(slot)];
  return system.distances.count > 0 ? static_cast<float>(sum / system.distances.count) : 0;
}

void add_surface(const PreparedMuscle& muscle, ContactWorld& world) {
  const Particles& rest = muscle.system.rest;
  world.surfaces.push_back(build_contact_surface(muscle.faces, rest.count()));
  Eigen::Matrix3Xf normals;
  particle_normals(world.surfaces.back(), rest, normals);
  world.rest.push_back(positions_of(rest));
  world.rest_normals.push_back(std::move(normals));
  world.neighborhood.push_back(neighborhood_edges * mean_edge(muscle.system));
}

SurfacePair pair_of(Index first, Index second, const std::vector<PreparedMuscle>& muscles, float margin) {
  const PreparedMuscle &a = muscles[static_cast<std::size_t>(first)], &b = muscles[static_cast<std::size_t>(second)];
  SurfacePair pair;
  pair.first = first, pair.second = second;
  pair.shift = (a.origin - b.origin).cast<float>();
  const auto first_count = static_cast<std::size_t>(a.rest.cols()),
             second_count = static_cast<std::size_t>(b.rest.cols());
  pair.first_gap.assign(first_count, margin), pair.second_gap.assign(second_count, margin);
  pair.first_touches.assign(first_count, 0), pair.second_touches.assign(second_count, 0);
  return pair;
}

ContactWorld surfaces_of(const ContactSettings& settings, const SurfaceContactSettings& meeting,
                         const std::vector<PreparedMuscle>& muscles, const MuscleTies& ties) {
  ContactWorld world;
  const auto margin = static_cast<float>(settings.margin);
  world.settings = meeting;
  world.settings.most_motion = static_cast<float>(settings.reach);
  const auto count = static_cast<Index>(muscles.size());
  std::vector<const Particles*> rest;
  std::vector<TriangleMesh> meshes;
  std::vector<std::vector<char>> in_tendon;
  for (const PreparedMuscle& muscle : muscles) {
    add_surface(muscle, world);
    rest.push_back(&muscle.system.rest);
    meshes.push_back({muscle.rest, muscle.faces});
    in_tendon.push_back(in_tendons(muscle.lines, muscle.shares));
  }
  const OverlapTable overlaps(meshes, in_tendon);
  for (Index first = 0; first < count; ++first)
    for (Index second = first; second < count; ++second) {
      if (second == first && !muscles[static_cast<std::size_t>(first)].keeps_out_of_itself) continue;
      world.pairs.push_back(pair_of(first, second, muscles, margin));
      overlaps.mark(static_cast<float>(settings.reach), rest, world.pairs.back());
    }
  for (SurfacePair& pair : world.pairs)
    // Parts of one surface come near each other slowly, but edges may cross halfway between particles.
    pair.reach = pair.is_self()
                     ? std::max(least_self_reach, self_reach_edges / neighborhood_edges *
                                                      world.neighborhood[static_cast<std::size_t>(pair.first)])
                     : static_cast<float>(overlaps.deepest(pair.first, pair.second) + settings.reach);
  arrange_rounds(world);

  ContactWorldState state = gracilis::make_contact_state(world);
  update_broad_phase(world, rest, state);
  for (std::size_t i = 0; i < world.pairs.size(); ++i) measure_rest_gaps(state, rest, i, ties.surfaces, world);
  return world;
}

VirtualEdgeWorld edges_of(const VirtualEdgeSettings& settings, const std::vector<PreparedMuscle>& muscles) {
  VirtualEdgeWorld world;
  world.settings = settings;
  std::vector<std::array<Index, 2>> pairs;
  for (std::size_t first = 0; first < muscles.size(); ++first) {
    world.stars.push_back(build_topology(muscles[first].faces, muscles[first].system.rest.count()).stars);
    for (std::size_t second = first + 1; second < muscles.size(); ++second) {
      const Eigen::Vector3f shift = (muscles[first].origin - muscles[second].origin).cast<float>();
      world.pairs.push_back({static_cast<Index>(first), static_cast<Index>(second), shift});
      pairs.push_back({world.pairs.back().first, world.pairs.back().second});
    }
  }
  world.rounds = rounds_of(pairs);
  return world;
}

}  // namespace

MuscleContactWorld prepare_contact_world(const Scene& scene, const std::vector<PreparedMuscle>& muscles, bool meet) {
  const SettingValues& values = scene.method.contact;
  const ContactSettings settings = contact_settings(scene);
  MuscleContactWorld world;
  world.ties = prepare_ties(scene, muscles);
  if (!meet) return world;
  if (settings.muscle == MuscleContact::surface)
    world.surfaces = surfaces_of(settings, with_values(SurfaceContactSettings{}, values), muscles, world.ties);
  if (settings.muscle == MuscleContact::virtual_edges)
    world.edges = edges_of(with_values(VirtualEdgeSettings{}, values), muscles);
  return world;
}

MuscleContactState make_contact_state(const MuscleContactWorld& world) {
  return {gracilis::make_contact_state(world.surfaces), make_virtual_edge_state(world.edges)};
}

void forget_contact(const MuscleContactWorld& world, MuscleContactState& state) {
  forget_candidates(state.surfaces);
  state.edges = make_virtual_edge_state(world.edges);
}

}  // namespace gracilis::xpbd
