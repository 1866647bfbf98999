#include <gracilis/dynamics/contact/mesh/bounds_lanes.hpp>
#include <gracilis/dynamics/contact/mesh/patch_tree.hpp>

#include <shapes.hpp>

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace gracilis {
namespace {

struct PatchedSurface {
  ContactSurface contact;
  Particles particles;
  PatchTree tree;

  explicit PatchedSurface(const TriangleMesh& mesh)
      : contact(build_contact_surface(mesh.faces, mesh.vertex_count())),
        particles(make_particles(mesh.vertices, Eigen::VectorXd::Ones(mesh.vertex_count()))),
        tree(build_patch_tree(contact, mesh.vertices.cast<float>())) {
    look();
  }

  /// After particles moved.
  void look() { refit(contact, particles, tree); }

  /// What the tree finds for each particle, by what it finds for the bundle.
  std::set<std::pair<Index, Index>> candidates(float reach) const {
    std::set<std::pair<Index, Index>> found;
    std::vector<Index> patches;
    BoundsLanes lanes;
    std::vector<NearPatch> near;
    for (std::size_t bundle = 0; bundle < tree.particle_bounds.size(); ++bundle) {
      patches.clear();
      gather_patches(tree, tree.particle_bounds[bundle], reach, patches);
      lanes.load(tree, patches);
      for (const Index p : tree.particles_of(bundle)) {
        find_near_patches(lanes, particles.position(p), tree.outward.col(p), reach, near);
        for (const NearPatch& patch : near)
          for (Index f = tree.nodes[static_cast<std::size_t>(patch.node)].begin;
               f < tree.nodes[static_cast<std::size_t>(patch.node)].end; ++f)
            found.insert({p, tree.faces[static_cast<std::size_t>(f)]});
      }
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
  const PatchedSurface surface(shapes::sphere(Vec3::Zero(), 0.01, 3));
  std::set<Index> faces, particles;
  for (const Index node : surface.tree.patches)
    for (Index i = surface.tree.nodes[static_cast<std::size_t>(node)].begin;
         i < surface.tree.nodes[static_cast<std::size_t>(node)].end; ++i)
      EXPECT_TRUE(faces.insert(surface.tree.faces[static_cast<std::size_t>(i)]).second);
  EXPECT_EQ(static_cast<Index>(faces.size()), surface.contact.faces.cols());
  for (const Index p : surface.tree.particles) EXPECT_TRUE(particles.insert(p).second);
  EXPECT_EQ(static_cast<Index>(particles.size()), surface.particles.count());
  EXPECT_EQ(surface.tree.particle_offsets.size(), surface.tree.particle_bounds.size() + 1);
}

TEST(PatchTree, of_nothing_is_empty) {
  const PatchTree tree = build_patch_tree(build_contact_surface(Eigen::Matrix3Xi(3, 0), 0), Eigen::Matrix3Xf(3, 0));
  EXPECT_TRUE(tree.nodes.empty());
  std::vector<Index> near;
  gather_patches(tree, {}, 1, near);
  EXPECT_TRUE(near.empty());
}

TEST(PatchTree, a_ball_may_not_meet_itself) {
  const PatchedSurface surface(shapes::sphere(Vec3::Zero(), 0.01, 4));
  EXPECT_TRUE(surface.opposed(0.001f).empty());
  EXPECT_TRUE(surface.candidates(0.001f).empty());
}

TEST(PatchTree, finds_all_that_face_against_each_other_on_a_flattened_and_crumpled_ball) {
  PatchedSurface surface(shapes::sphere(Vec3::Zero(), 0.01, 3));
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

TEST(PatchTree, survives_faces_without_area) {
  PatchedSurface surface(shapes::sphere(Vec3::Zero(), 0.01, 2));
  for (Index p = 0; p < surface.particles.count(); ++p) surface.particles.position(p).setConstant(0.001f);
  surface.look();
  for (const auto& bounds : surface.tree.bounds) EXPECT_TRUE(bounds.normals.low.allFinite());
  EXPECT_FALSE(surface.candidates(0.001f).empty()) << "what has no direction may meet anything";
}

}  // namespace gracilis
