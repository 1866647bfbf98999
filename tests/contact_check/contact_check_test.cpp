#include <contact_check/containment.hpp>
#include <contact_check/gates.hpp>
#include <contact_check/recorded_run.hpp>
#include <shapes.hpp>

#include <gtest/gtest.h>

#include <limits>

/// The judge on shapes whose answer is known.
namespace gracilis::contact_check {

static TriangleMesh moved(TriangleMesh mesh, const Vec3& by) {
  mesh.vertices.colwise() += by;
  return mesh;
}

static TriangleMesh unit_box() { return shapes::box({0, 0, 0}, {1, 1, 1}); }

static JudgedMuscle free_muscle(const std::string& name, const TriangleMesh& mesh) {
  return {name, mesh, std::vector<char>(static_cast<std::size_t>(mesh.vertex_count()), 0)};
}

/// `along` × 1 squares of two triangles in the plane z = 0; vertices 2 i and 2 i + 1 at x = i.
static TriangleMesh strip(int along) {
  std::vector<Vec3> v;
  std::vector<Eigen::Vector3i> f;
  for (int i = 0; i <= along; ++i) v.emplace_back(i, 0, 0), v.emplace_back(i, 1, 0);
  for (int i = 0; i < along; ++i)
    f.emplace_back(2 * i, 2 * i + 2, 2 * i + 1), f.emplace_back(2 * i + 1, 2 * i + 2, 2 * i + 3);
  return shapes::mesh_of(v, f);
}

/// The strip rolled up about y so that its far end turns by `angle` in all; radius 1.
static TriangleMesh rolled(TriangleMesh mesh, Real angle) {
  const Real length = mesh.vertices.row(0).maxCoeff();
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const Real at = mesh.vertices(0, v) / length * angle;
    mesh.vertices.col(v) = Vec3(std::sin(at), mesh.vertices(1, v), 1 - std::cos(at));
  }
  return mesh;
}

TEST(Intersections, boxes_apart_have_none) {
  EXPECT_TRUE(intersecting_faces(unit_box(), moved(unit_box(), {1.001, 0, 0})).empty());
}

TEST(Intersections, a_box_inside_a_box_has_none) {
  EXPECT_TRUE(intersecting_faces(unit_box(), shapes::box({0.2, 0.2, 0.2}, {0.8, 0.8, 0.8})).empty());
}

TEST(Intersections, triangles_that_cross_are_found_and_named) {
  const TriangleMesh lying =
      shapes::mesh_of({{5, 5, 5}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {6, 5, 5}, {5, 6, 5}}, {{0, 4, 5}, {1, 2, 3}});
  const TriangleMesh standing = shapes::mesh_of({{0.2, 0.2, -1}, {0.3, 0.2, -1}, {0.2, 0.2, 1}}, {{0, 1, 2}});
  EXPECT_EQ(intersecting_faces(lying, standing), (std::vector<IndexPair>{{1, 0}}));
  EXPECT_TRUE(intersecting_faces(lying, moved(standing, {0.7, 0.2, 0})).empty());
}

TEST(Intersections, touching_in_one_point_counts) {
  const TriangleMesh lying = shapes::mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  const TriangleMesh tip = shapes::mesh_of({{0.25, 0.25, 0}, {0.25, 0.5, 1}, {0.5, 0.25, 1}}, {{0, 1, 2}});
  EXPECT_EQ(intersecting_faces(lying, tip).size(), 1u);
  EXPECT_TRUE(intersecting_faces(lying, moved(tip, {0, 0, std::numeric_limits<Real>::min()})).empty());
}

TEST(Intersections, a_face_without_area_is_left_out) {
  const TriangleMesh lying = shapes::mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  const TriangleMesh needle = shapes::mesh_of({{0.25, 0.25, -1}, {0.25, 0.25, 0.5}, {0.25, 0.25, 1}}, {{0, 1, 2}});
  EXPECT_TRUE(intersecting_faces(lying, needle).empty());
}

