#pragma once

#include <gracilis/core/parallel.hpp>
#include <gracilis/dynamics/constraints/color_order.hpp>
#include <gracilis/dynamics/particle_order.hpp>
#include <gracilis/dynamics/particles.hpp>

#include <hwy/cache_control.h>

namespace gracilis {

/// Slots per task: large enough to outweigh a task's start, small enough to share a color among cores.
inline constexpr Index slots_per_task = 1024;

/// Has the positions of particles brought near before constraints ask for them in an order that the processor cannot
/// predict.
inline void fetch(const Particles& particles, Index begin, Index end) {
  constexpr Index particles_per_line = 4;
  for (Index p = begin; p < end; p += particles_per_line) hwy::Prefetch(particles.at(p));
}

/// Calls project(range) for all slots: clusters side by side, then what lies across them, one color after the other.
template <class Project>
void for_each_color(const ColorOrder& order, const Particles& particles, const Project& project) {
  const Index clusters = order.cluster_count();
  parallel_for(clusters, 1, [&](Index begin, Index end) {
    for (Index cluster = begin; cluster < end; ++cluster) {
      fetch(particles, begin_of_cluster(cluster, particles.count(), clusters),
            begin_of_cluster(cluster + 1, particles.count(), clusters));
      for (Index color = order.clusters[static_cast<std::size_t>(cluster)];
           color < order.clusters[static_cast<std::size_t>(cluster) + 1]; ++color)
        project(order.colors[static_cast<std::size_t>(color)]);
    }
  });
  for (auto i = static_cast<std::size_t>(order.clusters.back()); i < order.colors.size(); ++i) {
    const ColorRange color = order.colors[i];
    parallel_for(color.end - color.begin, slots_per_task, [&](Index begin, Index end) {
      project(ColorRange{color.begin + begin, color.begin + end});
    });
  }
}

}  // namespace gracilis
