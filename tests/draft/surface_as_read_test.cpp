#include <gracilis/draft/draft_attachments.hpp>
#include <gracilis/draft/surface_as_read.hpp>

#include "../shapes.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace gracilis {

TEST(SurfaceAsRead, a_cloud_of_all_of_the_file_s_vertices_names_all_that_the_reader_has) {
  const TriangleMesh of_file = shapes::cylinder(0.01, 0.2, 60, 2);
  std::vector<Index> all(static_cast<std::size_t>(of_file.vertex_count()));
  std::iota(all.begin(), all.end(), 0);
  const SurfaceAsRead read(of_file);
  ASSERT_GT(read.mesh.vertex_count(), of_file.vertex_count());
  const NearPoints rule{{{read.places(all), LineKind::cloud}}, own_vertices};
  EXPECT_EQ(static_cast<Index>(select_vertices(read.mesh, {}, rule).size()), read.mesh.vertex_count());
  EXPECT_TRUE(SurfaceAsRead(shapes::sphere(Vec3::Zero(), 0.02, 3)).added.ends.empty()) << "no needles";
}

TEST(SurfaceAsRead, a_cloud_on_a_fine_surface_names_none_but_its_own_vertices) {
  const SurfaceAsRead read(shapes::sphere(Vec3::Zero(), 0.002, 4));  // edges of 0.1 to 0.2 mm
  std::vector<Index> half;
  for (Index v = 0; v < read.mesh.vertex_count(); ++v)
    if (read.mesh.vertices(0, v) > 0) half.push_back(v);
  const Points places = read.places(half);
  const auto named_within = [&](Real reach) {
    return select_vertices(read.mesh, {}, NearPoints{{{places, LineKind::cloud}}, reach});
  };
  ASSERT_GT(named_within(own_vertices).size(), half.size());
  EXPECT_EQ(named_within(read.reach_of(places, own_vertices)), half);
  const SurfaceAsRead coarse(shapes::sphere(Vec3::Zero(), 0.02, 3));
  EXPECT_EQ(coarse.reach_of(coarse.places({1, 2}), own_vertices), own_vertices);
}

TEST(SurfaceAsRead, a_distance_grows_until_all_points_are_within_it) {
  const NearestTriangle box(shapes::box(Vec3(-0.01, -0.01, -0.01), Vec3(0.01, 0.01, 0)));
  const NearestTriangle* surfaces[] = {&box};
  const Points above = Vec3(0, 0, 0.00302);
  EXPECT_NEAR(distance_to_all(above, surfaces, 0.003), 0.0031, 1e-12);
  EXPECT_EQ(distance_to_all(above, surfaces, 0.004), 0.004);
}

}  // namespace gracilis
