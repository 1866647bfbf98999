#include <gracilis/anatomy/attachment_samples.hpp>

#include <gracilis/geometry/measures.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace gracilis {

namespace {

std::vector<char> attached(const Muscle& muscle, AttachmentEnd end) {
  std::vector<char> held(static_cast<std::size_t>(muscle.surface.vertex_count()), 0);
  for (const Attachment& attachment : muscle.attachments)
    if (attachment.end == end)
      for (const Index v : attachment.vertices) held[static_cast<std::size_t>(v)] = 1;
  return held;
}

/// Points that stand for equal areas each, in the order of the triangles.
std::vector<Vec3> dense_samples(const Muscle& muscle, AttachmentEnd end, Index count) {
  const std::vector<char> held = attached(muscle, end);
  const Points& x = muscle.surface.vertices;
  std::vector<Index> faces;
  Real total = 0;
  for (Index f = 0; f < muscle.surface.face_count(); ++f) {
    const Eigen::Vector3i corners = muscle.surface.faces.col(f);
    if (!std::all_of(corners.begin(), corners.end(), [&](Index v) { return held[static_cast<std::size_t>(v)]; }))
      continue;
    faces.push_back(f);
    total += area_vector(x, corners).norm() / 2;
  }
  std::vector<Vec3> samples;
  if (!(total > 0)) {
    for (Index v = 0; v < muscle.surface.vertex_count(); ++v)
      if (held[static_cast<std::size_t>(v)]) samples.emplace_back(x.col(v));
    return samples;
  }
  // Walk along the triangles' areas in equal steps; where in its triangle each point lies varies regularly, too.
  Real passed = 0;
  Index i = 0;
  for (const Index f : faces) {
    const Eigen::Vector3i corners = muscle.surface.faces.col(f);
    passed += area_vector(x, corners).norm() / 2;
    for (; i < count && (i + 0.5) * total / count <= passed; ++i) {
      Real u = std::fmod(0.5 + 0.7548776662466927 * i, 1.0), v = std::fmod(0.5 + 0.5698402909980532 * i, 1.0);
      if (u + v > 1) u = 1 - u, v = 1 - v;
      samples.emplace_back(x.col(corners[0]) * (1 - u - v) + x.col(corners[1]) * u + x.col(corners[2]) * v);
    }
  }
  return samples;
}

}  // namespace

Points attachment_samples(const Muscle& muscle, AttachmentEnd end, Index count) {
  constexpr int rounds = 15, dense = 20;
  const std::vector<Vec3> samples = dense_samples(muscle, end, dense * count);
  if (samples.empty() || count == 0) return Points(3, 0);
  Points centers(3, count);
  const auto size = static_cast<Index>(samples.size());
  for (Index i = 0; i < count; ++i)
    centers.col(i) = samples[static_cast<std::size_t>((static_cast<long>(2 * i + 1) * size / (2 * count)) % size)];
  if (size <= count) return centers;

  for (int round = 0; round < rounds; ++round) {
    Points sums = Points::Zero(3, count);
    Eigen::VectorXd counts = Eigen::VectorXd::Zero(count);
    for (const Vec3& sample : samples) {
      Index nearest = 0;
      (centers.colwise() - sample).colwise().squaredNorm().minCoeff(&nearest);
      sums.col(nearest) += sample;
      counts[nearest] += 1;
    }
    for (Index i = 0; i < count; ++i)
      if (counts[i] > 0) centers.col(i) = sums.col(i) / counts[i];
  }
  // Means of points on a curved surface lie off it: take the nearest sample, each once.
  std::vector<char> taken(samples.size(), 0);
  for (Index i = 0; i < count; ++i) {
    std::size_t best = samples.size();
    for (std::size_t s = 0; s < samples.size(); ++s) {
      if (taken[s]) continue;
      if (best == samples.size() ||
          (samples[s] - centers.col(i)).squaredNorm() < (samples[best] - centers.col(i)).squaredNorm())
        best = s;
    }
    taken[best] = 1;
    centers.col(i) = samples[best];
  }
  return centers;
}

Vec3 attachment_center(const Muscle& muscle, AttachmentEnd end) {
  const std::vector<Vec3> samples = dense_samples(muscle, end, 1000);
  Vec3 sum = Vec3::Zero();
  for (const Vec3& sample : samples) sum += sample;
  return samples.empty() ? sum : Vec3(sum / static_cast<Real>(samples.size()));
}

}  // namespace gracilis