TEST(Intersections, a_sound_surface_does_not_cut_itself) {
  EXPECT_TRUE(self_intersecting_faces(unit_box()).empty());
  EXPECT_TRUE(self_intersecting_faces(shapes::sphere({0, 0, 0}, 1, 4)).empty());
  EXPECT_TRUE(self_intersecting_faces(rolled(strip(40), radians(350))).empty());
}

TEST(Intersections, two_boxes_of_one_surface_cut_each_other_as_two_surfaces_do) {
  const TriangleMesh one = unit_box(), other = moved(unit_box(), {0.5, 0.4, 0.3});
  TriangleMesh both;
  both.vertices.resize(3, 16);
  both.vertices << one.vertices, other.vertices;
  both.faces.resize(3, 24);
  both.faces << one.faces, (other.faces.array() + 8).matrix();
  EXPECT_FALSE(intersecting_faces(one, other).empty());
  EXPECT_EQ(self_intersecting_faces(both).size(), intersecting_faces(one, other).size());
}

TEST(Intersections, a_sheet_rolled_into_itself_is_found) {
  TriangleMesh sheet = rolled(strip(40), radians(350));
  // The last square is bent inwards, through the first.
  sheet.vertices.rightCols(2).colwise() += Vec3(0.3, 0, -0.03);
  const std::vector<IndexPair> found = self_intersecting_faces(sheet);
  ASSERT_FALSE(found.empty());
  for (const IndexPair& faces : found) EXPECT_GE(faces[1], 78) << "the two last faces and no other";
}

TEST(Intersections, faces_at_one_vertex_may_cut_each_other) {
  const TriangleMesh apart =
      shapes::mesh_of({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {-1, 0, -1}, {-1, 0, 1}}, {{0, 1, 2}, {0, 3, 4}});
  EXPECT_TRUE(self_intersecting_faces(apart).empty());
  TriangleMesh through = apart;
  through.vertices.col(3) = Vec3(0.5, 0.5, -1), through.vertices.col(4) = Vec3(0.5, 0.5, 1);
  EXPECT_EQ(self_intersecting_faces(through), (std::vector<IndexPair>{{0, 1}}));
}

TEST(Intersections, faces_at_one_edge_cut_each_other_only_when_folded_flat) {
  const TriangleMesh open = shapes::mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.5, -1, 0}}, {{0, 1, 2}, {1, 0, 3}});
  EXPECT_TRUE(self_intersecting_faces(open).empty());
  TriangleMesh nearly = open;
  nearly.vertices.col(3) = Vec3(0.5, 1, 1e-12);
  EXPECT_TRUE(self_intersecting_faces(nearly).empty());
  TriangleMesh flat = open;
  flat.vertices.col(3) = Vec3(0.5, 1, 0);
  EXPECT_EQ(self_intersecting_faces(flat).size(), 1u);
}

TEST(Intersections, the_edges_of_a_box_are_eighteen) { EXPECT_EQ(edges_of(unit_box()).size(), 18u); }

TEST(Intersections, an_edge_through_a_plate_is_found_although_both_ends_are_outside) {
  const TriangleMesh plate = shapes::box({-1, -1, -0.01}, {1, 1, 0.01});
  Points points(3, 4);
  points.col(0) = Vec3(0, 0, 0.5), points.col(1) = Vec3(0.1, 0, -0.5);
  points.col(2) = Vec3(3, 0, 0.5), points.col(3) = Vec3(3, 0, -0.5);
  EXPECT_EQ(Solid(plate).depths(points).maxCoeff(), 0);
  EXPECT_EQ(crossing_edges(points, {{0, 1}, {0, 2}, {2, 3}}, plate), (std::vector<Index>{0}));
}

TEST(Containment, depth_is_the_distance_to_the_surface_inside_and_zero_elsewhere) {
  Points points(3, 4);
  points.col(0) = Vec3(0.5, 0.5, 0.9), points.col(1) = Vec3(0.5, 0.5, 1.1), points.col(2) = Vec3(0.5, 0.5, 0.5);
  points.col(3) = Vec3(0.5, 0.5, 1);
  const Eigen::VectorXd depths = Solid(unit_box()).depths(points);
  EXPECT_NEAR(depths[0], 0.1, 1e-12);
  EXPECT_EQ(depths[1], 0);
  EXPECT_NEAR(depths[2], 0.5, 1e-12);
  EXPECT_EQ(depths[3], 0);
}

