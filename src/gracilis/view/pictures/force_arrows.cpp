#include <gracilis/view/pictures/force_arrows.hpp>

#include <gracilis/anatomy/sections/cylinder_surface.hpp>
#include <gracilis/core/errors.hpp>
#include <gracilis/io/tables/force_table.hpp>
#include <gracilis/io/tables/table.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace gracilis {

namespace {

constexpr Real longest_arrow = 0.06;  // m, as drawn
constexpr std::array<const char*, 2> end_names = {"origin", "insertion"};

/// After Okabe and Ito (2008), and unlike muscles.
const std::array<Color, 2> end_colors = {Color(0.00, 0.45, 0.70), Color(0.00, 0.62, 0.45)};

Table force_table_of(const RecordedRun& run) {
  if (!std::filesystem::exists(run.folder / force_file))
    throw ConfigurationError(
        {run.folder.string(), "", "the run knows no forces",
         "run the scene again with --set method=tissue, by xpbd with --corrections, or draw it without --arrows"});
  return read_table(run.folder / force_file);
}

/// What acts on all bodies that an end holds on to, N; rows × 3, 0 × 3 where the table has none.
Eigen::MatrixX3d end_forces(const Table& table, const std::string& muscle, int end, Eigen::Index rows) {
  const std::string prefix = fmt::format("{}_{}_on_", muscle, end_names[static_cast<std::size_t>(end)]);
  Eigen::MatrixX3d sum(0, 3);
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    const std::string& name = table.columns[c];
    if (!name.starts_with(prefix) || !name.ends_with("_force_x") || c + 2 >= table.columns.size()) continue;
    if (sum.rows() == 0) sum = Eigen::MatrixX3d::Zero(rows, 3);
    sum += table.values.block(0, static_cast<Eigen::Index>(c), rows, 3);  // _x, _y and _z stand side by side
  }
  return sum;
}

std::vector<Eigen::MatrixX3d> all_end_forces(const RecordedRun& run) {
  const Table table = force_table_of(run);
  const Eigen::Index rows = std::min<Eigen::Index>(table.values.rows(), run.frame_count);
  std::vector<Eigen::MatrixX3d> forces;
  for (const std::string& muscle : run.muscles)
    for (const int end : {0, 1}) forces.push_back(end_forces(table, muscle, end, rows));
  return forces;
}

std::string arrow_legend(std::size_t end, Real scale) {
  return fmt::format("force on {}s, 1 cm for {:g} N", end_names[end], 0.01 / scale);
}

}  // namespace

Real force_arrow_scale(const std::vector<RecordedRun>& runs) {
  Real largest = 0;
  for (const RecordedRun& run : runs) {
    Real of_run = 0;
    for (const Eigen::MatrixX3d& forces : all_end_forces(run))
      if (forces.rows() > 0) of_run = std::max(of_run, forces.rowwise().norm().maxCoeff());
    if (!(of_run > 0))
      throw ConfigurationError({(run.folder / force_file).string(), "", "holds no force at a muscle's attachment",
                                "draw the run without --arrows"});
    largest = std::max(largest, of_run);
  }
  const Real exact = longest_arrow / largest, power = std::pow(10, std::floor(std::log10(exact)));
  return exact < 2 * power ? power : exact < 5 * power ? 2 * power : 5 * power;
}

ForceArrows::ForceArrows(const RecordedRun& run, Real scale) : scale_(scale), forces_(all_end_forces(run)) {
  for (const std::string& muscle : run.muscles) {
    const Points tissue = recorded_tissue(run, muscle);
    for (const Index end : {0, 1}) {
      attached_.emplace_back();
      for (Index v = 0; v < tissue.cols(); ++v)
        if (tissue(end, v) > 0.5) attached_.back().push_back(v);
    }
  }
}

std::vector<PaintedSurface> ForceArrows::of(std::size_t muscle, const TriangleMesh& surface, int frame) const {
  std::vector<PaintedSurface> arrows;
  for (const std::size_t end : {0U, 1U}) {
    const Eigen::MatrixX3d& forces = forces_[2 * muscle + end];
    const std::vector<Index>& attached = attached_[2 * muscle + end];
    if (frame >= forces.rows() || attached.empty()) continue;
    const Vec3 root = surface.vertices(Eigen::all, attached).rowwise().mean();
    const TriangleMesh arrow = arrow_surface(root, scale_ * forces.row(frame).transpose());
    if (arrow.vertex_count() > 0) arrows.push_back({arrow_legend(end, scale_), arrow, end_colors[end]});
  }
  return arrows;
}

TriangleMesh arrow_surface(const Vec3& root, const Vec3& along, const ArrowShape& shape) {
  const Real length = along.norm();
  if (!(length >= shape.shortest)) return {};
  const Real head = std::min(length / 2, shape.most_head), brim = head / 3, shaft = brim / 3, tip = brim / 50;
  // The brim stands a hair before the shaft's end, since sections of one place have no plane.
  const std::array<Real, 4> places = {0, length - head, length - head * 0.999, length};
  const Eigen::RowVector4d radii(shaft, shaft, brim, tip);
  Points line(3, 4);
  for (Index k = 0; k < 4; ++k) line.col(k) = root + places[static_cast<std::size_t>(k)] / length * along;
  const Points corners =
      section_vertices(line, section_frames(line, along.unitOrthogonal()), radii.replicate(shape.sides, 1));
  return {corners, section_faces(4, shape.sides)};
}

}  // namespace gracilis
