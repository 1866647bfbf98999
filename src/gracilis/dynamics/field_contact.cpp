#include <gracilis/dynamics/field_contact.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/dynamics/field_contact_guard.hpp>
#include <gracilis/dynamics/field_contact_points.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

namespace gracilis {

namespace {

constexpr Index chunk = 512;
constexpr float infinity = std::numeric_limits<float>::infinity();
/// On the field's ridges the interpolated gradient fades; there is no way out to be read from it.
constexpr float least_slope2 = 1e-4f;
/// A distance exceeds its ceiling only by more than this, m.
constexpr float rounding = 1e-7f;
/// How the deepest point of an edge is followed: the step is the slope along the edge times this, at most a quarter of
/// a cell.
constexpr float follow_radius = 0.004f;

}  // namespace

Index project_edge_contacts(const FieldContactSet& set, const DistanceSet& distances, const FieldPlacement& placement,
                            NearField& near, Particles& particles) {
  std::atomic<Index> touching = 0;
  const float longest_step = safe_step(*set.field.field) / 2;
  const std::vector<float>&sag = set.captured.edge_sag, &released = set.released.edge_sag;
  for (const ColorRange& color : near.edge_colors)
    parallel_for(color.end - color.begin, chunk, [&](Index begin, Index end) {
      Index count = 0;
      for (Index i = color.begin + begin; i < color.begin + end; ++i) {
        const auto slot = static_cast<std::size_t>(near.edges[static_cast<std::size_t>(i)]);
        const Index a = distances.a[slot], b = distances.b[slot];
        const float wa = particles.inverse_mass(a), wb = particles.inverse_mass(b);
        DeepestPoint& deepest = near.edge_points[static_cast<std::size_t>(i)];
        float& t = deepest.t;
        const Eigen::Vector3f xa = particles.position(a), along = particles.position(b) - xa;
        Eigen::Vector3f q = placement.to_obstacle(xa + (t == unknown_point ? 0.5f : t) * along);
        if (!may_reach(deepest.seen, q, edge_reserve)) continue;
        const float ga = near.gap[static_cast<std::size_t>(a)], gb = near.gap[static_cast<std::size_t>(b)];
        const float low = lowest_share(wa), high = 1 - lowest_share(wb);
        if (t == unknown_point) {
          t = deepest_on_edge(set.field.grid, {placement.to_obstacle(xa), ga}, {placement.to_obstacle(xa + along), gb},
                              low, high);
          q = placement.to_obstacle(xa + t * along);
        }
        const FieldSample at = sample(set.field.grid, q);
        const float slope2 = at.gradient.squaredNorm();
        if (slope2 < least_slope2) continue;
        const Eigen::Vector3f gradient = placement.rotation.transpose() * at.gradient;
        const float depth =
            ga + t * (gb - ga) + sag[slot] + placement.release * (released[slot] - sag[slot]) - at.distance;
        deepest.seen = {q, -depth};
        const float length2 = along.squaredNorm(), here = t;
        if (length2 > 0) {
          const float length = std::sqrt(length2), slope = (gradient.dot(along) - gb + ga) / length;
          const float step = std::clamp(follow_radius * slope, -longest_step, longest_step) / length;
          t = std::clamp(t - step, low, high);
        }
        if (!(depth > 0)) continue;
        ++count;
        const Eigen::Vector3f push = gradient * (depth / slope2 / (wa * (1 - here) * (1 - here) + wb * here * here));
        particles.position(a) += wa * (1 - here) * push;
        particles.position(b) += wb * here * push;
      }
      touching += count;
    });
  return touching;
}

Index project_face_contacts(const FieldContactSet& set, const FaceSet& faces, const FieldPlacement& placement,
                            NearField& near, Particles& particles) {
  std::atomic<Index> touching = 0;
  const std::vector<float>&sag = set.captured.face_sag, &released = set.released.face_sag;
  for (const ColorRange& color : near.face_colors)
    parallel_for(color.end - color.begin, chunk, [&](Index begin, Index end) {
      Index count = 0;
      for (Index i = color.begin + begin; i < color.begin + end; ++i) {
        const auto slot = static_cast<std::size_t>(near.faces[static_cast<std::size_t>(i)]);
        const Eigen::Vector3f where = near.face_points[static_cast<std::size_t>(i)];
        Eigen::Vector3f x = Eigen::Vector3f::Zero();
        float gap = sag[slot] + placement.release * (released[slot] - sag[slot]), sum = 0;
        for (int k = 0; k < 3; ++k) {
          const Index p = faces.particles[static_cast<std::size_t>(k)][slot];
          x += where[k] * particles.position(p);
          gap += where[k] * near.gap[static_cast<std::size_t>(p)];
          sum += where[k] * where[k] * particles.inverse_mass(p);
        }
        const FieldSample at = sample(set.field.grid, placement.to_obstacle(x));
        const float slope2 = at.gradient.squaredNorm();
        if (!(at.distance < gap) || slope2 < least_slope2 || !(sum > 0)) continue;
        ++count;
        const Eigen::Vector3f push =
            placement.rotation.transpose() * at.gradient * ((gap - at.distance) / slope2 / sum);
        for (int k = 0; k < 3; ++k) {
          const Index p = faces.particles[static_cast<std::size_t>(k)][slot];
          particles.position(p) += particles.inverse_mass(p) * where[k] * push;
        }
      }
      touching += count;
    });
  return touching;
}

Index project_particle_contacts(const FieldContactSet& set, const FieldPlacement& placement, NearField& near,
                                Particles& particles) {
  std::atomic<Index> touching = 0;
  const auto cell = static_cast<float>(set.field.field->cell_size.maxCoeff());
  parallel_for(static_cast<Index>(near.particles.size()), chunk, [&](Index begin, Index end) {
    Index count = 0;
    for (Index i = begin; i < end; ++i) {
      const Index particle = near.particles[static_cast<std::size_t>(i)];
      const auto p = static_cast<std::size_t>(particle);
      const float gap = near.gap[p];
      const Eigen::Vector3f moved = placement.to_obstacle(particles.position(particle));
      const float ceiling = set.ceiling.empty() ? infinity : set.ceiling[p];
      if (ceiling == infinity && !may_reach(near.last[p], moved, gap + cell)) continue;
      Eigen::Vector3f q = guarded(set, near.last[p], moved, gap);
      const FieldSample at = sample_bounded(set.field, q);
      const float slope2 = at.gradient.squaredNorm();
      const float wanted = at.distance < gap ? gap : at.distance > ceiling + rounding ? ceiling : at.distance;
      const bool pushed = wanted != at.distance && slope2 > least_slope2;
      if (pushed) q += at.gradient * ((wanted - at.distance) / slope2);
      near.last[p] = {q, pushed ? wanted : at.distance};
      if (q == moved) continue;
      ++count;
      particles.position(particle) += placement.rotation.transpose() * (q - moved);
    }
    touching += count;
  });
  return touching;
}

}  // namespace gracilis
