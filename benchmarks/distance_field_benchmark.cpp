#include <gracilis/anatomy/overlap/bone_field.hpp>
#include <gracilis/core/parallel.hpp>

#include <gracilis/core/state_hash.hpp>

#include "benchmark_hip.hpp"

#include <benchmark/benchmark.h>

#include <random>

/// Building the distance fields of the bones, and asking them.
namespace gracilis {
namespace {

void label(benchmark::State& timer, std::uint64_t hash) {
  char text[32];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
  timer.SetLabel(text);
}

void build(benchmark::State& timer, std::size_t bone, int threads) {
  const BenchmarkHip& hip = benchmark_hip();
  const ThreadLimit limit(threads);
  DistanceField field;
  for (auto _ : timer) field = build_bone_field(hip.scene.bones[bone], hip.scene.distance_fields);
  label(timer, hash_of(field.values));
  timer.counters["nodes"] = static_cast<double>(field.values.size());
}

/// Points within 5 mm of the bone's surface, in the order of its vertices: as near each other as a muscle's are.
std::vector<Eigen::Vector3f> points_near(const Bone& bone) {
  std::mt19937 generator(1);
  std::uniform_real_distribution<Real> uniform(-0.005, 0.005);
  std::vector<Eigen::Vector3f> points;
  for (Index v = 0; v < bone.surface.vertex_count(); ++v)
    points.push_back((bone.surface.vertices.col(v) + Vec3(uniform(generator), uniform(generator), uniform(generator)))
                         .cast<float>());
  return points;
}

void query(benchmark::State& timer, std::size_t bone) {
  const BenchmarkHip& hip = benchmark_hip();
  const std::vector<Eigen::Vector3f> points = points_near(hip.scene.bones[bone]);
  std::vector<FieldSample> answers(points.size());
  for (auto _ : timer) {
    for (std::size_t i = 0; i < points.size(); ++i) answers[i] = sample(hip.fields[bone], points[i]);
    benchmark::DoNotOptimize(answers.data());
    benchmark::ClobberMemory();
  }
  std::uint64_t hash = hash_seed;
  for (const FieldSample& answer : answers) {
    hash = hash_bytes(&answer.distance, sizeof answer.distance, hash);
    hash = hash_of(answer.gradient, hash);
  }
  label(timer, hash);
  timer.counters["per_query"] = benchmark::Counter(
      static_cast<double>(points.size()), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

const bool field_benchmarks_registered = [] {
  const std::vector<Bone>& bones = benchmark_hip().scene.bones;
  for (std::size_t b = 0; b < bones.size(); ++b) {
    for (int threads : {1, 2}) {
      const std::string name = "build_field/" + bones[b].name + "/threads:" + std::to_string(threads);
      benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& timer) { build(timer, b, threads); })
          ->UseRealTime()
          ->Unit(benchmark::kMillisecond)
          ->Iterations(1);
    }
    benchmark::RegisterBenchmark(("query_field/" + bones[b].name).c_str(), [=](benchmark::State& timer) {
      query(timer, b);
    })->Unit(benchmark::kMicrosecond);
  }
  return true;
}();

}  // namespace
}  // namespace gracilis
