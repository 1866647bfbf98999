#include <gracilis/view/pictures/correction_arrows.hpp>

#include <gracilis/dynamics/solver/constraint_table.hpp>
#include <gracilis/geometry/mesh_pieces.hpp>
#include <gracilis/io/run/recorded_corrections.hpp>
#include <gracilis/view/pictures/force_arrows.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace gracilis {

Color arrow_color(ConstraintKind kind) {
  switch (kind) {
    case ConstraintKind::distance:
      return Color(0.90, 0.62, 0.00);
    case ConstraintKind::tension:
      return Color(0.84, 0.37, 0.00);
    case ConstraintKind::dihedral:
      return Color(0.34, 0.71, 0.91);
    case ConstraintKind::volume:
      return Color(0.00, 0.62, 0.45);
    case ConstraintKind::strain_limit:
    case ConstraintKind::shape_limit:
      return Color(0.80, 0.47, 0.65);
    case ConstraintKind::muscle_contact:
      return Color(0.00, 0.45, 0.70);
    case ConstraintKind::slivers:
      return Color(0.94, 0.89, 0.26);
    case ConstraintKind::rest_proximities:
      return Color(0.55, 0.55, 0.55);
    case ConstraintKind::bone_contact:
    case ConstraintKind::none:
      break;
  }
  return Color::Constant(0.15);
}

/// Vertices of which none is nearer than `spacing` to one before it, as a grid of that width tells.
static std::vector<Index> spaced(const Points& vertices, Real spacing) {
  std::map<std::tuple<int, int, int>, std::vector<Index>> cells;
  std::vector<Index> kept;
  for (Index v = 0; v < vertices.cols(); ++v) {
    const Eigen::Vector3i cell = (vertices.col(v) / spacing).array().floor().cast<int>();
    const auto is_near = [&](const Eigen::Vector3i& other) {
      const auto found = cells.find({other.x(), other.y(), other.z()});
      return found != cells.end() && std::any_of(found->second.begin(), found->second.end(), [&](Index k) {
               return (vertices.col(k) - vertices.col(v)).norm() < spacing;
             });
    };
    bool crowded = false;
    for (int i = 0; i < 27 && !crowded; ++i)
      crowded = is_near(cell + Eigen::Vector3i(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1));
    if (crowded) continue;
    cells[{cell.x(), cell.y(), cell.z()}].push_back(v);
    kept.push_back(v);
  }
  return kept;
}

CorrectionArrowSize correction_arrow_size(const RecordedRun& run, const std::vector<std::string>& muscles,
                                          const std::vector<int>& frames, Real extent) {
  std::vector<Real> lengths;
  for (const std::string& muscle : muscles)
    for (const int frame : frames)
      for (const auto& [kind, moved] : recorded_corrections(run, muscle, frame))
        for (const auto& each : moved.colwise())
          if (const Real length = each.norm(); length > 0) lengths.push_back(length);
  const Real most_usual = [&] {
    if (lengths.empty()) return extent / 12;
    const auto place = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() * 19 / 20);
    std::nth_element(lengths.begin(), place, lengths.end());
    return *place;
  }();
  const Real exact = extent / 12 / most_usual, power = std::pow(10, std::floor(std::log10(exact)));
  return {exact < 2 * power ? power : exact < 5 * power ? 2 * power : 5 * power, extent / 40, extent / 80};
}

std::vector<PaintedSurface> correction_arrows(const RecordedRun& run, const std::string& muscle, const Points& vertices,
                                              int frame, const CorrectionArrowSize& size) {
  const Corrections corrections = recorded_corrections(run, muscle, frame);
  const std::vector<Index> roots = spaced(vertices, size.spacing);
  std::vector<PaintedSurface> painted;
  for (const ConstraintRow& row : constraint_table()) {
    const auto found = corrections.find(row.name);
    if (found == corrections.end()) continue;
    std::vector<TriangleMesh> arrows;
    for (const Index root : roots)
      arrows.push_back(
          arrow_surface(vertices.col(root), size.times * found->second.col(root), {size.head, 6, size.head / 4}));
    const TriangleMesh all = merged(arrows);
    if (all.vertex_count() > 0)
      painted.push_back({fmt::format("moved by {} (×{:g})", row.name, size.times), all, arrow_color(row.kind)});
  }
  return painted;
}

}  // namespace gracilis
