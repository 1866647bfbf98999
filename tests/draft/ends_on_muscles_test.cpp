#include "../shapes.hpp"
#include "body_folder.hpp"
#include "drafted_scene.hpp"

#include <gracilis/anatomy/attachments/muscle_bodies.hpp>
#include <gracilis/anatomy/resolution/divided_muscle.hpp>
#include <gracilis/geometry/nearest_triangle.hpp>
#include <gracilis/io/mesh/load_surface.hpp>
#include <gracilis/io/scene/demo_scene.hpp>

#include <gmock/gmock.h>

/// Ends that share another muscle's tendon: the built-in elbow with heads made shorter.
namespace gracilis {
namespace {

const std::map<std::string, std::string> elbow_names = {{"scapula_r", "scapula_r.vtp"},
                                                        {"humerus_r", "humerus_r.vtp"},
                                                        {"ulna_r", "ulna_r.vtp"},
                                                        {"radius_r", "radius_r.vtp"},
                                                        {"biceps_brachii_long_r", "biceps_brachii_long_r.vtp"},
                                                        {"triceps_brachii_medial_r", "triceps_brachii_medial_r.vtp"}};

const Vec3 coracoid(0.027, 0.307, -0.034), above_olecranon(-0.02, 0.12, 0);  // m

const Scene& whole_elbow() {
  static const Scene scene = demo_scene("elbow");
  return scene;
}

template <typename Named>
const Named& named(const std::vector<Named>& all, const std::string& name) {
  for (const Named& each : all)
    if (each.name == name) return each;
  throw std::runtime_error("nothing is called " + name);
}

/// A straight muscle.
TriangleMesh tube(const Vec3& from, const Vec3& to, Real radius = 0.005, int around = 12, int along = 40) {
  TriangleMesh mesh = shapes::cylinder(radius, (to - from).norm(), around, along);
  const Eigen::Matrix3d turn = Eigen::Quaternion<Real>::FromTwoVectors(Vec3::UnitZ(), to - from).toRotationMatrix();
  mesh.vertices = (turn * mesh.vertices).colwise() + from;
  return mesh;
}

class EndsOnMuscles : public testing::Test {
 protected:
  void SetUp() override { write_body(arm(), whole_elbow(), elbow_names); }
  std::filesystem::path arm() const { return folder_.path() / "arm"; }
  void add(const std::string& name, const TriangleMesh& mesh) const {
    write_surface(arm() / (name + ".vtp"), mesh.vertices, mesh.faces);
  }
  LoadedScene drafted() const { return drafted_scene(arm()); }

  /// The vertex of a muscle of the built-in elbow that is nearest to p.
  static Vec3 on(const std::string& muscle, const Vec3& p) {
    const Points& vertices = named(whole_elbow().muscles, muscle).surface.vertices;
    Eigen::Index nearest = 0;
    (vertices.colwise() - p).colwise().norm().minCoeff(&nearest);
    return vertices.col(nearest);
  }

  /// What an end of a drafted muscle lies on: a muscle's or a body's name.
  static std::string under(const Scene& scene, const std::string& muscle, AttachmentEnd end) {
    for (const Attachment& each : named(scene.muscles, muscle).attachments) {
      if (each.end != end) continue;
      const MuscleBody* carried = muscle_body(scene, each.body);
      return carried ? scene.muscles[static_cast<std::size_t>(carried->muscle)].name
                     : scene.bodies[static_cast<std::size_t>(each.body)];
    }
    return "";
  }

