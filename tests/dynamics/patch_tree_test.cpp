#include <gracilis/dynamics/patch_tree.hpp>

#include <shapes.hpp>

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace gracilis {
namespace {

struct Surface {
  ContactSurface contact;
  Particles particles;
  PatchTree tree;

  explicit Surface(const TriangleMesh& mesh)
      : contact(build_contact_surface(mesh.faces, mesh.vertex_count())),
        particles(make_particles(mesh.vertices, Eigen::VectorXd::Ones(mesh.vertex_count()))),
        tree(build_patch_tree(contact, mesh.vertices.cast<float>())) {
    look();
  }

  /// After particles moved.
  void look() { refit(contact, particles, tree); }

  /// What the tree finds for the particles of each patch.
  std::set<std::pair<Index, Index>> candidates(float reach) const {
    std::set<std::pair<Index, Index>> found;
    std::vector<Index> near;
    for (Index patch = 0; patch < static_cast<Index>(tree.patches.size()); ++patch) {
      near.clear();
      const auto at = static_cast<std::size_t>(patch);
      gather_patches(tree, tree.particle_bounds[at], reach, near);
      for (Index i = tree.particle_offsets[at]; i < tree.particle_offsets[at + 1]; ++i)
        for (const Index node : near)
          for (Index f = tree.nodes[static_cast<std::size_t>(node)].begin;
               f < tree.nodes[static_cast<std::size_t>(node)].end; ++f)
            found.insert({tree.particles[static_cast<std::size_t>(i)], tree.faces[static_cast<std::size_t>(f)]});
    }
    return found;
  }

  /// Particles and faces whose boxes are within reach and which face against each other, by looking at all.
  std::set<std::pair<Index, Index>> opposed(float reach) const {
    std::set<std::pair<Index, Index>> found;
    for (Index p = 0; p < particles.count(); ++p)
      for (Index f = 0; f < contact.faces.cols(); ++f) {
        if (!(tree.areas.col(f).dot(tree.outward.col(p)) < 0)) continue;
        Eigen::AlignedBox3f box;
        for (const Index corner : contact.faces.col(f)) box.extend(particles.position(corner));
        if (box.squaredExteriorDistance(Eigen::Vector3f(particles.position(p))) < reach * reach) found.insert({p, f});
      }
    return found;
  }
};

}  // namespace

TEST(PatchTree, holds_every_face_and_every_particle_once) {
  const Surface surface(shapes::sphere(Vec3::Zero(), 0.01, 3));
  std::set<Index> faces, particles;
  for (const Index node : surface.tree.patches)
    for (Index i = surface.tree.nodes[static_cast<std::size_t>(node)].begin;
         i < surface.tree.nodes[static_cast<std::size_t>(node)].end; ++i)
      EXPECT_TRUE(faces.insert(surface.tree.faces[static_cast<std::size_t>(i)]).second);
  EXPECT_EQ(static_cast<Index>(faces.size()), surface.contact.faces.cols());
  for (const Index p : surface.tree.particles) EXPECT_TRUE(particles.insert(p).second);
  EXPECT_EQ(static_cast<Index>(particles.size()), surface.particles.count());
  EXPECT_EQ(surface.tree.particle_offsets.size(), surface.tree.patches.size() + 1);
}

TEST(PatchTree, of_nothing_is_empty) {
  const PatchTree tree = build_patch_tree(build_contact_surface(Eigen::Matrix3Xi(3, 0), 0), Eigen::Matrix3Xf(3, 0));
  EXPECT_TRUE(tree.nodes.empty());
  std::vector<Index> near;
  gather_patches(tree, {}, 1, near);
  EXPECT_TRUE(near.empty());
}

TEST(PatchTree, a_ball_may_not_meet_itself) {
  const Surface surface(shapes::sphere(Vec3::Zero(), 0.01, 4));
  EXPECT_TRUE(surface.opposed(0.001f).empty());
  EXPECT_TRUE(surface.candidates(0.001f).empty());
}

TEST(PatchTree, finds_all_that_face_against_each_other_on_a_flattened_and_crumpled_ball) {
  Surface surface(shapes::sphere(Vec3::Zero(), 0.01, 3));
  std::mt19937 generator(7);
  std::uniform_real_distribution<float> crumple(-0.0004f, 0.0004f);
  for (Index p = 0; p < surface.particles.count(); ++p) {
    surface.particles.position(p).z() *= 0.04f;
    surface.particles.position(p) += Eigen::Vector3f(crumple(generator), crumple(generator), crumple(generator));
  }
  surface.look();
  const auto expected = surface.opposed(0.001f), found = surface.candidates(0.001f);
  EXPECT_GT(expected.size(), 1000u);
  EXPECT_TRUE(std::includes(found.begin(), found.end(), expected.begin(), expected.end()));
  const auto all =
      static_cast<std::size_t>(surface.particles.count()) * static_cast<std::size_t>(surface.contact.faces.cols());
  EXPECT_LT(found.size(), all / 5) << "the tree hardly helps";
}

TEST(PatchTree, a_box_meets_any_patch_exactly_if_it_gathers_some) {
  const Surface surface(shapes::sphere(Vec3::Zero(), 0.01, 3));
  std::mt19937 generator(3);
  std::uniform_real_distribution<float> place(-0.02f, 0.02f);
  int meetings = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    PatchTree::Bounds bounds;
    bounds.places.extend(Eigen::Vector3f(place(generator), place(generator), place(generator)));
    bounds.normals = surface.tree.bounds.front().normals;
    std::vector<Index> gathered;
    gather_patches(surface.tree, bounds, 0.001f, gathered);
    EXPECT_EQ(meets_any_patch(surface.tree, bounds, 0.001f), !gathered.empty());
    meetings += !gathered.empty();
  }
  EXPECT_TRUE(meetings > 50 && meetings < 950) << meetings;
}

TEST(PatchTree, survives_faces_without_area) {
  Surface surface(shapes::sphere(Vec3::Zero(), 0.01, 2));
  for (Index p = 0; p < surface.particles.count(); ++p) surface.particles.position(p).setConstant(0.001f);
  surface.look();
  for (const auto& bounds : surface.tree.bounds) EXPECT_TRUE(bounds.normals.low.allFinite());
  EXPECT_FALSE(surface.candidates(0.001f).empty()) << "what has no direction may meet anything";
}

}  // namespace gracilis
