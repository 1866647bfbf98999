#include <gracilis/view/window/arrows.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis {

static constexpr Real wanted_length = 0.015, shortest = 0.0005;  // m, as drawn

int iteration_count(const ShownFrame& frame) {
  int last = -1;
  for (const ShownPass& pass : frame.passes) last = std::max(last, pass.iteration);
  return last + 1;
}

std::vector<Displacement> displacements_of(const ShownShapes& shapes, const ShownFrame& frame,
                                           const WindowState& state) {
  std::vector<Displacement> result;
  if (state.arrows == Arrows::none) return result;
  for (std::size_t m = 0; m < shapes.muscles.size(); ++m) {
    if (state.muscles[m] == MuscleState::hidden) continue;
    for (const ConstraintRow& row : constraint_table()) {
      if (!state.arrow_kinds[static_cast<std::size_t>(row.kind)]) continue;
      const auto roots = static_cast<Index>(shapes.arrow_roots[m].size());
      ShownPoints moved = ShownPoints::Zero(3, roots);
      for (const ShownPass& pass : frame.passes)
        if (pass.muscle == m && pass.kind == row.name &&
            (state.arrows == Arrows::frame || pass.iteration == state.iteration))
          moved += pass.moved;
      for (Index i = 0; i < roots; ++i)
        if (!moved.col(i).isZero(0))
          result.push_back(
              {frame.muscles[m].col(shapes.arrow_roots[m][static_cast<std::size_t>(i)]), moved.col(i), row.kind});
    }
  }
  return result;
}

Real arrow_scale(const std::vector<Displacement>& displacements) {
  if (displacements.empty()) return 1;
  std::vector<float> lengths;
  for (const Displacement& each : displacements) lengths.push_back(each.moved.norm());
  const auto place = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() * 19 / 20);
  std::nth_element(lengths.begin(), place, lengths.end());
  const Real exact = wanted_length / std::max(static_cast<Real>(*place), 1e-12);
  const Real power = std::pow(10, std::floor(std::log10(exact)));
  return exact < 2 * power ? power : exact < 5 * power ? 2 * power : 5 * power;
}

ColoredMesh arrow_mesh(const std::vector<Displacement>& displacements, Real scale) {
  ColoredMesh mesh;
  for (const Displacement& each : displacements) {
    const Eigen::Vector3f along = static_cast<float>(scale) * each.moved;
    if (along.norm() >= static_cast<float>(shortest)) append_arrow(each.root, along, arrow_color(each.kind), mesh);
  }
  return mesh;
}

}  // namespace gracilis
