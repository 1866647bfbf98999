#pragma once

#include <gracilis/dynamics/contact/mesh/particle_normals.hpp>
#include <gracilis/dynamics/contact/surface/broad_phase.hpp>
#include <gracilis/dynamics/contact/surface/narrow_phase.hpp>
#include <gracilis/dynamics/contact/surface/surface_contact.hpp>
#include <gracilis/dynamics/contact/surface/untangling.hpp>

#include <shapes.hpp>

#include <algorithm>
#include <utility>
#include <vector>

namespace gracilis {

/// Surfaces that meet, with nothing else that acts on them.
struct Meeting {
  ContactWorld world;
  std::vector<Particles> particles, start;
  ContactWorldState state;

  void add(const TriangleMesh& mesh, const Eigen::VectorXd& inverse_masses) {
    world.surfaces.push_back(build_contact_surface(mesh.faces, mesh.vertex_count()));
    particles.push_back(make_particles(mesh.vertices, inverse_masses));
    world.rest.push_back(mesh.vertices.cast<float>());
    world.rest_normals.emplace_back();
    particle_normals(world.surfaces.back(), particles.back(), world.rest_normals.back());
    world.neighborhood.push_back(0.004f);
  }
  void add(const TriangleMesh& mesh, Real inverse_mass = 1) {
    add(mesh, Eigen::VectorXd::Constant(mesh.vertex_count(), inverse_mass));
  }

  SurfacePair& pair(Index first, Index second, float gap) {
    const auto a = static_cast<std::size_t>(particles[static_cast<std::size_t>(first)].count()),
               b = static_cast<std::size_t>(particles[static_cast<std::size_t>(second)].count());
    SurfacePair pair;
    pair.first = first, pair.second = second;
    pair.first_gap.assign(a, gap), pair.second_gap.assign(b, gap);
    pair.first_touches.assign(a, 0), pair.second_touches.assign(b, 0);
    world.pairs.push_back(std::move(pair));
    return world.pairs.back();
  }

  template <class Pointer>
  std::vector<Pointer> pointers(auto& list) {
    std::vector<Pointer> result;
    for (auto& each : list) result.push_back(&each);
    return result;
  }

  void prepare() {
    arrange_rounds(world);
    state = make_contact_state(world);
  }
  void find() { update_broad_phase(world, pointers<const Particles*>(particles), state); }
  void follow() { update_narrow_phase(world, pointers<const Particles*>(particles), state); }
  void move(std::size_t surface, const Eigen::Vector3f& by) {
    for (Index p = 0; p < particles[surface].count(); ++p) particles[surface].position(p) += by;
  }

  /// Looks for contacts and projects them. Returns the pushes of the last round.
  Index solve(int rounds) {
    prepare();
    if (start.empty()) start = particles;
    find();
    Index pushes = 0;
    for (int i = 0; i < rounds; ++i) {
      follow();
      pushes = project_candidates(world, state, pointers<const Particles*>(start), pointers<Particles*>(particles));
    }
    return pushes;
  }

  /// Longest way a particle goes in one more round, m: 0 but for rounding where every gap is kept.
  Real unrest() {
    const std::vector<Particles> before = particles;
    solve(1);
    Real longest = 0;
    for (std::size_t s = 0; s < particles.size(); ++s)
      for (Index p = 0; p < particles[s].count(); ++p)
        longest = std::max<Real>(longest, (particles[s].position(p) - before[s].position(p)).norm());
    return longest;
  }
};

/// Two balls of 10 mm, the second this much (m) too near.
inline Meeting pressed_balls(Real too_near, Real second_inverse_mass = 1) {
  Meeting meeting;
  meeting.add(shapes::sphere(Vec3::Zero(), 0.01, 4));
  meeting.add(shapes::sphere({0.02 - too_near, 0.0003, 0.0002}, 0.01, 4), second_inverse_mass);
  meeting.pair(0, 1, 0.0003f);
  return meeting;
}

}  // namespace gracilis
