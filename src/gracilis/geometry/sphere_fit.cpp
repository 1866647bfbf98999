#include <gracilis/geometry/sphere_fit.hpp>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace gracilis {
namespace {

constexpr Real near_share = 0.04;    // of the radius
constexpr Real near_normal = 0.906;  // cosine of 25 degrees
constexpr int guess_count = 3000, rounds = 15;
constexpr Index judged_samples = 700;

bool covers(const SurfaceSamples& samples, Index i, const Vec3& center, Real radius) {
  const Vec3 out = samples.points.col(i) - center;
  const Real distance = out.norm();
  return std::abs(distance - radius) < near_share * radius && out.dot(samples.normals.col(i)) > near_normal * distance;
}

Real covered_share(const SurfaceSamples& samples, const Vec3& center, Real radius) {
  Real area = 0;
  for (Index i = 0; i < samples.count(); ++i)
    if (covers(samples, i, center, radius)) area += samples.areas[i];
  return area / (4 * pi * radius * radius);
}

/// The sphere whose normals are those of two samples, as nearly as can be.
SphereFit through(const SurfaceSamples& samples, Index i, Index j) {
  const Vec3 apart = samples.points.col(i) - samples.points.col(j);
  const Vec3 turned = samples.normals.col(i) - samples.normals.col(j);
  if (turned.squaredNorm() < 0.02) return {};
  SphereFit sphere;
  sphere.radius = apart.dot(turned) / turned.squaredNorm();
  sphere.center = (samples.points.col(i) + samples.points.col(j)) / 2 -
                  sphere.radius * (samples.normals.col(i) + samples.normals.col(j)) / 2;
  return sphere;
}

/// About `max_count` samples, evenly.
SurfaceSamples thinned(const SurfaceSamples& samples, Index max_count) {
  const Index step = std::max<Index>(1, samples.count() / max_count);
  SurfaceSamples some = samples.kept([&](Index i) { return i % step == 0; });
  some.areas *= samples.areas.sum() / some.areas.sum();
  return some;
}

/// Least squares over what covers it: |p|² = 2 c·p + (r² - |c|²), linear in c and the last term.
void refine(const SurfaceSamples& samples, SphereFit& sphere) {
  for (int round = 0; round < rounds; ++round) {
    Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
    Eigen::Vector4d right = Eigen::Vector4d::Zero();
    Index count = 0;
    for (Index i = 0; i < samples.count(); ++i) {
      if (!covers(samples, i, sphere.center, sphere.radius)) continue;
      const Vec3 p = samples.points.col(i) - sphere.center;
      const Eigen::Vector4d row(2 * p[0], 2 * p[1], 2 * p[2], sphere.radius);
      normal += samples.areas[i] * row * row.transpose();
      right += samples.areas[i] * p.squaredNorm() * row;
      ++count;
    }
    if (count < 8) return;
    const Eigen::Vector4d solved = normal.ldlt().solve(right);
    const Vec3 moved = solved.head<3>();
    const Real squared = solved[3] * sphere.radius + moved.squaredNorm();
    if (!solved.allFinite() || !(squared > 0)) return;
    sphere.center += moved;
    sphere.radius = std::sqrt(squared);
  }
}

void measure(const SurfaceSamples& samples, SphereFit& sphere) {
  Real squares = 0, area = 0;
  for (Index i = 0; i < samples.count(); ++i) {
    if (!covers(samples, i, sphere.center, sphere.radius)) continue;
    const Real off = (samples.points.col(i) - sphere.center).norm() - sphere.radius;
    squares += samples.areas[i] * off * off;
    area += samples.areas[i];
  }
  sphere.share = area / (4 * pi * sphere.radius * sphere.radius);
  sphere.residual = area > 0 ? std::sqrt(squares / area) : 0;
}

}  // namespace

SphereFit fit_sphere(const SurfaceSamples& samples, Real radius_min, Real radius_max, const SphereLiking& liking) {
  if (samples.count() < 8) return {};
  const SurfaceSamples judged = thinned(samples, judged_samples);
  SphereFit best;
  Real highest = 0;
  std::uint64_t state = 1;
  const auto next = [&] {
    state = state * 6364136223846793005u + 1442695040888963407u;  // Knuth's MMIX
    return static_cast<Index>((state >> 33) % static_cast<std::uint64_t>(judged.count()));
  };
  for (int guess = 0; guess < guess_count; ++guess) {
    const Index i = next(), j = next();
    const SphereFit sphere = through(judged, i, j);
    if (!(sphere.radius >= radius_min && sphere.radius <= radius_max)) continue;
    const Real worth = liking ? liking(sphere.center, sphere.radius) : 1;
    if (worth <= 0) continue;
    const Real score = worth * covered_share(judged, sphere.center, sphere.radius);
    if (score > highest) highest = score, best = sphere;
  }
  if (highest <= 0) return {};
  refine(samples, best);
  if (!(best.radius >= radius_min && best.radius <= radius_max)) return {};  // a part of a larger or smaller one
  measure(samples, best);
  return best;
}

}  // namespace gracilis