TEST(Containment, a_surface_turned_inside_out_has_the_same_inside) {
  TriangleMesh box = unit_box();
  box.faces.row(0).swap(box.faces.row(1));
  EXPECT_NEAR(Solid(box).depths(Vec3(0.5, 0.5, 0.9))[0], 0.1, 1e-12);
}

TEST(Folding, a_dihedral_that_opens_and_closes_turns_by_the_angle_it_was_given) {
  for (const Real from : {-170.0, -90.0, 0.0, 100.0, 179.0}) {
    for (const Real to : {-179.0, -45.0, 0.0, 90.0, 180.0}) {
      const auto at = [](Real angle) {
        const Real a = radians(angle);
        return shapes::mesh_of({{0, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {std::cos(a), 0.3, -std::sin(a)}},
                               {{0, 1, 2}, {1, 0, 3}});
      };
      const std::vector<Dihedral> dihedrals = dihedrals_of(at(from));
      ASSERT_EQ(dihedrals.size(), 1u);
      const Real turned = turned_by(dihedral_angle_of(dihedrals[0], at(to).vertices),
                                    dihedral_angle_of(dihedrals[0], at(from).vertices));
      const Real difference = std::abs(to - from);
      EXPECT_NEAR(degrees(turned), std::min(difference, 360 - difference), 1e-9) << from << " to " << to;
    }
  }
}

TEST(Folding, convex_dihedrals_are_positive) {
  const TriangleMesh box = unit_box();
  Real sum = 0;
  for (const Dihedral& dihedral : dihedrals_of(box)) {
    EXPECT_GE(dihedral_angle_of(dihedral, box.vertices), -1e-12);
    sum += dihedral_angle_of(dihedral, box.vertices);
  }
  EXPECT_NEAR(sum, 12 * pi / 2, 1e-9);
}

TEST(Folding, volume_is_the_box_s_wherever_it_is) {
  EXPECT_NEAR(enclosed_volume(unit_box().vertices, unit_box().faces), 1, 1e-12);
  const TriangleMesh far = moved(unit_box(), {1e3, 0, 0});
  EXPECT_NEAR(enclosed_volume(far.vertices, far.faces), 1, 1e-9);
}

/// Two muscles of 100 mm and a bone, all apart by 2 mm.
struct SmallScene {
  TriangleMesh one = shapes::sphere({0, 0, 0}, 0.05, 3), other = shapes::sphere({0.102, 0, 0}, 0.05, 3);
  TriangleMesh bone = shapes::box({-0.1, -0.1, -0.072}, {0.2, 0.1, -0.052});
  Judge judge{{free_muscle("one", one), free_muscle("other", other)}, {{"bone", bone}}};

  Verdict held(const Points& now_one, const Points& now_other) const {
    return hold_against({}, judge, judge.judge(1, {now_one, now_other}, {bone.vertices}));
  }
};

TEST(Judge, rest_holds_all_gates) {
  const SmallScene scene;
  for (const Worst& worst : scene.held(scene.one.vertices, scene.other.vertices)) {
    EXPECT_FALSE(worst.missed);
    EXPECT_EQ(worst.value, 0);
  }
}

TEST(Judge, spheres_pushed_into_each_other_are_as_deep_as_they_were_pushed) {
  const SmallScene scene;
  const Verdict held = scene.held(moved(scene.one, {0.005, 0, 0}).vertices, scene.other.vertices);
  EXPECT_GT(held[face_pairs].value, 0);
  EXPECT_TRUE(held[face_pairs].missed);
  EXPECT_TRUE(held[deep_share].missed);
  EXPECT_NEAR(held[depth].value, 3, 0.05);  // mm; below the poles, the nearest facet is a little inclined
  EXPECT_TRUE(held[depth].missed);
  EXPECT_EQ(held[depth].where, "one + other");
  EXPECT_FALSE(held[self_pairs].missed || held[bone_edges].missed || held[folded_share].missed ||
               held[volume_error].missed);
}

TEST(Judge, what_overlaps_at_rest_may_stay_but_not_grow) {
  const TriangleMesh one = shapes::sphere({0, 0, 0}, 0.05, 3), other = shapes::sphere({0.097, 0, 0}, 0.05, 3);
  const Judge judge({free_muscle("one", one), free_muscle("other", other)}, {});
  const auto held = [&](Real by) {
    return hold_against({}, judge, judge.judge(1, {moved(one, {by, 0, 0}).vertices, other.vertices}, {}));
  };
  for (const Real by : {0.0, -0.001, -0.01})
    for (const Worst& worst : held(by)) EXPECT_FALSE(worst.missed) << by;
  EXPECT_NEAR(held(0.0005)[growth].value, 0.5, 0.01);
  EXPECT_TRUE(held(0.0005)[growth].missed);
}

TEST(Judge, edges_that_enter_a_bone_are_counted_unless_both_ends_are_attached) {
  const SmallScene scene;
  const Points sunk = moved(scene.one, {0, 0, -0.005}).vertices;
  EXPECT_TRUE(scene.held(sunk, scene.other.vertices)[bone_edges].missed);

  JudgedMuscle attached = free_muscle("one", scene.one);
  attached.attached.assign(attached.attached.size(), 1);
  const Judge judge({attached}, {{"bone", scene.bone}});
  EXPECT_EQ(judge.judge(1, {sunk}, {scene.bone.vertices}).muscles[0].bone_edges, 0);
}

TEST(Judge, a_muscle_that_leaves_a_bone_it_overlapped_at_rest_has_no_new_edges_in_it) {
  const TriangleMesh muscle = shapes::sphere({0, 0, 0}, 0.05, 4),
                     bone = shapes::box({-0.1, -0.1, -0.1}, {0.1, 0.1, -0.04});
  const Judge judge({free_muscle("muscle", muscle)}, {{"bone", bone}});
  const auto edges = [&](Real up) {
    return judge.judge(1, {moved(muscle, {0, 0, up}).vertices}, {bone.vertices}).muscles[0];
  };
  EXPECT_GT(edges(0).bone_edges_all_rest, 0);
  EXPECT_EQ(edges(0.005).bone_edges, 0);
  EXPECT_GT(edges(0.005).bone_edges_all, 0);
  EXPECT_GT(edges(-0.005).bone_edges, 0);
}

TEST(Judge, one_folded_corner_is_named_with_its_muscle) {
  const SmallScene scene;
  Points folded = scene.one.vertices;
  folded.col(0) *= 0.5;  // an apex pushed in
  const Verdict held = scene.held(folded, scene.other.vertices);
  EXPECT_GT(held[folded_share].value, 0);
  EXPECT_EQ(held[folded_share].where, "one");
  EXPECT_GT(held[volume_error].value, 0);
}

TEST(Judge, a_frame_that_is_not_finite_misses_every_gate) {
  const SmallScene scene;
  Points broken = scene.one.vertices;
  broken(0, 0) = std::numeric_limits<Real>::quiet_NaN();
  for (const Worst& worst : scene.held(broken, scene.other.vertices)) EXPECT_TRUE(worst.missed);
}

TEST(RecordedRun, vertices_that_move_with_a_bone_are_told_from_others) {
  const Points bone = unit_box().vertices;
  const RigidTransform motion = Eigen::Translation3d(0.1, 0, 0) * Eigen::AngleAxisd(0.3, Vec3::UnitZ());
  Points muscle(3, 2);
  muscle << 1, 2, 3, 4, 5, 6;
  Points now = motion * muscle;
  now.col(1) += Vec3(0, 0, 1e-5);
  EXPECT_EQ(moves_with(bone, motion * bone, muscle, now), (std::vector<char>{1, 0}));
}

}  // namespace gracilis::contact_check
