#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/radial_solid.hpp>
#include <gracilis/geometry/surface_extraction.hpp>
#include <gracilis/geometry/topology.hpp>

#include <shapes.hpp>
#include <surface_distance.hpp>

#include <gtest/gtest.h>

namespace gracilis {

TEST(RadialSolid, a_sphere_comes_back_as_a_closed_surface_of_its_volume) {
  const TriangleMesh sphere = shapes::sphere({0.1, 0, -0.2}, 0.03, 4);
  for (const RadialKernel& kernel :
       {RadialKernel{RadialShape::thin_plate}, RadialKernel{RadialShape::power_minus_1, 1.5}}) {
    RadialSolidSettings settings;
    settings.kernel = kernel;
    settings.centers = 100;
    const RadialSolid solid = fit_solid(sphere, settings);
    EXPECT_EQ(solid.fit.basis.count(), 100);
    const TriangleMesh found = largest_component(extract_surface(sample(implicit_solid(solid), 0.002)));
    EXPECT_TRUE(is_closed(found.faces));
    EXPECT_NEAR(enclosed_volume(found.vertices, found.faces) / enclosed_volume(sphere.vertices, sphere.faces), 1, 0.01);
    EXPECT_LT(farthest_from(sphere, found), 0.001) << "half a step of the grid";
  }
}

}  // namespace gracilis
