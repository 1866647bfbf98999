#include <gracilis/geometry/solid_grid.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/measures.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis {

/// Grids of long bellies that lie aslant would be mostly empty; their steps become longer from here on.
static constexpr Real most_places = 4e6;

static constexpr Real around = 1.8;  ///< steps: a little more than a cube's diagonal

SolidGrid::SolidGrid(const TriangleMesh& surface, const SignedDistance& distance, const TriangleMesh& sheets,
                     Index nodes_inside) {
  const Vec3 low = surface.vertices.rowwise().minCoeff(), size = surface.vertices.rowwise().maxCoeff() - low;
  const Real volume = std::abs(enclosed_volume(surface.vertices, surface.faces));
  step_ = std::max(std::cbrt(volume / nodes_inside), std::cbrt(size.prod() / most_places));
  low_ = low - Vec3::Constant(2 * step_);
  for (std::size_t k = 0; k < 3; ++k) size_[k] = static_cast<Index>(std::ceil(size[static_cast<Index>(k)] / step_)) + 5;
  numbers_.assign(
      static_cast<std::size_t>(size_[0]) * static_cast<std::size_t>(size_[1]) * static_cast<std::size_t>(size_[2]), -1);
  std::vector<Real> depths(numbers_.size());
  parallel_for(size_[2], 1, [&](Index begin, Index end) {
    for (Index k = begin; k < end; ++k)
      for (Index j = 0; j < size_[1]; ++j)
        for (Index i = 0; i < size_[0]; ++i)
          depths[at(i, j, k)] = -distance.query(low_ + step_ * Vec3(i, j, k)).distance;
  });
  std::vector<Vec3> nodes;
  for (Index k = 0; k < size_[2]; ++k)
    for (Index j = 0; j < size_[1]; ++j)
      for (Index i = 0; i < size_[0]; ++i) {
        const std::size_t place = at(i, j, k);
        if (!(depths[place] > -around * step_)) continue;
        numbers_[place] = static_cast<Index>(nodes.size());
        nodes.push_back(low_ + step_ * Vec3(i, j, k));
        depths_.push_back(depths[place]);
      }
  nodes_.resize(3, static_cast<Index>(nodes.size()));
  for (std::size_t n = 0; n < nodes.size(); ++n) nodes_.col(static_cast<Index>(n)) = nodes[n];
  join_neighbors();
  if (sheets.face_count() == 0) return;
  sheets_.emplace(sheets);
  cut_edges();
}

static constexpr Real share_outside = 0.02;  ///< so that fields go on there, and weigh little
static constexpr Real share_of_cut = 1e-4;

/// What of an edge lies inside, by the depths of its ends.
static Real share_inside(Real a, Real b) {
  if (a >= 0 && b >= 0) return 1;
  if (a <= 0 && b <= 0) return share_outside;
  return std::max(share_outside, std::max(a, b) / std::abs(a - b));
}

void SolidGrid::join_neighbors() {
  for (Index k = 0; k < size_[2]; ++k)
    for (Index j = 0; j < size_[1]; ++j)
      for (Index i = 0; i < size_[0]; ++i) {
        const Index a = numbers_[at(i, j, k)];
        if (a < 0) continue;
        const auto join = [&](Index b) {
          if (b >= 0)
            edges_.push_back(
                {a, b, share_inside(depths_[static_cast<std::size_t>(a)], depths_[static_cast<std::size_t>(b)])});
        };
        if (i + 1 < size_[0]) join(numbers_[at(i + 1, j, k)]);
        if (j + 1 < size_[1]) join(numbers_[at(i, j + 1, k)]);
        if (k + 1 < size_[2]) join(numbers_[at(i, j, k + 1)]);
      }
}

void SolidGrid::cut_edges() {
  is_cut_.assign(static_cast<std::size_t>(count()), 0);
  for (Edge& edge : edges_) {
    // Sheets on the surface part nothing.
    if (edge.share < 1 || !sheets_->cut(nodes_.col(edge.a), nodes_.col(edge.b))) continue;
    edge.share = share_of_cut;
    is_cut_[static_cast<std::size_t>(edge.a)] = is_cut_[static_cast<std::size_t>(edge.b)] = 1;
  }
}

void SolidGrid::leave_out_far_side(const Vec3& p, Place& place) const {
  const auto is_cut = [&](Index n) { return is_cut_[static_cast<std::size_t>(n)] != 0; };
  if (std::none_of(place.nodes.begin(), place.nodes.end(), is_cut)) return;
  Real sum = 0;
  for (std::size_t k = 0; k < 8; ++k) {
    if (is_cut(place.nodes[k]) && sheets_->cut(p, nodes_.col(place.nodes[k]))) place.weights[k] = 0;
    sum += place.weights[k];
  }
  place.is_known = sum > 0;
  for (Real& weight : place.weights) weight /= sum > 0 ? sum : 1;
}

SolidGrid::Place SolidGrid::place(const Vec3& p) const {
  Place result;
  const Vec3 q = (p - low_) / step_;
  std::array<Index, 3> cell{};
  Vec3 rest;
  for (std::size_t k = 0; k < 3; ++k) {
    const Real x = q[static_cast<Index>(k)];
    if (!(x >= 0 && x < size_[k] - 1)) return result;
    cell[k] = static_cast<Index>(x);
    rest[static_cast<Index>(k)] = x - cell[k];
  }
  for (std::size_t corner = 0; corner < 8; ++corner) {
    const Index i = corner & 1, j = (corner >> 1) & 1, k = (corner >> 2) & 1;
    result.nodes[corner] = numbers_[at(cell[0] + i, cell[1] + j, cell[2] + k)];
    if (result.nodes[corner] < 0) return result;
    result.weights[corner] = (i ? rest[0] : 1 - rest[0]) * (j ? rest[1] : 1 - rest[1]) * (k ? rest[2] : 1 - rest[2]);
  }
  result.is_known = true;
  if (sheets_) leave_out_far_side(p, result);
  return result;
}

Real SolidGrid::depth(const Vec3& p) const {
  const Place at = place(p);
  if (!at.is_known) return -step_;
  Real sum = 0;
  for (std::size_t k = 0; k < 8; ++k) sum += at.weights[k] * depths_[static_cast<std::size_t>(at.nodes[k])];
  return sum;
}

}  // namespace gracilis
