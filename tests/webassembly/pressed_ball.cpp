// A soft ball, shaken and pressed into a hard one, by the solver alone: prints where it ends. The same program is built
// for this machine and for WebAssembly, whose numbers have to be the same within rounding.
#include <gracilis/dynamics/solver/solver.hpp>

#include "dynamics/systems_for_tests.hpp"

#include <cmath>
#include <cstdio>

namespace gracilis {
namespace {

void solve() {
  const DistanceField obstacle = field_of_ball(0.02, 81);
  const TriangleMesh soft = shapes::sphere({0, 0, 0.045}, 0.03, 4);
  SurfaceSystem system = system_of(soft);
  // Random numbers are not the same everywhere.
  for (Index p = 0; p < system.rest.count(); ++p) system.rest.at(p)[3] = 1e4f;
  FieldContactSet contact;
  contact.field = bounded(obstacle);
  contact.captured.particle.assign(static_cast<std::size_t>(soft.vertex_count()), 0.0003f);
  contact.captured.edge_sag.assign(system.distances.a.size(), 0);
  contact.released = contact.captured;
  system.contacts.push_back(std::move(contact));

  SurfaceState state = make_state(system);
  for (Index p = 0; p < state.particles.count(); ++p)
    state.particles.position(p) += 0.0003f * Eigen::Vector3f(std::sin(1.f * p), std::sin(2.f * p), std::sin(3.f * p));
  SolveSettings settings;
  settings.iterations = 20;
  settings.projection.dihedral_limit = 0.05f;
  settings.strain_limit = 1.5f;
  const SolveReport report = solve_substep(system, {FieldPlacement{}}, settings, state);
  std::fprintf(stderr, "%d contacts\n", report.contacts);
  std::printf("%.9g\n", state.volume / system.volume.target);
  for (Index p = 0; p < state.particles.count(); p += 7) {
    const Eigen::Vector3f at = state.particles.position(p);
    std::printf("%.9g %.9g %.9g\n", at.x(), at.y(), at.z());
  }
}

}  // namespace
}  // namespace gracilis

int main() { gracilis::solve(); }
