#include <gracilis/opensim/import/sheet_heads.hpp>

#include <gracilis/geometry/principal_axes.hpp>
#include <gracilis/scene/section_line.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace gracilis::opensim {

/// Times as far apart as those of one line are sections of a sheet, which would cross where it bends.
static constexpr Real wider = 1.5;

/// From edge to edge: by where the middles of their lines lie along the direction in which these spread most; the edge
/// nearer to the first of the model's heads comes first.
static void sort_across(std::vector<SheetHead>& heads) {
  Points middles(3, static_cast<Eigen::Index>(heads.size()));
  for (std::size_t h = 0; h < heads.size(); ++h)
    middles.col(static_cast<Eigen::Index>(h)) = resampled(heads[h].own.line.points, 32).rowwise().mean();
  Vec3 across = spread_of(middles).most();
  if (across.dot(middles.col(0) - middles.rightCols(1)) > 0) across = -across;
  std::vector<std::size_t> order(heads.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return across.dot(middles.col(static_cast<Eigen::Index>(a))) <
           across.dot(middles.col(static_cast<Eigen::Index>(b)));
  });
  std::vector<SheetHead> sorted;
  for (const std::size_t h : order) sorted.push_back(heads[h]);
  heads = std::move(sorted);
}

/// Of the mean of the heads, in parts no longer than settings have it.
static SheetParts parts_of(const std::vector<SheetHead>& heads, const VolumeSettings& settings) {
  Real length = 0, origin_tendon = 0, tendon = 0;
  Index scaled = 0;
  for (const SheetHead& head : heads) {
    const auto share = 1 / static_cast<Real>(heads.size());
    length += share * head.length();
    origin_tendon += share * head.own.line.origin_tendon;
    tendon += share * head.own.line.tendon;
    scaled = std::max(scaled, static_cast<Index>((head.own.line.points.cols() - 1) << head.own.line.scaling));
  }
  const Real longest = settings.scaling ? length / static_cast<Real>(scaled) : wider * settings.section_distance;
  const auto count = [&](Real part) { return part_count(part, longest); };
  return {count(origin_tendon), std::max(Index{2}, count(length - origin_tendon - tendon)), count(tendon)};
}

/// Sections at equal shares of each of the line's parts.
static std::vector<Real> shares_of(const SheetHead& head, const SheetParts& parts) {
  const Real length = head.length(), begin = head.own.line.origin_tendon / length,
             end = 1 - head.own.line.tendon / length;
  std::vector<Real> shares;
  const auto add = [&](Real from, Real to, Index count) {
    for (Index i = 0; i < count; ++i) shares.push_back(from + (to - from) * i / count);
  };
  add(0, parts.origin_tendon > 0 ? begin : 0, parts.origin_tendon);
  add(parts.origin_tendon > 0 ? begin : 0, parts.tendon > 0 ? end : 1, parts.belly);
  add(parts.tendon > 0 ? end : 1, 1, parts.tendon);
  shares.push_back(1);
  return shares;
}

SheetHeads sheet_heads(const Model& model, const std::vector<const Muscle*>& muscles,
                       const std::vector<RigidTransform>& poses, const Eigen::VectorXd& coordinates,
                       const VolumeSettings& settings) {
  SheetHeads result;
  for (const Muscle* muscle : muscles)
    result.heads.push_back({muscle_line(model, *muscle, poses, coordinates, settings), {}, {}});
  sort_across(result.heads);
  result.parts = parts_of(result.heads, settings);
  for (SheetHead& head : result.heads) {
    ActionLine& line = head.own.line;
    line.shares = shares_of(head, result.parts);
    line.scaling = 0;
    head.centers = section_line(line).centers;
    std::vector<Real> places = line.shares;
    for (Real& place : places) place *= head.length();
    head.radii = radii_at(head.own, places);
  }
  return result;
}

}  // namespace gracilis::opensim
