#pragma once

#include <gracilis/dynamics/contact/field/field_contact.hpp>
#include <gracilis/dynamics/contact/field/field_contact_near.hpp>

#include "systems_for_tests.hpp"

#include <algorithm>
#include <vector>

/// Contact with a ball about the origin.
namespace gracilis {

inline constexpr Real radius = 0.03;  ///< m

inline const DistanceField& ball() {
  static const DistanceField field = field_of_ball(radius, 101);
  return field;
}

/// Particles among which the ball lies.
struct Scenario {
  Particles particles;
  DistanceSet distances;
  FaceSet faces;
  FieldContactSet contact;
  FieldPlacement placement;
  NearField near;

  void look() { find_near(contact, distances, faces, placement, 0.006f, particles, near); }
  Index push_particles() { return project_particle_contacts(contact, placement, near, particles); }
  /// Listed edges without the padding.
  Index near_edges() const {
    return static_cast<Index>(
        std::count_if(near.edges.a.begin(), near.edges.a.end(), [&](Index a) { return a < particles.count(); }));
  }
  Index push_edges() { return project_edge_contacts(contact, placement, near, particles); }
  Index push_faces() { return project_face_contacts(contact, faces, placement, near, particles); }
  Real radius_of(Index i) const { return (placement.rotation * particles.position(i) + placement.translation).norm(); }
};

inline void set_gap(FieldContactSet& contact, std::size_t count, float gap) {
  contact.captured.particle.assign(count, gap);
  contact.released.particle.assign(count, gap);
}

inline Scenario points_at(const std::vector<Vec3>& positions, const std::vector<Real>& inverse_masses, float gap) {
  Scenario scenario;
  Points x(3, static_cast<Index>(positions.size()));
  for (std::size_t i = 0; i < positions.size(); ++i) x.col(static_cast<Index>(i)) = positions[i];
  scenario.particles =
      make_particles(x, Eigen::Map<const Eigen::VectorXd>(inverse_masses.data(), static_cast<Index>(x.cols())));
  scenario.contact.field = bounded(ball());
  set_gap(scenario.contact, positions.size(), gap);
  return scenario;
}

}  // namespace gracilis
