#include <gracilis/methods/tissue/settle.hpp>

namespace gracilis::tissue {

/// How often in a step it is looked anew what bones are near.
static constexpr int most_rounds = 4;

Minimized settle(const PreparedTissue& muscle, Surroundings& around, const FactoredMatrix& metric, int iterations,
                 Points& nodes) {
  MinimizeSettings settings = {iterations, muscle.settings.minimizer_residual, muscle.lattice.cell_size};
  EnergyWorkspace workspace;
  const auto energy = [&](const Points& at, Points& gradient) {
    return total_energy(muscle, around, at, workspace, gradient);
  };
  const auto by_metric = [&](std::span<Points> gradients) { metric.solve(gradients); };
  Minimized sum;
  for (int round = 0; round < most_rounds; ++round) {
    find_near_bones(muscle, nodes, around);
    const Points from = nodes;
    const Minimized done = minimize(energy, by_metric, settings, nodes);
    sum = {sum.iterations + done.iterations, done.energy, done.residual};
    settings.iterations -= done.iterations;
    if (settings.iterations <= 0 || (nodes - from).colwise().norm().maxCoeff() < near_bones) break;
  }
  return sum;
}

}  // namespace gracilis::tissue
