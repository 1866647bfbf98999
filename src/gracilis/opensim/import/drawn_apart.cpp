#include <gracilis/opensim/import/drawn_apart.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/signed_distance.hpp>

#include <Eigen/Geometry>

#include <algorithm>

namespace gracilis::opensim {

static constexpr int rounds = 20;
static constexpr Real gap_left = 0.0002;  // m, that is left between two
static constexpr Real least = 0.4;        // of a corner's distance from its center

namespace {

/// A surface while it is drawn in.
class Drawn {
 public:
  explicit Drawn(const SectionedSurface& muscle)
      : muscle_(muscle), rays_((muscle.surface.vertex_count() - 2) / muscle.centers.cols()) {
    from_center_ = muscle.surface.vertices;
    for (Index v = 0; v < muscle.surface.vertex_count(); ++v)
      if (moves(v)) from_center_.col(v) -= center(v);
    share_ = Eigen::VectorXd::Ones(muscle.surface.vertex_count());
  }

  bool moves(Index vertex) const { return vertex >= rays_ && vertex < rays_ * (muscle_.centers.cols() - 1); }

  /// A vertex's distance from the center of its section, m; 0 of those that stay.
  Real radius(Index vertex) const { return moves(vertex) ? share_[vertex] * from_center_.col(vertex).norm() : 0; }

  /// Shares of the radii that are left when each vertex comes nearer to its center by so much, m.
  void draw(const Eigen::VectorXd& by) {
    for (Index v = 0; v < share_.size(); ++v)
      if (by[v] > 0 && moves(v)) share_[v] = std::max(least, share_[v] - by[v] / from_center_.col(v).norm());
  }

  TriangleMesh surface() const {
    TriangleMesh mesh = muscle_.surface;
    for (Index v = 0; v < mesh.vertex_count(); ++v)
      if (moves(v)) mesh.vertices.col(v) = center(v) + share_[v] * from_center_.col(v);
    return mesh;
  }

 private:
  Vec3 center(Index vertex) const { return muscle_.centers.col(vertex / rays_); }

  const SectionedSurface& muscle_;
  Index rays_;
  Points from_center_;     ///< as given, m
  Eigen::VectorXd share_;  ///< of that
};

/// A vertex in another surface, and where that is nearest.
struct Inside {
  Index vertex = 0;
  SignedDistance::Answer answer;
};

std::vector<Inside> find_inside(const TriangleMesh& one, const SignedDistance& other, const Eigen::AlignedBox3d& box) {
  std::vector<Inside> found;
  for (Index v = 0; v < one.vertex_count(); ++v) {
    const Vec3 p = one.vertices.col(v);
    if (!box.contains(p)) continue;
    if (const SignedDistance::Answer answer = other.query(p); answer.distance < 0) found.push_back({v, answer});
  }
  return found;
}

/// What one surface and another, in which it has vertices, are to be drawn in by, m per vertex.
void share_out(const std::vector<Inside>& inside, const Drawn& one, const Drawn& other, const Eigen::Matrix3Xi& faces,
               Eigen::VectorXd& of_one, Eigen::VectorXd& of_other) {
  for (const Inside& each : inside) {
    const auto corners = faces.col(each.answer.nearest.face);
    const Real own = one.radius(each.vertex);
    Real others = 0;
    for (Index c = 0; c < 3; ++c) others += each.answer.nearest.barycentric[c] * other.radius(corners[c]);
    if (!(own + others > 0)) continue;
    const Real by = gap_left - each.answer.distance, share = own / (own + others);
    of_one[each.vertex] = std::max(of_one[each.vertex], share * by);
    for (const Index corner : corners) of_other[corner] = std::max(of_other[corner], (1 - share) * by);
  }
}

/// Draws them in once; false where nothing is in anything.
bool draw_once(std::vector<Drawn>& drawn) {
  const std::size_t count = drawn.size();
  std::vector<TriangleMesh> meshes;
  std::vector<Eigen::VectorXd> by;
  for (const Drawn& each : drawn) {
    meshes.push_back(each.surface());
    by.push_back(Eigen::VectorXd::Zero(meshes.back().vertex_count()));
  }
  std::vector<std::vector<std::vector<Inside>>> inside(count, std::vector<std::vector<Inside>>(count));
  parallel_for_each(count, [&](std::size_t b) {
    const SignedDistance distance(meshes[b]);
    const Eigen::AlignedBox3d box = bounding_box(meshes[b].vertices);
    for (std::size_t a = 0; a < count; ++a)
      if (a != b) inside[a][b] = find_inside(meshes[a], distance, box);
  });
  bool any = false;
  for (std::size_t a = 0; a < count; ++a)
    for (std::size_t b = 0; b < count; ++b) {
      any = any || !inside[a][b].empty();
      share_out(inside[a][b], drawn[a], drawn[b], meshes[b].faces, by[a], by[b]);
    }
  for (std::size_t m = 0; m < count; ++m) drawn[m].draw(by[m]);
  return any;
}

}  // namespace

void draw_apart(std::vector<SectionedSurface>& muscles) {
  std::vector<Drawn> drawn(muscles.begin(), muscles.end());
  for (int round = 0; round < rounds && draw_once(drawn); ++round) {
  }
  for (std::size_t m = 0; m < muscles.size(); ++m) muscles[m].surface = drawn[m].surface();
}

}  // namespace gracilis::opensim
