#include <gracilis/core/parallel.hpp>
#include <gracilis/core/state_hash.hpp>
#include <gracilis/dynamics/solver/constraint_table.hpp>
#include <gracilis/methods/xpbd/mid_solve_snapshot.hpp>

#include "benchmark_hip.hpp"

// Bullet's headers take liberties that our warnings do not.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wpedantic"
#include <BulletSoftBody/btSoftBody.h>
#pragma GCC diagnostic pop

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <vector>

/// One sweep over all edges of each muscle, half way through flexion: Bullet's links beside our distance constraints,
/// from the same positions, masses and target lengths, one thread, taking turns. Bullet's links have no compliance, so
/// both also say what they reached: the root mean square of the edges' relative error. It has no constraint like our
/// others.
namespace gracilis {
namespace {

constexpr int repeats = 31, in_a_row = 10;

struct Sweep {
  std::vector<double> times;  ///< ms
  double error = 0;
  std::uint64_t hash = 0;
  double median() {
    std::nth_element(times.begin(), times.begin() + repeats / 2, times.end());
    return times[repeats / 2];
  }
};

xpbd::MidSolveSnapshot half_way(const Muscle& muscle) {
  constexpr int frames = 45;
  std::vector<Pose> poses;
  for (int frame = 0; frame <= frames; ++frame) poses.push_back(benchmark_hip().flexed(radians(frame)));
  const BenchmarkHip& hip = benchmark_hip();
  return xpbd::mid_solve_snapshot(hip.scene, muscle, hip.fields, poses,
                                  xpbd::carrying_strings(hip.scene, muscle, hip.bones));
}

/// Edges of the muscle: particles and target lengths.
struct Edges {
  std::vector<std::array<Index, 2>> ends;
  std::vector<float> lengths;
};

Edges edges_of(const xpbd::MidSolveSnapshot& begin) {
  Edges edges;
  const DistanceSet& set = begin.muscle.system.distances;
  for (const Index slot : set.slot) {
    const auto s = static_cast<std::size_t>(slot);
    edges.ends.push_back({set.a[s], set.b[s]});
    edges.lengths.push_back(begin.state.target_length[s]);
  }
  return edges;
}

template <class PositionOf>
double error_of(const Edges& edges, const PositionOf& position) {
  double sum = 0;
  for (std::size_t e = 0; e < edges.ends.size(); ++e) {
    const Eigen::Vector3f along = position(edges.ends[e][1]) - position(edges.ends[e][0]);
    sum += std::pow(static_cast<double>(along.norm()) / static_cast<double>(edges.lengths[e]) - 1, 2);
  }
  return std::sqrt(sum / static_cast<double>(edges.ends.size()));
}

template <class Work>
double time_of(const Work& work) {
  const auto started = std::chrono::steady_clock::now();
  for (int i = 0; i < in_a_row; ++i) work();
  const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - started;
  return elapsed.count() / in_a_row;
}

btVector3 to_bullet(const Eigen::Vector3f& x) { return {x[0], x[1], x[2]}; }

void put_back(const xpbd::MidSolveSnapshot& begin, btSoftBody& body) {
  for (int p = 0; p < body.m_nodes.size(); ++p) body.m_nodes[p].m_x = to_bullet(begin.state.particles.position(p));
}

void fill(const xpbd::MidSolveSnapshot& begin, const Edges& edges, btSoftBody& body) {
  for (const auto& [a, b] : edges.ends) body.appendLink(a, b);
  body.updateConstants();
  for (int e = 0; e < body.m_links.size(); ++e) {
    btSoftBody::Link& link = body.m_links[e];
    link.m_rl = edges.lengths[static_cast<std::size_t>(e)];
    link.m_c1 = link.m_rl * link.m_rl;
  }
  for (int p = 0; p < body.m_nodes.size(); ++p) body.m_nodes[p].m_im = begin.state.particles.inverse_mass(p);
  body.updateLinkConstants();
}

void compare(const Muscle& muscle) {
  const xpbd::MidSolveSnapshot begin = half_way(muscle);
  const Edges edges = edges_of(begin);
  const Index count = begin.state.particles.count();
  std::vector<btVector3> positions;
  for (Index p = 0; p < count; ++p) positions.push_back(to_bullet(begin.state.particles.position(p)));
  const std::vector<btScalar> masses(positions.size(), 1);
  btSoftBodyWorldInfo world;
  btSoftBody body(&world, count, positions.data(), masses.data());
  fill(begin, edges, body);

  Sweep ours, theirs;
  SurfaceState state;
  for (int repeat = 0; repeat < repeats; ++repeat) {
    put_back(begin, body);
    theirs.times.push_back(time_of([&] { btSoftBody::PSolve_Links(&body, 1, 0); }));
    state = begin.state;
    SurfaceSolve surface{&begin.muscle.system, &begin.placements, begin.settings, &state, {}};
    ours.times.push_back(time_of([&] { project_kind(ConstraintKind::distance, surface); }));
  }
  const auto bullet_position = [&](Index p) {
    const btVector3& x = body.m_nodes[p].m_x;
    return Eigen::Vector3f(static_cast<float>(x.x()), static_cast<float>(x.y()), static_cast<float>(x.z()));
  };
  std::vector<float> end;
  for (Index p = 0; p < count; ++p)
    for (const float x : bullet_position(p)) end.push_back(x);
  theirs.error = error_of(edges, bullet_position);
  theirs.hash = hash_of(end);
  ours.error = error_of(edges, [&](Index p) -> Eigen::Vector3f { return state.particles.position(p); });
  ours.hash = hash_of(state.particles.xyzw);
  const double before = error_of(edges, [&](Index p) -> Eigen::Vector3f { return begin.state.particles.position(p); });
  const double own = ours.median(), peer = theirs.median();
  fmt::print("| {} | {} | {:.4f} | {:.4f} | {:.1f} | {:.4f} | {:.4f} | {:.4f} | `{:016x}` | `{:016x}` |\n", muscle.name,
             muscle.surface.face_count(), own, peer, peer / own, before, ours.error, theirs.error, ours.hash,
             theirs.hash);
}

}  // namespace
}  // namespace gracilis

int main() {
  const gracilis::ThreadLimit limit(1);
  for (const gracilis::Muscle& muscle : gracilis::benchmark_hip().scene.muscles) gracilis::compare(muscle);
}
