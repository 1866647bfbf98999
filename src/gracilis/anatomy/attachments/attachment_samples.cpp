#include <gracilis/anatomy/attachments/attachment_samples.hpp>

#include <gracilis/geometry/measures.hpp>

#include <algorithm>
#include <cmath>
#include <span>
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
std::vector<Vec3> dense_samples(const TriangleMesh& surface, const std::vector<char>& held, Index count) {
  const Points& x = surface.vertices;
  std::vector<Index> faces;
  Real total = 0;
  for (Index f = 0; f < surface.face_count(); ++f) {
    const Eigen::Vector3i corners = surface.faces.col(f);
    if (!std::all_of(corners.begin(), corners.end(), [&](Index v) { return held[static_cast<std::size_t>(v)]; }))
      continue;
    faces.push_back(f);
    total += area_vector(x, corners).norm() / 2;
  }
  std::vector<Vec3> samples;
  if (!(total > 0)) {
    for (Index v = 0; v < surface.vertex_count(); ++v)
      if (held[static_cast<std::size_t>(v)]) samples.emplace_back(x.col(v));
    return samples;
  }
  // Walk along the triangles' areas in equal steps; where in its triangle each point lies varies regularly, too.
  Real passed = 0;
  Index i = 0;
  for (const Index f : faces) {
    const Eigen::Vector3i corners = surface.faces.col(f);
    passed += area_vector(x, corners).norm() / 2;
    for (; i < count && (i + 0.5) * total / count <= passed; ++i) {
      Real u = std::fmod(0.5 + 0.7548776662466927 * i, 1.0), v = std::fmod(0.5 + 0.5698402909980532 * i, 1.0);
      if (u + v > 1) u = 1 - u, v = 1 - v;
      samples.emplace_back(x.col(corners[0]) * (1 - u - v) + x.col(corners[1]) * u + x.col(corners[2]) * v);
    }
  }
  return samples;
}

/// One sample for each of `count` parts of equal size, halved across their longer way: the nearest to the part's
/// middle.
void take_from_parts(std::span<Vec3> samples, Index count, std::vector<Vec3>& taken) {
  Vec3 mean = Vec3::Zero(), low = samples.front(), high = samples.front();
  for (const Vec3& sample : samples) {
    mean += sample / static_cast<Real>(samples.size());
    low = low.cwiseMin(sample), high = high.cwiseMax(sample);
  }
  if (count == 1) {
    taken.push_back(*std::min_element(samples.begin(), samples.end(), [&](const Vec3& a, const Vec3& b) {
      return (a - mean).squaredNorm() < (b - mean).squaredNorm();
    }));
    return;
  }
  Index axis = 0;
  (high - low).maxCoeff(&axis);
  const Index first = count / 2;
  const std::size_t size = samples.size() * static_cast<std::size_t>(first) / static_cast<std::size_t>(count);
  std::sort(samples.begin(), samples.end(), [&](const Vec3& a, const Vec3& b) { return a[axis] < b[axis]; });
  take_from_parts(samples.first(size), first, taken);
  take_from_parts(samples.subspan(size), count - first, taken);
}

Points even_samples(const TriangleMesh& surface, const std::vector<char>& held, Index count) {
  constexpr Index dense = 20;
  std::vector<Vec3> samples = dense_samples(surface, held, dense * count);
  if (samples.empty() || count == 0) return Points(3, 0);
  // Vertices instead of areas may be fewer than the points asked for.
  const std::size_t given = samples.size();
  while (samples.size() < static_cast<std::size_t>(count)) samples.push_back(samples[samples.size() - given]);
  std::vector<Vec3> taken;
  take_from_parts(samples, count, taken);
  Points points(3, count);
  for (Index i = 0; i < count; ++i) points.col(i) = taken[static_cast<std::size_t>(i)];
  return points;
}

}  // namespace

Points attachment_samples(const Muscle& muscle, AttachmentEnd end, Index count) {
  return even_samples(muscle.surface, attached(muscle, end), count);
}

Points surface_points(const TriangleMesh& surface, Index count) {
  return even_samples(surface, std::vector<char>(static_cast<std::size_t>(surface.vertex_count()), 1), count);
}

Vec3 attachment_center(const Muscle& muscle, AttachmentEnd end) {
  const std::vector<Vec3> samples = dense_samples(muscle.surface, attached(muscle, end), 1000);
  Vec3 sum = Vec3::Zero();
  for (const Vec3& sample : samples) sum += sample;
  return samples.empty() ? sum : Vec3(sum / static_cast<Real>(samples.size()));
}

}  // namespace gracilis
