#include <gracilis/dynamics/constraints/shape_limit.hpp>

#include <shapes.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace gracilis {
namespace {

/// A flat cushion: a ball of 30 mm pressed to a fifth, 12 mm thick.
TriangleMesh cushion() {
  TriangleMesh mesh = shapes::sphere({0, 0, 0}, 0.03, 3);
  mesh.vertices.row(2) *= 0.2;
  return mesh;
}

Particles at_rest(const TriangleMesh& mesh) {
  return make_particles(mesh.vertices, Eigen::VectorXd::Ones(mesh.vertex_count()));
}

ShapeLimitSet limits_of(const TriangleMesh& mesh) {
  return build_shape_limits(shape_of(mesh, build_topology(mesh.faces, mesh.vertex_count())));
}

/// The vertex that is highest, in the middle of the cushion's upper side.
Index top_of(const TriangleMesh& mesh) {
  Index top = 0;
  mesh.vertices.row(2).maxCoeff(&top);
  return top;
}

/// How far a vertex is from its neighbors' mean, m.
float from_neighbors(const ShapeLimitSet& set, Index vertex, const Particles& particles) {
  const auto v = static_cast<std::size_t>(vertex);
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  for (Index i = set.stars.offsets[v]; i < set.stars.offsets[v + 1]; ++i)
    sum += particles.position(set.stars.neighbors[static_cast<std::size_t>(i)]);
  return (particles.position(vertex) - sum / static_cast<float>(set.stars.offsets[v + 1] - set.stars.offsets[v]))
      .norm();
}

Vec3 momentum_center(const Particles& particles) {
  Vec3 sum = Vec3::Zero();
  for (Index p = 0; p < particles.count(); ++p) sum += particles.position(p).cast<Real>();
  return sum;
}

class ShapeLimit : public testing::Test {
 protected:
  TriangleMesh mesh = cushion();
  ShapeLimitSet set = limits_of(mesh);
  Particles particles = at_rest(mesh);
  Index top = top_of(mesh);