  TestFolder folder_;
};

TEST_F(EndsOnMuscles, heads_that_reach_their_bones_stay_there) {
  const TestFolder whole;
  std::map<std::string, std::string> names = elbow_names;
  for (const Muscle& muscle : whole_elbow().muscles) names[muscle.name] = muscle.name + ".vtp";
  write_body(whole.path() / "arm", whole_elbow(), names);
  const Scene scene = drafted_scene(whole.path() / "arm").scene;
  EXPECT_EQ(scene.muscles.size(), whole_elbow().muscles.size());
  EXPECT_TRUE(scene.muscle_bodies.empty());
}

TEST_F(EndsOnMuscles, a_short_head_that_ends_on_the_long_one_lies_on_it) {
  const Vec3 tip = on("biceps_brachii_long_r", {0.036, 0.06, -0.008});
  add("biceps_brachii_short_r", tube(coracoid, tip));
  const LoadedScene loaded = drafted();
  EXPECT_EQ(under(loaded.scene, "biceps_brachii_short_r", AttachmentEnd::insertion), "biceps_brachii_long_r");
  EXPECT_EQ(under(loaded.scene, "biceps_brachii_short_r", AttachmentEnd::origin), "scapula_r");
  EXPECT_EQ(under(loaded.scene, "biceps_brachii_long_r", AttachmentEnd::insertion), "ulna_r") << "which radius is on";
  const Muscle& head = named(loaded.scene.muscles, "biceps_brachii_short_r");
  const NearestTriangle host(named(loaded.scene.muscles, "biceps_brachii_long_r").surface);
  for (const Attachment& each : head.attachments) {
    EXPECT_TRUE(each.guessed);
    if (each.end == AttachmentEnd::origin) continue;
    for (const Index v : each.vertices) {
      EXPECT_LT((head.surface.vertices.col(v) - tip).norm(), 0.1 * (tip - coracoid).norm()) << "only the tip";
      EXPECT_LE(host.query(head.surface.vertices.col(v)).distance, 0.0061);
    }
  }
}

TEST_F(EndsOnMuscles, what_anatomy_keeps_on_bones_is_not_laid_on_muscles) {
  add("coracobrachialis_r", tube(coracoid, on("biceps_brachii_long_r", {0.036, 0.06, -0.008})));
  EXPECT_TRUE(drafted().scene.muscle_bodies.empty());
}

TEST_F(EndsOnMuscles, a_head_beside_the_other_that_does_not_reach_it_is_not_laid_on_it) {
  add("biceps_brachii_short_r", tube(coracoid, on("biceps_brachii_long_r", {0.036, 0.06, -0.008}) + Vec3(0.02, 0, 0)));
  EXPECT_TRUE(drafted().scene.muscle_bodies.empty());
}

TEST_F(EndsOnMuscles, of_two_heads_that_reach_no_bone_none_lies_on_the_other) {
  std::filesystem::remove(arm() / "biceps_brachii_long_r.vtp");
  const Vec3 tip(0.04, 0.06, 0);
  add("biceps_brachii_long_r", tube(coracoid + Vec3(0, 0, 0.01), tip));
  add("biceps_brachii_short_r", tube(coracoid, tip));
  EXPECT_TRUE(drafted().scene.muscle_bodies.empty());
}

TEST_F(EndsOnMuscles, heads_lie_on_heads_that_lie_on_heads) {
  const Vec3 tip = on("triceps_brachii_medial_r", {-0.03, 0.1, -0.006});
  const Vec3 infraglenoid = on("biceps_brachii_long_r", coracoid) - Vec3(0.06, 0.06, 0.02);
  add("triceps_brachii_long_r", tube(infraglenoid, tip));
  // The lateral head, from the back of the humerus, reaches no more than the long one's middle.
  const Vec3 middle = infraglenoid + 0.7 * (tip - infraglenoid);
  add("triceps_brachii_lateral_r", tube(on("triceps_brachii_medial_r", {-0.012, 0.178, 0.0}), middle));
  const Scene scene = drafted().scene;
  EXPECT_EQ(under(scene, "triceps_brachii_long_r", AttachmentEnd::insertion), "triceps_brachii_medial_r");
  EXPECT_EQ(under(scene, "triceps_brachii_lateral_r", AttachmentEnd::insertion), "triceps_brachii_long_r");
  EXPECT_EQ(hosts_first(scene).size(), 3u);
}

TEST_F(EndsOnMuscles, an_end_much_nearer_to_its_tendon_than_to_its_bone_lies_on_that) {
  const NearestTriangle radius(named(whole_elbow().bones, "radius_r").surface);
  const TriangleMesh& host = named(whole_elbow().muscles, "biceps_brachii_long_r").surface;
  // On the tendon's side that looks away from the bone, where that ends.
  Vec3 tip = Vec3::Zero();
  Real farthest = 0;
  for (const auto& vertex : host.vertices.colwise())
    if (const Real away = radius.query(vertex).distance; vertex.y() < -0.038 && away > farthest)
      farthest = away, tip = vertex;
  tip += 0.003 * (tip - radius.query(tip).point).normalized();
  add("biceps_brachii_short_r", tube(coracoid + Vec3(0.02, -0.05, 0.03), tip));
  const SceneDraft draft = draft_scene(arm());
  for (const DraftMuscle& muscle : draft.muscles)
    for (const DraftAttachment& each : muscle.attachments)
      if (muscle.found->name == "biceps_brachii_short_r" && each.end == AttachmentEnd::insertion) {
        EXPECT_EQ(each.muscle, "biceps_brachii_long_r");
        EXPECT_TRUE(std::isfinite(each.from_bone)) << "it does reach its bone";
        EXPECT_LT(each.guess.certainty, doubtful);
      }
}

TEST_F(EndsOnMuscles, an_end_of_needles_holds_what_the_reader_puts_between_its_vertices) {
  // Rings 25 mm apart, of so few vertices that an end needs two of them; it reaches no bone and no muscle.
  const Vec3 tip = on("biceps_brachii_long_r", {0.036, 0.06, -0.008}) + Vec3(0.02, 0, 0);
  add("biceps_brachii_short_r", tube(coracoid, tip, 0.002, 6, 10));
  const Muscle head = named(drafted().scene.muscles, "biceps_brachii_short_r");
  std::vector<Muscle> of_file(1);
  of_file[0].surface = load_surface(arm() / "biceps_brachii_short_r.vtp", 1, SurfaceRole::muscle).mesh;
  const VerticesBetween added = divide_needles(of_file).front();
  ASSERT_EQ(head.surface.vertex_count(), of_file[0].surface.vertex_count());
  std::vector<Index> held;
  for (const Attachment& each : head.attachments)
    if (each.end == AttachmentEnd::insertion) held = each.vertices;
  std::vector<Index> whole = held;
  std::erase_if(whole, [&](Index v) { return v >= added.first; });
  const std::size_t of_the_file = whole.size();
  add_vertices_between(added, whole);
  EXPECT_GT(whole.size(), of_the_file);
  EXPECT_EQ(held, whole);
}

TEST_F(EndsOnMuscles, two_ends_of_the_same_vertices_share_them) {
  // Both patches reach over the whole of a small muscle beside the joint, and from there along a bone each.
  const Vec3 place(0, 0, 0.03), aside(0.004, 0, 0);
  add("brachialis_r", shapes::sphere(place, 0.002, 2));
  const auto add_patch = [&](const std::string& end, const std::string& bone, const Vec3& towards) {
    const Vec3 on_bone = NearestTriangle(named(whole_elbow().bones, bone).surface).query(towards).point;
    std::filesystem::create_directories(arm() / "patches");
    add("patches/brachialis_r_" + end, shapes::mesh_of({place - aside, place + aside, on_bone}, {{0, 1, 2}}));
  };
  add_patch("origin", "humerus_r", {0, 0.15, 0});
  add_patch("insertion", "ulna_r", {0, -0.15, 0});
  const SceneDraft draft = draft_scene(arm());
  ASSERT_EQ(draft.muscles.size(), 3u) << testing::PrintToString(draft.left_out);
  for (const DraftMuscle& muscle : draft.muscles) {
    if (muscle.found->name != "brachialis_r") continue;
    ASSERT_EQ(muscle.attachments.size(), 2u);
    const std::vector<Index>&first = muscle.attachments[0].vertices, &second = muscle.attachments[1].vertices;
    EXPECT_EQ(first.size() + second.size(), 66u);
    EXPECT_GE(std::min(first.size(), second.size()), 22u);
  }
}

TEST_F(EndsOnMuscles, tendons_join_muscles_that_the_dictionary_knows) {
  EXPECT_GT(dictionary().tendons.size(), 10u);
  for (const KnownTendon& tendon : dictionary().tendons) {
    EXPECT_GE(tendon.muscles.size(), 2u) << tendon.name;
    for (const std::string& name : tendon.muscles)
      EXPECT_EQ(std::count_if(dictionary().muscles.begin(), dictionary().muscles.end(),
                              [&](const KnownMuscle& known) { return known.name == name; }),
                1)
          << tendon.name << ": " << name;
  }
}

}  // namespace
}  // namespace gracilis
