#pragma once

#include <gracilis/dynamics/constraint_sets.hpp>
#include <gracilis/dynamics/particles.hpp>
#include <gracilis/geometry/distance_field.hpp>

#include <vector>

namespace gracilis {

/// Keeps particles, and the midpoints of distance constraints, out of a rigid obstacle: C = d(x) - gap >= 0, without
/// compliance. A gap may be negative where the data overlap at rest: the overlap may stay but not grow.
struct FieldContactSet {
  const DistanceField* field = nullptr;  ///< in the obstacle's frame; must outlive the set
  std::vector<float> particle_gap;       ///< m, one per particle
  std::vector<float> edge_gap;           ///< m, one per distance slot; empty: edges are not tested
};

/// Carries the particles' frame into the obstacle's: q = rotation x + translation.
struct FieldPlacement {
  Eigen::Matrix3f rotation = Eigen::Matrix3f::Identity();
  Eigen::Vector3f translation = Eigen::Vector3f::Zero();
};

/// Those close enough to the obstacle to be tested in every iteration, found anew every few.
struct NearField {
  std::vector<Index> particles;
  std::vector<Index> edges;             ///< distance slots, grouped by color
  std::vector<ColorRange> edge_colors;  ///< ranges in `edges`
};

/// Lists what is within `reach` (m) of touching: movable particles, and edges with a movable end.
void find_near(const FieldContactSet& set, const DistanceSet& distances, const FieldPlacement& placement,
               const Particles& particles, float reach, NearField& near);

/// Pushes edge midpoints, then particles, out along the field's gradient. Returns how many were touching.
Index project_edge_contacts(const FieldContactSet& set, const DistanceSet& distances, const FieldPlacement& placement,
                            const NearField& near, Particles& particles);
Index project_particle_contacts(const FieldContactSet& set, const FieldPlacement& placement, const NearField& near,
                                Particles& particles);

}  // namespace gracilis
