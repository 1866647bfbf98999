#include <gracilis/core/parallel.hpp>
#include <gracilis/methods/xpbd/xpbd_method.hpp>

#include <gracilis/core/state_hash.hpp>

#include "benchmark_hip.hpp"

#include <benchmark/benchmark.h>

#include <chrono>
#include <ctime>
#include <map>
#include <memory>

/// Milliseconds per frame of a whole hip by each way of keeping muscles out of each other, through 90 degrees of
/// flexion in steps of 3 degrees.
namespace gracilis {
namespace {

constexpr int frames = 30;
constexpr Real whole = radians(90);

/// The built-in hip, and the cadaver's where its data are.
const std::map<std::string, const BenchmarkHip*>& hips() {
  static const std::map<std::string, const BenchmarkHip*> all = [] {
    std::map<std::string, const BenchmarkHip*> found = {{"builtin", &builtin_benchmark_hip()}};
    if (cadaver_is_there()) found["cadaver"] = &benchmark_hip();
    return found;
  }();
  return all;
}

void flex(benchmark::State& timer, const BenchmarkHip& hip, const std::string& contact, int threads) {
  const ThreadLimit limit(threads);
  Scene scene = hip.scene;
  scene.method.contact["muscle"] = contact;
  const auto method = make_xpbd_method(scene, hip.fields);
  std::vector<Pose> poses;
  for (int frame = 1; frame <= frames; ++frame) poses.push_back(hip.flexed(whole * frame / frames));
  StepReport report;
  double processor = 0;
  for (auto _ : timer) {
    method->reset();
    const std::clock_t processor_before = std::clock();
    const auto started = std::chrono::steady_clock::now();
    for (const Pose& pose : poses) report = method->advance(pose, usual_time_step);
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - started;
    processor = static_cast<double>(std::clock() - processor_before) / CLOCKS_PER_SEC;
    timer.SetIterationTime(elapsed.count() / frames);
  }
  Frame end;
  method->write(end);
  std::uint64_t hash = hash_seed;
  Real edges = 0, pushes = 0;
  for (std::size_t m = 0; m < end.muscles.size(); ++m) {
    hash = hash_of(end.muscles[m].points, hash);
    edges += metric(report.muscles[m].metrics, "virtual_edges");
    pushes += metric(report.muscles[m].metrics, "virtual_pushes");
  }
  char text[32];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
  timer.SetLabel(text);
  timer.counters["processor_ms"] = 1000 * processor / frames;
  if (contact != "virtual-edges") return;
  // Both muscles of a pair count its edges.
  timer.counters["edges"] = edges / 2.0;
  timer.counters["pushes"] = pushes / 2.0;
}

const bool registered = [] {
  for (const auto& [name, hip] : hips())
    for (const std::string contact : {"none", "surface", "virtual-edges"})
      for (int threads : {1, 2}) {
        const std::string full = "frame/" + name + "/" + contact + "/threads:" + std::to_string(threads);
        benchmark::RegisterBenchmark(
            full.c_str(),
            [hip = hip, contact, threads](benchmark::State& timer) { flex(timer, *hip, contact, threads); })
            ->UseManualTime()
            ->Unit(benchmark::kMillisecond)
            ->Iterations(1);
      }
  return true;
}();

}  // namespace
}  // namespace gracilis
