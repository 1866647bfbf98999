#include <gracilis/core/parallel.hpp>
#include <gracilis/dynamics/solver/bone_contact.hpp>
#include <gracilis/dynamics/solver/constraint_table.hpp>
#include <gracilis/methods/xpbd/mid_solve_snapshot.hpp>

#include <gracilis/core/state_hash.hpp>

#include "benchmark_hip.hpp"

#include <benchmark/benchmark.h>

#include <chrono>
#include <memory>
#include <optional>

/// Milliseconds per inner iteration of each muscle, whole and by kind of constraint, at 45 degrees of flexion.
namespace gracilis {
namespace {

constexpr Real middle = radians(45);

using xpbd::MidSolveSnapshot;

/// A muscle half way through flexion.
MidSolveSnapshot half_way(const Muscle& muscle) {
  constexpr int frames = 45;
  std::vector<Pose> poses;
  for (int frame = 0; frame <= frames; ++frame) poses.push_back(benchmark_hip().flexed(middle * frame / frames));
  const BenchmarkHip& hip = benchmark_hip();
  return xpbd::mid_solve_snapshot(hip.scene, muscle, hip.fields, poses,
                                  xpbd::carrying_strings(hip.scene, muscle, hip.bones));
}

const MidSolveSnapshot& prepared(std::size_t muscle) {
  static std::vector<std::unique_ptr<MidSolveSnapshot>> all(benchmark_hip().scene.muscles.size());
  if (!all[muscle]) all[muscle] = std::make_unique<MidSolveSnapshot>(half_way(benchmark_hip().scene.muscles[muscle]));
  return *all[muscle];
}

/// Iterations that every timing repeats from the same state, so that each does the same work and ends in the same bits.
constexpr int repeats = 10;

void iterate(benchmark::State& timer, std::size_t index, std::optional<ConstraintKind> kind, int threads) {
  const MidSolveSnapshot& begin = prepared(index);
  const ThreadLimit limit(threads);
  SurfaceState state = begin.state;
  SurfaceSolve surface{&begin.muscle.system, &begin.placements, begin.settings, &state, {}};
  for (auto _ : timer) {
    state = begin.state;
    surface.report = {};
    const auto started = std::chrono::steady_clock::now();
    for (int i = 0; i < repeats; ++i) {
      if (kind) {
        project_kind(*kind, surface);
      } else {
        for (const ConstraintRow& row : constraint_table()) project_kind(row.kind, surface);
      }
    }
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - started;
    timer.SetIterationTime(elapsed.count() / repeats);
  }
  char hash[32];
  std::snprintf(hash, sizeof hash, "%016llx", static_cast<unsigned long long>(hash_of(state.particles.xyzw)));
  timer.SetLabel(hash);
  timer.counters["triangles"] = static_cast<double>(benchmark_hip().scene.muscles[index].surface.face_count());
  if (!kind || *kind == ConstraintKind::bone_contact) timer.counters["contacts"] = surface.report.contacts;
}

/// What happens once every few iterations beside them: listing what is near the bones.
void refresh(benchmark::State& timer, std::size_t index, int threads) {
  const MidSolveSnapshot& begin = prepared(index);
  const ThreadLimit limit(threads);
  SurfaceState state = begin.state;
  for (auto _ : timer) {
    const auto started = std::chrono::steady_clock::now();
    refresh_contacts(begin.muscle.system, begin.placements, state);
    timer.SetIterationTime(std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count());
  }
  std::uint64_t hash = hash_seed;
  for (const NearField& near : state.near) hash = hash_of(near.edges.a, hash_of(near.particles, hash));
  char text[32];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
  timer.SetLabel(text);
}

void add(const std::string& name, const std::function<void(benchmark::State&)>& body) {
  benchmark::RegisterBenchmark(name.c_str(), body)->UseManualTime()->Unit(benchmark::kMillisecond);
}

const bool solver_benchmarks_registered = [] {
  const std::vector<Muscle>& muscles = benchmark_hip().scene.muscles;
  for (std::size_t m = 0; m < muscles.size(); ++m)
    for (int threads : {1, 2}) {
      const std::string end = "/threads:" + std::to_string(threads);
      const std::string begin = "iteration/" + muscles[m].name + "/";
      add(begin + "all" + end, [=](benchmark::State& timer) { iterate(timer, m, std::nullopt, threads); });
      // Benchmark muscles are passive and alone: tensions and contact between muscles would take no time, and Google
      // Benchmark repeat them forever.
      for (const ConstraintRow& row : constraint_table())
        if (row.kind != ConstraintKind::tension && row.kind != ConstraintKind::muscle_contact)
          add(begin + row.name + end,
              [=, kind = row.kind](benchmark::State& timer) { iterate(timer, m, kind, threads); });
      add("list_contacts/" + muscles[m].name + end, [=](benchmark::State& timer) { refresh(timer, m, threads); });
    }
  return true;
}();

}  // namespace
}  // namespace gracilis
