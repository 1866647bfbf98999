#include "io/test_files.hpp"

#include <gracilis/geometry/signed_distance.hpp>
#include <gracilis/opensim/import/bone_files.hpp>
#include <gracilis/opensim/import/muscle_volume.hpp>
#include <gracilis/opensim/kinematics/skeleton.hpp>
#include <gracilis/opensim/reader/model_reader.hpp>
#include <gracilis/scene/section_line.hpp>

#include <gtest/gtest.h>

#include <utility>

namespace gracilis::opensim {

/// Whether the plane across the line at its section `k` cuts the surface.
static bool plane_cuts(const Points& line, Index k, const TriangleMesh& surface) {
  const Vec3 normal = line.col(k + 1) - line.col(k - 1);
  const Eigen::RowVectorXd heights = normal.transpose() * (surface.vertices.colwise() - Vec3(line.col(k)));
  return heights.minCoeff() < 0 && heights.maxCoeff() > 0;
}

/// Centers of the sections of a real muscle, brought onto its surface with 36 rays, that lie outside of it. Sections
/// whose plane misses the muscle stay on the line and do not count.
static int centers_outside(const std::string& muscle, const std::string& file) {
  Model model = read_model(data_root() / "lhdl-hip/motion/LHDL_hip_r.osim");
  // The scan's pose.
  const std::pair<const char*, Real> pose[] = {
      {"hip_flexion_r", 1.58}, {"hip_adduction_r", -4.73}, {"hip_rotation_r", -5.29}};
  for (const auto& [name, angle] : pose)
    model.coordinates[static_cast<std::size_t>(index_of(model.coordinates, name))].default_value = radians(angle);
  Skeleton skeleton(model);
  const Eigen::VectorXd q = default_coordinates(model);
  skeleton.place(q);
  VolumeSettings settings;
  settings.enhancement.more_rays = 3;
  settings.surfaces = load_muscle_surfaces(
      model, skeleton.poses(), {{muscle, {{data_root() / "lhdl-hip/clean" / file}, 0.001, "LHDL_pelvis.vtp"}}});
  const Muscle& line = model.muscles[static_cast<std::size_t>(index_of(model.muscles, muscle))];
  const MuscleVolume volume = muscle_volume(model, line, skeleton.poses(), q, settings);
  EXPECT_GT(volume.sections_on_surface, 8) << muscle;
  const SignedDistance distance(settings.surfaces.at(muscle));
  const Points sections = section_line(volume.line).centers;
  int outside = 0;
  for (Eigen::Index k = 1; k + 1 < sections.cols(); ++k) {
    const Vec3 center = volume.line.centers.col(k);
    const bool is_cut = plane_cuts(sections, k, settings.surfaces.at(muscle));
    EXPECT_TRUE(is_cut || center == Vec3(sections.col(k))) << muscle << ", section " << k;
    if (is_cut && distance.query(center).distance >= 0) ++outside;
  }
  return outside;
}

TEST(SectionsOnSurfaces, centers_of_the_cadavers_muscles_lie_inside_them) {
  GRACILIS_NEEDS_DATA("lhdl-hip/clean");
  EXPECT_EQ(centers_outside("iliacus_r", "iliacus_r.ply"), 0);
  EXPECT_EQ(centers_outside("psoas_r", "psoas_major_r.ply"), 0);
  for (const char* part : {"glut_max1_r", "glut_max2_r", "glut_max3_r"})
    EXPECT_EQ(centers_outside(part, "gluteus_maximus_r.ply"), 0) << part;
  for (const char* part : {"glut_med1_r", "glut_med2_r", "glut_med3_r"})
    EXPECT_EQ(centers_outside(part, "gluteus_medius_r.ply"), 0) << part;
}

}  // namespace gracilis::opensim
