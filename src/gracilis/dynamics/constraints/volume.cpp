#include <gracilis/dynamics/constraints/volume.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/dynamics/vertex_faces.hpp>

#include <algorithm>
#include <array>
#include <cassert>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "gracilis/dynamics/constraints/volume.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, as Highway asks.
#include <gracilis/dynamics/simd/particle_lanes-inl.hpp>

#ifndef GRACILIS_VOLUME_PARTIAL
#define GRACILIS_VOLUME_PARTIAL
namespace gracilis {
namespace {

/// Sums over one chunk of groups; chunks are added in order, so the result does not depend on threads.
struct VolumePartial {
  double volume = 0, weighted_gradient2 = 0;
};

}  // namespace
}  // namespace gracilis
#endif

HWY_BEFORE_NAMESPACE();
namespace gracilis::HWY_NAMESPACE {

/// 6 ∂V/∂x_v = Σ over the ring (x_i - x_v) × (x_{i+1} - x_v), and V = Σ_v x_v·∂V/∂x_v / 3, for the groups [begin, end).
/// Gradients are stored like particles, four floats each.
VolumePartial gather_gradients(const VolumeSet& set, const Particles& particles, Index begin, Index end,
                               float* gradients) {
  const D d;
  const auto lanes = static_cast<Index>(hn::Lanes(d));
  VolumePartial partial;
  for (Index group = begin; group < end; ++group) {
    const Index first = set.ring_offsets[static_cast<std::size_t>(group)],
                last = set.ring_offsets[static_cast<std::size_t>(group) + 1];
    for (Index lane = 0; lane < group_width; lane += lanes) {
      const Index* own = set.particles.data() + group * group_width + lane;
      const auto neighbor = [&](Index step) {
        return load_particles(particles.xyzw.data(), set.ring.data() + step * group_width + lane).x;
      };
      const LoadedParticles at = load_particles(particles.xyzw.data(), own);
      Point sum = {hn::Zero(d), hn::Zero(d), hn::Zero(d)};
      if (first < last) {
        Point previous = neighbor(first) - at.x;
        for (Index step = first + 1; step < last; ++step) {
          const Point next = neighbor(step) - at.x;
          sum = sum + cross(previous, next);
          previous = next;
        }
      }
      const Point gradient = scaled(hn::Set(d, 1.0f / 6), sum);
      store_particles(gradients, own, gradient, hn::Zero(d));
      partial.volume += static_cast<double>(hn::GetLane(hn::SumOfLanes(d, dot<Math>(at.x, gradient)))) / 3;
      partial.weighted_gradient2 +=
          static_cast<double>(hn::GetLane(hn::SumOfLanes(d, at.w * dot<Math>(gradient, gradient))));
    }
  }
  return partial;
}

}  // namespace gracilis::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gracilis {

HWY_EXPORT(gather_gradients);

namespace {

/// Vertices sorted by the length of their rings stay within so many places of each other, so that a group's particles
/// are near each other in memory.
constexpr std::ptrdiff_t sorting_window = 16 * group_width;

/// The neighbors of a particle in turn, the first once more at the end; none where it has no faces.
void chain(const VertexFaces& vertex_faces, Index particle, std::vector<Index>& ring) {
  ring.clear();
  const Index begin = vertex_faces.offsets[static_cast<std::size_t>(particle)];
  const auto count = static_cast<Index>(vertex_faces.around(particle).size());
  if (count == 0) return;
  // Each face says: after its first end comes its second.
  const auto after = [&](Index neighbor) {
    Index i = begin;
    while (i < begin + count && vertex_faces.ends(0, i) != neighbor) ++i;
    assert(i < begin + count && "the surface is not closed");
    return vertex_faces.ends(1, i);
  };
  Index next = vertex_faces.ends(0, begin);
  for (Index i = 0; i < count; ++i, next = after(next)) ring.push_back(next);
  ring.push_back(ring.front());
}

}  // namespace