  std::vector<Index> all() const {
    std::vector<Index> each(static_cast<std::size_t>(mesh.vertex_count()));
    for (std::size_t v = 0; v < each.size(); ++v) each[v] = static_cast<Index>(v);
    return each;
  }
};

TEST_F(ShapeLimit, nothing_is_near_one_at_rest_and_nothing_moves) {
  EXPECT_TRUE(near_shape_limits(set, {1.5f, 2.5f, 2}, 0.7f, particles).empty());
  EXPECT_EQ(project_shape_limits(set, {1e-3f, 1.001f, 1.001f}, all(), particles), 0);
  EXPECT_EQ(largest_motion(at_rest(mesh), particles), 0);
}

TEST_F(ShapeLimit, a_vertex_drawn_out_comes_back_to_so_many_edges_and_no_further) {
  particles.position(top).z() += 0.02f;
  ASSERT_GT(from_neighbors(set, top, particles), set.apart[static_cast<std::size_t>(top)] + 0.015f);
  EXPECT_EQ(near_shape_limits(set, {1.5f, 0}, 0.7f, particles), std::vector<Index>{top});
  EXPECT_EQ(project_shape_limits(set, {1.5f, 0}, {top}, particles), 1);
  const auto t = static_cast<std::size_t>(top);
  EXPECT_NEAR(from_neighbors(set, top, particles), set.apart[t] + 1.5f * set.reach[t], 1e-6f);
  EXPECT_EQ(project_shape_limits(set, {1.5f, 0}, {top}, particles), 0) << "it is at its limit";
}

TEST_F(ShapeLimit, where_it_grew_thick_both_sides_come_together_until_it_is_that_thick) {
  for (Index v = 0; v < particles.count(); ++v) particles.position(v).z() *= 4;
  EXPECT_GT(project_shape_limits(set, {0, 2.5f}, {top}, particles), 0);
  const auto t = static_cast<std::size_t>(top);
  const float thick = (particles.position(top) - particles.position(set.opposite[t])).norm();
  EXPECT_NEAR((thick + set.mean_edge) / (set.thickness[t] + set.mean_edge), 2.5f, 1e-4f);
  EXPECT_NEAR(particles.position(top).z(), -particles.position(set.opposite[t]).z(), 1e-3f);
}

TEST_F(ShapeLimit, where_it_was_pressed_thin_both_sides_part_until_it_is_that_thin) {
  for (Index v = 0; v < particles.count(); ++v) particles.position(v).z() *= 0.05f;
  const auto t = static_cast<std::size_t>(top);
  const auto thinning = [&] {
    const float thick = (particles.position(top) - particles.position(set.opposite[t])).norm();
    return (set.thickness[t] + set.mean_edge) / (thick + set.mean_edge);
  };
  const float pressed = thinning();
  ASSERT_GT(pressed, 2);
  const ShapeLimits limits = {0, 0, 1.5f};
  EXPECT_EQ(project_shape_limits(set, {0, 0, 1.01f * pressed}, {top}, particles), 0) << "it is not that thin";
  EXPECT_EQ(project_shape_limits(set, limits, {top}, particles), 1);
  EXPECT_NEAR(thinning(), 1.5f, 1e-4f);
  EXPECT_NEAR(particles.position(top).z(), -particles.position(set.opposite[t]).z(), 1e-3f);
  EXPECT_EQ(project_shape_limits(set, {0, 0, 1.501f}, {top}, particles), 0) << "it is at its limit";
}

TEST_F(ShapeLimit, a_place_is_near_the_limit_of_thinness_from_a_share_of_the_way_to_it_on) {
  const auto is_near = [&](float limit) {
    const std::vector<Index> near = near_shape_limits(set, {0, 0, limit}, 0.7f, particles);
    return std::binary_search(near.begin(), near.end(), top);
  };
  const auto t = static_cast<std::size_t>(top);
  particles.position(top).z() = particles.position(set.opposite[t]).z() + 0.5f * set.thickness[t];
  const float thinning = (set.thickness[t] + set.mean_edge) / (0.5f * set.thickness[t] + set.mean_edge);
  EXPECT_TRUE(is_near(1 + (thinning - 1) / 0.72f));
  EXPECT_FALSE(is_near(1 + (thinning - 1) / 0.68f));
}

TEST_F(ShapeLimit, sides_that_lie_in_one_place_are_left_there) {
  const auto t = static_cast<std::size_t>(top);
  particles.position(top) = particles.position(set.opposite[t]);
  const Particles together = particles;
  EXPECT_EQ(project_shape_limits(set, {0, 0, 2}, {top}, particles), 0);
  EXPECT_EQ(largest_motion(together, particles), 0);
}

TEST_F(ShapeLimit, what_is_pushed_back_pushes_the_others_as_much_the_other_way) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> uniform(-0.02f, 0.02f);
  for (Index v = 0; v < particles.count(); ++v)
    for (int i = 0; i < 3; ++i) particles.position(v)[i] += uniform(random);
  const Vec3 before = momentum_center(particles);
  EXPECT_GT(project_shape_limits(set, {0.5f, 1.5f, 1.2f}, all(), particles), 10);
  EXPECT_LT((momentum_center(particles) - before).norm(), 1e-5);
}

TEST_F(ShapeLimit, what_cannot_move_stays_and_the_others_come_all_the_way) {
  particles.position(top).z() += 0.02f;
  particles.at(top)[3] = 0;
  const Eigen::Vector3f held = particles.position(top);
  EXPECT_EQ(project_shape_limits(set, {1.5f, 0}, {top}, particles), 1);
  EXPECT_EQ(Eigen::Vector3f(particles.position(top)), held);
  const auto t = static_cast<std::size_t>(top);
  EXPECT_NEAR(from_neighbors(set, top, particles), set.apart[t] + 1.5f * set.reach[t], 1e-6f);
  for (Index v = 0; v < particles.count(); ++v) particles.at(v)[3] = 0;
  const Particles fixed = particles;
  EXPECT_EQ(project_shape_limits(set, {1e-3f, 1.001f, 1.001f}, all(), particles), 0);
  EXPECT_EQ(largest_motion(fixed, particles), 0);
}

