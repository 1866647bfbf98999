#include <gracilis/dynamics/solver/bone_contact.hpp>

#include <gracilis/dynamics/contact/field/field_contact.hpp>
#include <gracilis/dynamics/contact/field/field_contact_away.hpp>
#include <gracilis/dynamics/contact/field/field_contact_guard.hpp>
#include <gracilis/dynamics/contact/field/field_contact_listing.hpp>
#include <gracilis/dynamics/contact/field/field_contact_near.hpp>
#include <gracilis/dynamics/contact/field/two_obstacle_contact.hpp>

namespace gracilis {

/// How near to the bones counts as near, m.
static constexpr float contact_reach = 0.006f;

void refresh_contacts(const SurfaceSystem& system, const std::vector<FieldPlacement>& placements, SurfaceState& state) {
  const SurfaceMotion motion = surface_motion(state.listed, state.particles);
  const float reach = listing_reach(system.distances, contact_reach);
  for (std::size_t i = 0; i < system.contacts.size(); ++i) {
    NearField& near = state.near[i];
    near.away.distance = away_after(motion, placements[i], near.away);
    near.away.placement = placements[i];
    if (near.away.distance - near.away.largest_gap > reach && system.contacts[i].ceiling.empty())
      clear_near(near);
    else
      find_near(system.contacts[i], system.distances, system.large_faces, placements[i], contact_reach, state.particles,
                near);
  }
  state.listed = state.particles;
}

void remember_sides(const SurfaceSystem& system, const std::vector<FieldPlacement>& placements, SurfaceState& state) {
  const SurfaceMotion motion = surface_motion(state.listed, state.particles);
  for (std::size_t i = 0; i < system.contacts.size(); ++i)
    if (!(away_after(motion, placements[i], state.near[i].away) > far_away))
      remember_sides(system.contacts[i], placements[i], state.particles, state.near[i]);
}

void keep_listed(const SurfaceSystem& system, const std::vector<FieldPlacement>& placements, SurfaceState& state) {
  if (largest_motion(state.listed, state.particles) > listed_motion) refresh_contacts(system, placements, state);
}

void find_edge_points(const SurfaceSystem& system, const std::vector<FieldPlacement>& placements, SurfaceState& state) {
  for (std::size_t i = 0; i < system.contacts.size(); ++i)
    find_edge_points(system.contacts[i], placements[i], state.particles, state.near[i]);
}

Index project_bone_contact(const SurfaceSystem& system, const std::vector<FieldPlacement>& placements,
                           SurfaceState& state) {
  Index touching = 0;
  for (std::size_t i = 0; i < system.contacts.size(); ++i)
    touching += project_edge_contacts(system.contacts[i], placements[i], state.near[i], state.particles);
  for (std::size_t i = 0; i < system.contacts.size(); ++i)
    touching += project_middle_contacts(system.contacts[i], placements[i], state.near[i], state.particles);
  for (std::size_t i = 0; i < system.contacts.size(); ++i)
    touching +=
        project_face_contacts(system.contacts[i], system.large_faces, placements[i], state.near[i], state.particles);
  for (std::size_t i = 0; i < system.contacts.size(); ++i)
    touching += project_particle_contacts(system.contacts[i], placements[i], state.near[i], state.particles);
  project_two_obstacle_contact(system.contacts, placements, state.near, state.particles);
  return touching;
}

}  // namespace gracilis
