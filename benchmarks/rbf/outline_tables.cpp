#include "patch_rims.hpp"
#include "spread_axes.hpp"
#include "tables.hpp"

#include <gracilis/geometry/outline_curves.hpp>
#include <gracilis/geometry/radial_fit.hpp>
#include <gracilis/geometry/surface_region.hpp>
#include <gracilis/io/mesh/mesh_reader.hpp>
#include <gracilis/io/scene/landmarks.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <random>
#include <string_view>

namespace gracilis {

namespace {

/// Points around an attachment in their order.
struct Outline {
  std::string name;
  Points points;
};

/// The outlines that were measured on the cadaver, and the bones that they lie on.
const std::vector<std::pair<std::string, std::string>> measured = {{"LC_SET_Ori_1_R_M081_Glut_Max", "hip_bone_r"},
                                                                   {"LC_SET_Ori_1_R_M082_Glut_Med", "hip_bone_r"},
                                                                   {"LC_SET_Ins_1_R_M082_Glut_Med", "femur_r"},
                                                                   {"LC_SET_Ori_1_R_M091_Iliacus", "hip_bone_r"}};

/// The one that curves differ on most.
const std::string drawn = "LC_SET_Ori_1_R_M082_Glut_Med";

std::vector<Index> shuffled_numbers(Index count) {
  std::vector<Index> numbers(static_cast<std::size_t>(count));
  std::iota(numbers.begin(), numbers.end(), 0);
  std::mt19937 generator(7);
  for (std::size_t i = numbers.size() - 1; i > 0; --i) std::swap(numbers[i], numbers[generator() % (i + 1)]);
  return numbers;
}

/// Of the points' links around the outline, the share that is found again from the points in another order.
struct Found {
  Real links = 0;
  Points in_order;
};
Found found_again(OutlineCurve curve, const Points& points) {
  const auto count = static_cast<Index>(points.cols());
  const std::vector<Index> place = shuffled_numbers(count);
  Points shuffled(3, count);
  for (Index i = 0; i < count; ++i) shuffled.col(i) = points.col(place[static_cast<std::size_t>(i)]);
  const std::vector<Index> order = outline_order(curve, shuffled);
  Found found{0, Points(3, count)};
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Index here = place[static_cast<std::size_t>(order[i])];
    const Index apart = std::abs(here - place[static_cast<std::size_t>(order[(i + 1) % order.size()])]);
    if (apart == 1 || apart == count - 1) found.links += 1.0 / count;
    found.in_order.col(static_cast<Index>(i)) = points.col(here);
  }
  return found;
}

/// Points as seen along the normal of the plane that fits an outline best: two coordinates in it and the height, m.
Points flattened(const Points& outline, const Points& points) {
  const Vec3 middle = outline.rowwise().mean();
  return spread_axes(outline).transpose() * (points.colwise() - middle);
}

/// How far the vertices of a surface lie from heights over the outline's plane: thin plates through the outline's
/// points.
Eigen::VectorXd surface_errors(const Points& outline, const Points& vertices) {
  Points base = flattened(outline, outline), there = flattened(outline, vertices);
  const Eigen::VectorXd heights = base.row(2), wanted = there.row(2);
  base.row(2).setZero();
  there.row(2).setZero();
  const RadialFit fit = interpolate({{RadialShape::thin_plate}, RadialPolynomial::linear, 2}, base, 0.05, heights);
  return errors_at(fit.basis, there, wanted).cwiseAbs();
}

/// An outline as it was measured and as each curve finds it, closed, in its plane.
void draw_outline(const TableRequest& request, const Outline& outline) {
  std::ofstream table = request.table("outline_curves", "area,curve,x_mm,y_mm");
  const auto add = [&](std::string_view curve, const Points& in_order) {
    const Points seen = 1000 * flattened(outline.points, in_order);
    for (Index i = 0; i <= static_cast<Index>(seen.cols()); ++i)
      table << fmt::format("{},{},{:.2f},{:.2f}\n", outline.name, curve, seen(0, i % seen.cols()),
                           seen(1, i % seen.cols()));
  };
  add("measured", outline.points);
  for (std::size_t c = 0; c < choices_of(OutlineCurve{}).size(); ++c)
    add(choices_of(OutlineCurve{})[c], found_again(static_cast<OutlineCurve>(c), outline.points).in_order);
}

void add_curves(std::ofstream& table, const std::string& set, const Outline& outline, const TriangleMesh* bone) {
  const std::vector<char> wanted = bone ? faces_inside(*bone, outline.points) : std::vector<char>{};
  for (std::size_t c = 0; c < choices_of(OutlineCurve{}).size(); ++c) {
    const Found found = found_again(static_cast<OutlineCurve>(c), outline.points);
    std::string areas = ",";
    if (bone) {
      std::vector<char> inside = faces_inside(*bone, found.in_order), beside = inside;
      for (std::size_t f = 0; f < wanted.size(); ++f) beside[f] &= !wanted[f], inside[f] &= wanted[f];
      const Real area = marked_area(*bone, wanted);
      areas = fmt::format("{:.4g},{:.4g}", 100 * marked_area(*bone, inside) / area,
                          100 * marked_area(*bone, beside) / area);
    }
    table << fmt::format("{},{},{},{},{:.4g},{}\n", set, outline.name, outline.points.cols(),
                         choices_of(OutlineCurve{})[c], 100 * found.links, areas);
  }
}

void add_measured(const TableRequest& request, std::ofstream& table) {
  const std::filesystem::path folder = request.data / "lhdl-hip";
  const auto clouds = read_landmarks(folder / "attachment_landmarks.csv", 0.001);
  std::map<std::string, TriangleMesh> bones;
  for (const auto& [name, bone] : measured) {
    if (!bones.contains(bone)) bones[bone] = read_mesh(folder / "clean" / (bone + ".ply"), 0.001);
    const auto cloud = std::find_if(clouds.begin(), clouds.end(), [&](const auto& c) { return c.name == name; });
    if (cloud == clouds.end()) continue;
    add_curves(table, "measured", {name, cloud->points}, &bones[bone]);
    if (name == drawn) draw_outline(request, {name, cloud->points});
  }
}

/// Rims of a leg's attachment patches, and the patches themselves from their rims.
void add_patches(const TableRequest& request, std::ofstream& table) {
  constexpr std::size_t least_rim = 8;
  std::ofstream surfaces = request.table("attachment_surfaces", "area,points,mean_mm,largest_mm");
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(request.data / "leg/patches"))
    files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  if (request.thin) files.resize(std::min<std::size_t>(files.size(), 4));
  for (const std::filesystem::path& file : files) {
    const TriangleMesh patches = read_mesh(file, 1);
    for (const PatchRim& rim : patch_rims(patches, least_rim)) {
      add_curves(table, "patches", {file.stem().string(), rim.points}, nullptr);
      const Eigen::VectorXd errors = surface_errors(rim.points, rim.piece);
      surfaces << fmt::format("{},{},{:.4g},{:.4g}\n", file.stem().string(), rim.points.cols(), 1000 * errors.mean(),
                              1000 * errors.maxCoeff());
    }
  }
}

}  // namespace

void write_outlines(const TableRequest& request) {
  if (request.data.empty()) return;
  std::ofstream table = request.table("outlines", "set,area,points,curve,links_percent,found_percent,beside_percent");
  add_measured(request, table);
  add_patches(request, table);
}

}  // namespace gracilis