TEST_F(ShapeLimit, is_near_from_that_share_of_the_way_to_it_on) {
  const auto t = static_cast<std::size_t>(top);
  const Eigen::Vector3f home = particles.position(top);
  const Eigen::Vector3f mean = [&] {
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    for (Index i = set.stars.offsets[t]; i < set.stars.offsets[t + 1]; ++i)
      sum += particles.position(set.stars.neighbors[static_cast<std::size_t>(i)]);
    return Eigen::Vector3f(sum / static_cast<float>(set.stars.offsets[t + 1] - set.stars.offsets[t]));
  }();
  const auto is_near = [&](const ShapeLimits& limits) {
    const std::vector<Index> near = near_shape_limits(set, limits, 0.7f, particles);
    return std::find(near.begin(), near.end(), top) != near.end();
  };
  // Seven tenths of the way to a spike of 1.5 edges, and from a thickness of 1 to one of 2.5.
  for (const float share : {0.69f, 0.71f}) {
    particles.position(top) = mean + Eigen::Vector3f(0, 0, set.apart[t] + share * 1.5f * set.reach[t]);
    EXPECT_EQ(is_near({1.5f, 0}), share > 0.7f) << share;
    const Eigen::Vector3f opposite = particles.position(set.opposite[t]);
    const float thickness = 1 + share * 1.5f;
    particles.position(top) =
        opposite + (home - opposite).normalized() * (thickness * (set.thickness[t] + set.mean_edge) - set.mean_edge);
    EXPECT_EQ(is_near({0, 2.5f}), share > 0.7f) << share;
  }
}

TEST_F(ShapeLimit, all_that_move_share_the_way_by_their_inverse_masses) {
  for (Index v = 0; v < particles.count(); ++v) particles.at(v)[3] = 1 + static_cast<float>(v % 5);
  const auto t = static_cast<std::size_t>(top);
  const Particles before = [&] {
    particles.position(top).z() += 0.02f;
    return particles;
  }();
  const auto moved = [&](Index v) { return Eigen::Vector3f(particles.position(v) - before.position(v)); };
  EXPECT_EQ(project_shape_limits(set, {1.5f, 0}, {top}, particles), 1);
  EXPECT_NEAR(from_neighbors(set, top, particles), set.apart[t] + 1.5f * set.reach[t], 1e-6f);
  const Eigen::Vector3f push = moved(top) / before.inverse_mass(top);
  const auto count = static_cast<float>(set.stars.offsets[t + 1] - set.stars.offsets[t]);
  for (Index i = set.stars.offsets[t]; i < set.stars.offsets[t + 1]; ++i) {
    const Index neighbor = set.stars.neighbors[static_cast<std::size_t>(i)];
    EXPECT_LT((moved(neighbor) + before.inverse_mass(neighbor) / count * push).norm(), 1e-7f) << neighbor;
  }
  Particles thick = before;
  for (Index v = 0; v < thick.count(); ++v) thick.position(v).z() *= 4;
  particles = thick;
  EXPECT_EQ(project_shape_limits(set, {0, 2.5f}, {top}, particles), 1);
  const Index opposite = set.opposite[t];
  const Eigen::Vector3f of_top = particles.position(top) - thick.position(top),
                        of_opposite = particles.position(opposite) - thick.position(opposite);
  EXPECT_LT((of_top / before.inverse_mass(top) + of_opposite / before.inverse_mass(opposite)).norm(), 1e-7f);
}

TEST_F(ShapeLimit, a_limit_of_zero_is_none) {
  for (Index v = 0; v < particles.count(); ++v) particles.position(v) *= 10;
  particles.position(top).z() += 0.1f;
  EXPECT_FALSE(ShapeLimits{}.any());
  EXPECT_TRUE(near_shape_limits(set, {}, 0.7f, particles).empty());
  EXPECT_EQ(project_shape_limits(set, {}, all(), particles), 0);
}

TEST(ShapeLimitOfOpenSurfaces, a_vertex_without_edges_and_one_that_faces_nothing_have_none) {
  TriangleMesh triangle;
  triangle.vertices = Points::Zero(3, 4);
  triangle.vertices.col(1) = Vec3(0.01, 0, 0), triangle.vertices.col(2) = Vec3(0, 0.01, 0);
  triangle.vertices.col(3) = Vec3(1, 1, 1);
  triangle.faces = Eigen::Vector3i(0, 1, 2);
  const ShapeLimitSet set = limits_of(triangle);
  Particles particles = at_rest(triangle);
  particles.position(3) *= 5;
  EXPECT_EQ(project_shape_limits(set, {1.5f, 2.5f}, {0, 1, 2, 3}, particles), 0);
}

}  // namespace
}  // namespace gracilis