VolumeSet build_volume_set(const Eigen::Matrix3Xi& faces, Index particle_count, Real target, Real compliance) {
  const VertexFaces vertex_faces = build_vertex_faces(faces, particle_count);
  const auto face_count = [&](Index p) { return vertex_faces.around(p).size(); };
  std::vector<Index> order;
  for (Index p = 0; p < particle_count; ++p)
    if (face_count(p) > 0) order.push_back(p);
  for (auto begin = order.begin(); begin != order.end();) {
    const auto end = begin + std::min(sorting_window, order.end() - begin);
    std::stable_sort(begin, end, [&](Index l, Index r) { return face_count(l) < face_count(r); });
    begin = end;
  }
  const auto width = static_cast<std::size_t>(group_width);
  order.resize((order.size() + width - 1) / width * width, particle_count);

  VolumeSet set;
  set.target = target;
  set.compliance = compliance;
  set.particles.assign(order.begin(), order.end());
  set.ring_offsets.push_back(0);
  const auto steps_of = [&](std::size_t group) {
    std::size_t steps = 1;
    for (std::size_t lane = 0; lane < width; ++lane)
      if (order[group + lane] < particle_count) steps = std::max(steps, face_count(order[group + lane]) + 1);
    return steps;
  };
  std::size_t all_steps = 0;
  for (std::size_t group = 0; group < order.size(); group += width) all_steps += steps_of(group);
  set.ring.reserve(all_steps * width);
  std::array<std::vector<Index>, group_width> rings;
  for (std::size_t group = 0; group < order.size(); group += width) {
    const std::size_t steps = steps_of(group);
    for (std::size_t lane = 0; lane < width; ++lane) {
      const Index p = order[group + lane];
      if (p == particle_count)
        rings[lane] = {p};  // idle
      else
        chain(vertex_faces, p, rings[lane]);
    }
    for (std::size_t step = 0; step < steps; ++step)
      for (const std::vector<Index>& ring : rings) set.ring.push_back(ring[std::min(step, ring.size() - 1)]);
    set.ring_offsets.push_back(static_cast<Index>(set.ring.size() / width));
  }
  return set;
}

namespace {

/// Groups and particles per task.
constexpr Index group_chunk = 128, chunk = group_chunk * group_width;

VolumePartial gather(const VolumeSet& set, const Particles& particles, AlignedVector<float>& gradients) {
  gradients.resize(particles.xyzw.size());
  std::vector<VolumePartial> partials(static_cast<std::size_t>((set.group_count() + group_chunk - 1) / group_chunk));
  parallel_for(set.group_count(), group_chunk, [&](Index begin, Index end) {
    for (Index from = begin; from < end; from += group_chunk)
      partials[static_cast<std::size_t>(from / group_chunk)] = HWY_DYNAMIC_DISPATCH(gather_gradients)(
          set, particles, from, std::min(from + group_chunk, end), gradients.data());
  });
  VolumePartial sum;
  for (const VolumePartial& partial : partials) {
    sum.volume += partial.volume;
    sum.weighted_gradient2 += partial.weighted_gradient2;
  }
  return sum;
}

}  // namespace

double enclosed_volume(const VolumeSet& set, AlignedVector<float>& gradients, const Particles& particles) {
  return gather(set, particles, gradients).volume;
}

double project_volume(const VolumeSet& set, double time_step, double pressure, double& lambda,
                      AlignedVector<float>& gradients, Particles& particles) {
  const VolumePartial sum = gather(set, particles, gradients);
  const double alpha = set.compliance / (time_step * time_step);
  const double denominator = sum.weighted_gradient2 + alpha;
  if (!(denominator > 0)) return sum.volume;
  const double step = (-(sum.volume - pressure * set.target) - alpha * lambda) / denominator;
  lambda += step;
  parallel_for(particles.count(), chunk, [&](Index begin, Index end) {
    for (Index v = begin; v < end; ++v) {
      Eigen::Map<Eigen::Vector4f, Eigen::Aligned16> x(particles.at(v));
      x += x[3] * static_cast<float>(step) *
           Eigen::Map<const Eigen::Vector4f, Eigen::Aligned16>(gradients.data() + 4 * static_cast<std::size_t>(v));
    }
  });
  return sum.volume;
}

}  // namespace gracilis
#endif
