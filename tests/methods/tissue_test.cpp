#include <gracilis/anatomy/builtin/builtin_hip.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/methods/registry.hpp>
#include <gracilis/methods/tissue/tissue_method.hpp>

#include <member_count.hpp>
#include <scenes_for_tests.hpp>

#include "tissue_bar.hpp"

#include <gtest/gtest.h>

namespace gracilis {
namespace {

using namespace tissue;

TEST(Tissue, an_active_bar_with_fixed_ends_pulls_by_activation_times_stress_times_section) {
  const SettledBar bar = settled(
      {{"largest_active_stress", 3e5}, {"shear_per_tension", 0.25}, {"bulk_per_tension", 10.0}}, 0.4, Vec3::Zero());
  const Vec3 below = attachment_wrench(bar.muscle, bar.around, bar.nodes, AttachmentEnd::origin).force;
  const Vec3 above = attachment_wrench(bar.muscle, bar.around, bar.nodes, AttachmentEnd::insertion).force;
  EXPECT_NEAR(below.z(), 0.4 * 3e5 * section, 0.01 * 0.4 * 3e5 * section);
  // What is left over of the residual: 1e-4 N on each of some thousand nodes, in all directions.
  EXPECT_LT((below + above).norm(), 0.02);
}

/// How far the middle third of a bar is stretched.
Real stretch_in_the_middle(const SettledBar& bar) {
  const auto height = [&](Real z) {
    const EmbeddedPoint point = embed(bar.muscle.lattice, Vec3(width / 2, width / 2, z));
    return mean_at(point, bar.nodes).z();
  };
  return (height(2 * length / 3) - height(length / 3)) / (length / 3);
}

TEST(Tissue, a_stretched_or_squeezed_bar_pulls_as_fibers_and_an_incompressible_matrix_do) {
  const Real tension = 2e4, stiffness = 5e4, shear = 5e3;
  for (const Real wanted : {0.95, 1.05, 1.15}) {
    const SettledBar bar =
        settled({{"fiber_tension", tension}, {"fiber_stiffness", stiffness}, {"matrix_shear_modulus", shear}}, 0,
                Vec3(0, 0, (wanted - 1) * length));
    // The ends are held across, too, so the middle gives more.
    const Real stretch = stretch_in_the_middle(bar);
    EXPECT_NEAR(stretch, wanted, 0.02);
    const Real expected = section * (tension + stiffness * (stretch - 1) + shear * (stretch - 1 / (stretch * stretch)));
    EXPECT_NEAR(attachment_wrench(bar.muscle, bar.around, bar.nodes, AttachmentEnd::origin).force.z(), expected,
                0.01 * expected);
  }
}

TEST(Tissue, an_even_deformation_of_a_bar_costs_the_energy_of_its_law_and_leaves_no_force_inside) {
  const Scene scene = bar_scene({{"fiber_tension", 2e4}, {"fiber_stiffness", 5e4}, {"attachment_stiffness", 0.0}});
  const PreparedTissue muscle = prepare_tissue(scene, scene.muscles[0], {}, {});
  std::vector<CellLaw> laws = cell_laws(muscle, 0.5, 1);
  for (CellLaw& law : laws) law = laws[laws.size() / 2];
  const Surroundings around = surroundings(muscle, std::vector<RigidTransform>(2, RigidTransform::Identity()), laws);
  Matrix3 shear = Matrix3::Identity();
  shear(0, 2) = 0.4;
  for (const Matrix3& f : {shear, Matrix3(Vec3(0.95, 0.95, 1.2).asDiagonal())}) {
    Points gradient;
    const Real energy = energy_of(muscle, around, f * muscle.lattice.nodes, gradient);
    Matrix3 stress;
    const Real j = f.determinant();
    const Real expected = tissue_energy(laws[0].matrix, laws[0].fibers, laws[0].direction, f, stress) +
                          laws[0].bulk / 2 * (j - 1) * (j - 1);
    // Where a cell is nearly empty it counts with a twentieth.
    EXPECT_NEAR(energy, expected * section * length, 0.03 * expected * section * length);
    Real inside = 0, outside = 0;
    for (Index n = 0; n < muscle.lattice.node_count(); ++n) {
      const Vec3 p = muscle.lattice.nodes.col(n);
      const bool is_inside = ((p.array() - 0.005).minCoeff() > 0 && p.x() < width - 0.005 && p.y() < width - 0.005 &&
                              p.z() < length - 0.005);
      (is_inside ? inside : outside) += gradient.col(n).norm();
    }
    EXPECT_LT(inside, 1e-9 * outside);
  }
}

TEST(Tissue, fascia_ties_to_a_body_once_however_many_pieces_its_bones_come_in) {
  const auto stiffnesses = [](const Scene& scene) {
    std::vector<SignedDistance> distances;
    for (const Bone& bone : scene.bones) distances.emplace_back(bone.surface);
    std::vector<Real> all;
    for (const Tie& tie : prepare_tissue(scene, scene.muscles[0], {}, distances).ties) all.push_back(tie.stiffness);
    return all;
  };
  Scene scene = tube_scene();
  scene.method.name = "tissue";
  const std::vector<Real> of_one_piece = stiffnesses(scene);
  ASSERT_FALSE(of_one_piece.empty());
  for (std::size_t b = scene.bones.size(); b-- > 0;) scene.bones.push_back(scene.bones[b]);
  EXPECT_EQ(stiffnesses(scene), of_one_piece);
}

TEST(Tissue, without_tension_rest_has_no_forces_and_neither_has_rest_moved_rigidly) {
  Scene scene = tube_scene();
  scene.method.name = "tissue";
  std::vector<SignedDistance> distances;
  for (const Bone& bone : scene.bones) distances.emplace_back(bone.surface);
  const PreparedTissue muscle = prepare_tissue(scene, scene.muscles[0], tube_fields(), distances);
  const RigidTransform by = Eigen::Translation3d(0.1, 0.2, -0.1) * Eigen::AngleAxisd(1, Vec3(1, 2, 2) / 3);
  for (const RigidTransform& motion : {RigidTransform(RigidTransform::Identity()), by}) {
    Surroundings around = surroundings(muscle, {motion, motion}, cell_laws(muscle, 0, 0));
    const Points nodes = (motion.linear() * muscle.lattice.nodes).colwise() + motion.translation();
    find_near_bones(muscle, nodes, around);
    EXPECT_FALSE(around.near.empty());
    Points gradient;
    EXPECT_NEAR(energy_of(muscle, around, nodes, gradient), 0, 1e-12);
    // The stiffest spring times the rounding of a place: 1e4 N/m · 1e-16 m.
    EXPECT_LT(gradient.colwise().norm().maxCoeff(), 1e-9);
  }
}

TEST(Tissue, the_gradient_of_all_energy_together_is_that_of_its_differences) {
  Scene scene = tube_scene();
  scene.method.name = "tissue";
  scene.method.settings["cell_size"] = 0.01;
  scene.method.settings["cells_at_least"] = 0;
  std::vector<SignedDistance> distances;
  for (const Bone& bone : scene.bones) distances.emplace_back(bone.surface);
  const PreparedTissue muscle = prepare_tissue(scene, scene.muscles[0], tube_fields(), distances);
  const Pose pose = flexed(scene, radians(3));
  Surroundings around = surroundings(muscle, pose.bodies, cell_laws(muscle, 0.3, 1));
  Points nodes = muscle.lattice.nodes, gradient, ignored;
  carry(muscle, std::vector<RigidTransform>(2, RigidTransform::Identity()), pose.bodies, nodes);
  find_near_bones(muscle, nodes, around);
  energy_of(muscle, around, nodes, gradient);
  for (Index n = 0; n < muscle.lattice.node_count(); n += 17)
    for (Index axis = 0; axis < 3; ++axis) {
      const Real h = 1e-8;
      Points up = nodes, down = nodes;
      up(axis, n) += h, down(axis, n) -= h;
      const Real difference =
          (energy_of(muscle, around, up, ignored) - energy_of(muscle, around, down, ignored)) / (2 * h);
      EXPECT_NEAR(gradient(axis, n), difference, 1e-5 * gradient.colwise().norm().maxCoeff());
    }
}

TEST(Tissue, large_motions_are_cut_into_steps_that_end_where_the_motion_ends) {
  Scene scene = tube_scene();
  scene.method.name = "tissue";
  scene.method.settings["largest_turn"] = radians(5);
  scene.method.settings["cell_size"] = 0.05;
  const PreparedTissue muscle = prepare_tissue(scene, scene.muscles[0], {}, {});
  const std::vector<RigidTransform> before = flexed(scene, 0).bodies, now = flexed(scene, radians(23)).bodies;
  ASSERT_EQ(steps_needed(muscle, before, now), 5);
  EXPECT_TRUE(bodies_after(5, 5, muscle, before, now)[1].isApprox(now[1], 0));
  const std::vector<RigidTransform> first = bodies_after(1, 5, muscle, before, now);
  const Matrix3 between = first[0].linear().transpose() * first[1].linear();
  EXPECT_NEAR(Eigen::AngleAxisd(between).angle(), radians(4.6), 1e-9);
  EXPECT_EQ(steps_needed(muscle, now, now), 1);
}

TEST(Tissue, tension_comes_up_in_its_frames_and_then_nothing_changes) {
  Scene scene = tube_scene();
  scene.method.settings = {{"tension_frames", 3}, {"minimizer_iterations", 300}, {"minimizer_residual", 1e-6}};
  const auto method = make_tissue_method(scene, tube_fields());
  const Pose rest = flexed(scene, 0);
  std::vector<Frame> frames = {frame_of(*method, rest, 0)};
  EXPECT_EQ(frames[0].muscles[0].points, scene.muscles[0].surface.vertices);
  for (int frame = 1; frame <= 5; ++frame) {
    method->advance(rest, usual_time_step);
    frames.push_back(frame_of(*method, rest, frame));
  }
  for (std::size_t frame = 1; frame <= 3; ++frame) EXPECT_GT(farthest(frames[frame], frames[frame - 1]), 1e-5);
  EXPECT_LT(farthest(frames[5], frames[4]), 1e-5);
}

TEST(Tissue, a_fully_active_muscle_is_straighter_keeps_its_volume_and_inverts_nothing) {
  Scene scene = tube_scene();
  // Bulges to the front.
  Points& vertices = scene.muscles[0].surface.vertices;
  for (Index v = 0; v < static_cast<Index>(vertices.cols()); ++v)
    vertices(0, v) += 0.02 * std::max(0.0, std::cos(pi / 2 * vertices(2, v) / 0.07));
  const Real volume = enclosed_volume(vertices, scene.muscles[0].surface.faces);
  const auto front = [&](Real activation) {
    const auto method = make_tissue_method(scene, tube_fields());
    Pose pose = flexed(scene, 0);
    pose.activations = {activation};
    for (int frame = 1; frame <= 20; ++frame) {
      const StepReport report = method->advance(pose, usual_time_step);
      EXPECT_GT(metric(report.muscles[0].metrics, "least_volume_ratio"), 0.05);
    }
    const Points points = frame_of(*method, pose, 20).muscles[0].points;
    EXPECT_NEAR(enclosed_volume(points, scene.muscles[0].surface.faces) / volume, 1, 0.001);
    return points.row(0).maxCoeff();
  };
  const Real relaxed = front(0), active = front(1);
  EXPECT_LT(active, relaxed - 0.001);
}

TEST(Tissue, every_setting_has_its_row) {
  EXPECT_EQ(setting_table<TissueSettings>().size(), member_count<TissueSettings>());
}

/// One muscle of the built-in hip through flexion.
class TissueOnHip : public ::testing::Test {
 protected:
  Scene scene = [] {
    Scene hip = builtin_hip();
    std::erase_if(hip.muscles, [](const Muscle& muscle) { return muscle.name != "iliacus_r"; });
    hip.method.name = "tissue";
    hip.method.settings = {{"tension_frames", 1},
                           {"minimizer_iterations", 1000},
                           {"minimizer_residual", 1e-5},
                           {"cell_size", 0.01},
                           {"cells_at_least", 0}};
    return hip;
  }();
  std::unique_ptr<DeformationMethod> method = make_method(scene, [this](const DistanceFieldSettings& settings) {
    std::vector<DistanceField> fields;
    for (const Bone& bone : scene.bones) fields.push_back(build_bone_field(bone, settings));
    return fields;
  });
  StepReport flex(Real angle) {
    std::vector<Real> coordinates = capture_coordinates(scene);
    coordinates[0] = radians(angle);
    return method->advance(pose_at(scene, coordinates), usual_time_step);
  }
  Points shape() const { return frame_of(*method, {}, 0).muscles[0].points; }
};

TEST_F(TissueOnHip, the_shape_at_a_pose_does_not_depend_on_the_way_there_and_the_volume_stays) {
  ASSERT_EQ(scene.muscles.size(), 1U);
  const TriangleMesh& surface = scene.muscles[0].surface;
  const Real volume = enclosed_volume(surface.vertices, surface.faces);
  Points there;
  for (const Real angle : {10, 20, 30, 40, 30, 20}) {
    const StepReport report = flex(angle);
    EXPECT_GT(metric(report.muscles[0].metrics, "least_volume_ratio"), 0.1) << angle;
    EXPECT_NEAR(enclosed_volume(shape(), surface.faces) / volume, 1, 0.001) << angle;
    if (there.size() == 0 && angle == 20) there = shape();
  }
  const Eigen::RowVectorXd apart = (shape() - there).colwise().norm();
  EXPECT_GT((there - surface.vertices).colwise().norm().maxCoeff(), 0.01) << "nothing moved";
  EXPECT_LT(apart.mean(), 1e-4);
  EXPECT_LT(apart.maxCoeff(), 1e-3);
}

}  // namespace
}  // namespace gracilis
