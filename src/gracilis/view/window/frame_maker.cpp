#include <gracilis/view/window/frame_maker.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/measures.hpp>

#include <algorithm>
#include <limits>

namespace gracilis {

// What software rendering on two cores draws 30 times a second, and nobody sees the difference at a window's size: all
// muscles together and all bones together.
static constexpr Index muscle_vertices = 12000, bone_vertices = 8000;
static constexpr Index fewest_vertices = 250;  // of one surface
static constexpr Index arrows_shown = 350, fibers_shown = 24;

/// How many vertices of each surface are drawn: their share of the budget.
static std::vector<Index> vertex_shares(const std::vector<TriangleMesh>& surfaces, Index budget) {
  Index all = 0;
  for (const TriangleMesh& surface : surfaces) all += surface.vertex_count();
  std::vector<Index> shares;
  for (const TriangleMesh& surface : surfaces)
    shares.push_back(std::max<Index>(
        fewest_vertices,
        static_cast<Index>(static_cast<Real>(budget) * surface.vertex_count() / std::max<Index>(all, 1))));
  return shares;
}

/// Evenly spread points: each next one as far as can be from those before it (Gonzalez 1985).
static std::vector<Index> spread_points(const Points& points, Index count) {
  std::vector<Index> result;
  Eigen::VectorXd nearest = Eigen::VectorXd::Constant(points.cols(), std::numeric_limits<Real>::infinity());
  Index next = 0;
  while (static_cast<Index>(result.size()) < std::min(count, static_cast<Index>(points.cols()))) {
    result.push_back(next);
    const Vec3 last = points.col(next);
    nearest = nearest.cwiseMin((points.colwise() - last).colwise().squaredNorm().transpose());
    nearest.maxCoeff(&next);
  }
  return result;
}

FrameMaker::FrameMaker(std::vector<TriangleMesh> muscles, std::vector<TriangleMesh> bones, ShownShapes& shapes)
    : muscles_(std::move(muscles)), bones_(std::move(bones)) {
  const std::size_t count = muscles_.size();
  shown_.resize(count), arrow_vertices_.resize(count), volumes_.resize(count);
  shapes.muscle_faces.resize(count), shapes.arrow_roots.resize(count);
  shapes.held.resize(count), shapes.belly.resize(count);
  shapes.natural.resize(count), shapes.stripes.resize(count), shapes.vertex_numbers.resize(count);
  shapes.bone_faces.resize(bones_.size()), shapes.bone_points.resize(bones_.size());
  const std::vector<Index> muscle_shares = vertex_shares(muscles_, muscle_vertices);
  const std::vector<Index> bone_shares = vertex_shares(bones_, bone_vertices);
  parallel_for_each(count + bones_.size(), [&](std::size_t i) {
    if (i >= count) {
      const std::size_t b = i - count;
      const CoarseSurface coarse = decimate(bones_[b], bone_shares[b]);
      shapes.bone_faces[b] = coarse.faces;
      shapes.bone_points[b] = picked(bones_[b].vertices, coarse.vertices).cast<float>();
      return;
    }
    const CoarseSurface coarse = decimate(muscles_[i], muscle_shares[i]);
    shapes.muscle_faces[i] = coarse.faces;
    shown_[i] = shapes.vertex_numbers[i] = coarse.vertices;
    shapes.arrow_roots[i] = spread_points(picked(muscles_[i].vertices, coarse.vertices), arrows_shown);
    for (const Index root : shapes.arrow_roots[i])
      arrow_vertices_[i].push_back(coarse.vertices[static_cast<std::size_t>(root)]);
    volumes_[i] = enclosed_volume(muscles_[i].vertices, muscles_[i].faces);
  });
  for (const TriangleMesh& muscle : muscles_) stretch_.emplace_back(muscle);
}

void FrameMaker::fill(const std::vector<Points>& muscles, std::vector<RigidTransform> bones, bool contact_depth,
                      ShownFrame& frame) {
  const std::size_t count = muscles_.size();
  frame.muscles.resize(count), frame.stretch.resize(count), frame.volume.resize(count);
  parallel_for_each(count, [&](std::size_t m) {
    frame.muscles[m] = picked(muscles[m], shown_[m]).cast<float>();
    const std::vector<Real> stretch = shown_of(m, stretch_[m].of(muscles[m]));
    frame.stretch[m].assign(stretch.begin(), stretch.end());
    frame.volume[m] = enclosed_volume(muscles[m], muscles_[m].faces) / volumes_[m];
  });
  frame.bones = std::move(bones);
  if (!contact_depth) return;
  if (!depth_) depth_.emplace(bones_);
  for (std::size_t m = 0; m < count; ++m) muscles_[m].vertices = muscles[m];
  frame.contact_depth = depth_->of(muscles_, shown_, frame.bones);
}

void FrameMaker::fill_fibers(const std::vector<Polylines>& fibers, ShownFrame& frame) {
  const bool first = fiber_lengths_.empty();
  for (std::size_t m = 0; m < fibers.size(); ++m) {
    frame.fibers.push_back(spread_lines(fibers[m], fibers_shown));
    std::vector<Real> lengths = polyline_lengths(frame.fibers[m]);
    if (first) fiber_lengths_.push_back(lengths);
    for (std::size_t i = 0; i < lengths.size(); ++i)
      lengths[i] = i < fiber_lengths_[m].size() ? lengths[i] / fiber_lengths_[m][i] : 1;
    frame.strain.push_back(std::move(lengths));
  }
}

void FrameMaker::fill_stress(const std::vector<Eigen::VectorXd>& stresses, ShownFrame& frame) const {
  frame.stress.resize(stresses.size());
  for (std::size_t m = 0; m < stresses.size(); ++m)
    if (stresses[m].size() > 0)
      for (const Index v : shown_[m]) frame.stress[m].push_back(static_cast<float>(stresses[m][v]));
}

void FrameMaker::fill_tension(const std::vector<Eigen::VectorXd>& tensions, ShownFrame& frame) {
  frame.tension.resize(tensions.size());
  for (std::size_t m = 0; m < tensions.size(); ++m)
    for (const Index i : spread_numbers(static_cast<Index>(tensions[m].size()), fibers_shown))
      frame.tension[m].push_back(tensions[m][i]);
}

void FrameMaker::paint(std::size_t muscle, const MuscleLook& look, ShownShapes& shapes) const {
  const Points colors = natural_colors(look, shapes.muscles[muscle]);
  for (const Index v : shown_[muscle]) shapes.natural[muscle].push_back(colors.col(v));
  shapes.stripes[muscle] = shown_of(muscle, look.stripes);
}

}  // namespace gracilis
