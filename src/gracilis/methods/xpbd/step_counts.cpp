#include <gracilis/methods/xpbd/step_counts.hpp>

namespace gracilis::xpbd {

std::vector<MetricInfo> step_metrics() {
  return {{"iterations"},
          {"triangles"},
          {"largest_correction_mm", 4},
          {"contacts"},
          {"limited_hinges", 0, "dihedral projections limited"},
          {"limited_edges"},
          {"skipped_constraints", 0, "constraint projections skipped"},
          {"virtual_edges"},
          {"virtual_pushes"},
          {"coinciding_edges"}};
}

MuscleReport report_of(const StepCounts& c) {
  const auto real = [](auto count) { return static_cast<Real>(count); };
  return {c.milliseconds,
          {{"iterations", real(c.iterations)},
           {"triangles", real(c.triangles)},
           {"largest_correction_mm", 1000 * c.largest_correction},
           {"contacts", real(c.contacts)},
           {"limited_hinges", real(c.limited_dihedrals)},
           {"limited_edges", real(c.limited_edges)},
           {"skipped_constraints", real(c.skipped_constraints)},
           {"virtual_edges", real(c.virtual_edges)},
           {"virtual_pushes", real(c.virtual_pushes)},
           {"coinciding_edges", real(c.coinciding_edges)}}};
}

}  // namespace gracilis::xpbd
