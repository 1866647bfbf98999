#include <gracilis/dynamics/contact/mesh/patch_tree.hpp>

#include <gracilis/core/parallel.hpp>

#include <algorithm>

namespace gracilis {

namespace {

/// A patch fills a pack of triangles.
constexpr Index faces_per_patch = 4, faces_per_bundle = 32;
constexpr Index patches_per_task = 64, bundles_per_task = 8;

class Builder {
 public:
  Builder(const ContactSurface& surface, const Eigen::Matrix3Xf& rest) : centers_(3, surface.faces.cols()) {
    tree_.faces.resize(static_cast<std::size_t>(surface.faces.cols()));
    for (Index f = 0; f < surface.faces.cols(); ++f) {
      tree_.faces[static_cast<std::size_t>(f)] = f;
      const Eigen::Vector3i corners = surface.faces.col(f);
      centers_.col(f) = (rest.col(corners[0]) + rest.col(corners[1]) + rest.col(corners[2])) / 3;
    }
    if (!tree_.faces.empty()) add(0, surface.faces.cols(), false);
    deal_out_particles(surface);
    tree_.bounds.resize(tree_.nodes.size());
    tree_.particle_bounds.resize(bundles_.size());
    tree_.triangles.resize(tree_.patches.size());
  }

  PatchTree take() { return std::move(tree_); }

 private:
  void add(Index begin, Index end, bool in_bundle) {
    const std::size_t node = tree_.nodes.size();
    if (!in_bundle && end - begin <= faces_per_bundle) {
      in_bundle = true;
      bundles_.push_back(static_cast<Index>(node));
    }
    tree_.nodes.push_back({begin, end});
    if (end - begin <= faces_per_patch) {
      tree_.nodes[node].patch = static_cast<Index>(tree_.patches.size());
      tree_.patches.push_back(static_cast<Index>(node));
    } else {
      const Index middle = halve(begin, end);
      add(begin, middle, in_bundle);
      add(middle, end, in_bundle);
    }
    tree_.nodes[node].skip = static_cast<Index>(tree_.nodes.size());
  }

  Index halve(Index begin, Index end) {
    Eigen::AlignedBox3f box;
    for (Index i = begin; i < end; ++i) box.extend(center(tree_.faces[static_cast<std::size_t>(i)]));
    Index axis = 0;
    box.sizes().maxCoeff(&axis);
    const Index middle = (begin + end) / 2;
    // Ties by number, so that the tree does not depend on the sorting.
    std::nth_element(
        tree_.faces.begin() + begin, tree_.faces.begin() + middle, tree_.faces.begin() + end, [&](Index l, Index r) {
          return centers_(axis, l) < centers_(axis, r) || (centers_(axis, l) == centers_(axis, r) && l < r);
        });
    return middle;
  }

  Eigen::Vector3f center(Index face) const { return centers_.col(face); }

  void deal_out_particles(const ContactSurface& surface) {
    std::vector<char> dealt(surface.vertex_faces.offsets.size(), 0);
    tree_.particle_offsets.push_back(0);
    for (const Index node : bundles_) {
      for (Index i = tree_.nodes[static_cast<std::size_t>(node)].begin;
           i < tree_.nodes[static_cast<std::size_t>(node)].end; ++i)
        for (const Index p : surface.faces.col(tree_.faces[static_cast<std::size_t>(i)])) {
          if (dealt[static_cast<std::size_t>(p)]) continue;
          dealt[static_cast<std::size_t>(p)] = 1;
          tree_.particles.push_back(p);
        }
      tree_.particle_offsets.push_back(static_cast<Index>(tree_.particles.size()));
    }
  }

  PatchTree tree_;
  Eigen::Matrix3Xf centers_;
  std::vector<Index> bundles_;  ///< nodes
};

/// A particle's place with a fourth coordinate 0.
Eigen::Array4f place_of(const Particles& particles, Index particle) {
  return Eigen::Map<const Eigen::Array4f, Eigen::Aligned16>(particles.at(particle)) * Eigen::Array4f(1, 1, 1, 0);
}

/// Fits a patch to its faces: triangles, area vectors and bounds. Lanes beyond the last face repeat it.
void refit_faces(const PatchTree::Node& node, const ContactSurface& surface, const Particles& particles,
                 PatchTree& tree) {
  PatchTree::Bounds bounds;
  std::array<TrianglePack::Rows, 3> corners;
  for (int lane = 0; lane < faces_per_patch; ++lane) {
    const Index face = tree.faces[static_cast<std::size_t>(std::min<Index>(node.begin + lane, node.end - 1))];
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Array4f place = place_of(particles, surface.faces(static_cast<Index>(k), face));
      corners[k].col(lane) = place;
      bounds.places.extend(place);
    }
  }
  TrianglePack& triangles = tree.triangles[static_cast<std::size_t>(node.patch)];
  triangles = TrianglePack::of(corners[0], corners[1], corners[2]);
  const TrianglePack::Vectors areas = triangles.areas();
  const TrianglePack::Lanes length2 = areas.dot(areas);
  const TrianglePack::Rows normals = areas.scaled((length2 > 0).select(length2.sqrt().inverse(), 0.0f)).columns(),
                           of_faces = areas.columns();
  for (int lane = 0; lane < faces_per_patch; ++lane) bounds.normals.extend(Eigen::Array4f(normals.col(lane)));
  for (Index i = node.begin; i < node.end; ++i)
    tree.areas.col(tree.faces[static_cast<std::size_t>(i)]) = of_faces.col(i - node.begin).head<3>();
  tree.bounds[static_cast<std::size_t>(tree.patches[static_cast<std::size_t>(node.patch)])] = bounds;
}

PatchTree::Bounds bounds_of_particles(const PatchTree& tree, std::size_t bundle, const Particles& particles) {
  PatchTree::Bounds bounds;
  for (const Index p : tree.particles_of(bundle)) {
    bounds.places.extend(place_of(particles, p));
    bounds.normals.extend(Eigen::Vector3f(tree.outward.col(p).normalized()));
  }
  return bounds;
}

}  // namespace

PatchTree build_patch_tree(const ContactSurface& surface, const Eigen::Matrix3Xf& rest) {
  return Builder(surface, rest).take();
}

void refit(const ContactSurface& surface, const Particles& particles, PatchTree& tree) {
  tree.areas.resize(3, surface.faces.cols());
  const auto for_each_of = [](const auto& all, Index chunk, const auto& act) {
    parallel_for(static_cast<Index>(all.size()), chunk, [&](Index begin, Index end) {
      for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) act(i);
    });
  };
  for_each_of(tree.patches, patches_per_task, [&](std::size_t patch) {
    refit_faces(tree.nodes[static_cast<std::size_t>(tree.patches[patch])], surface, particles, tree);
  });
  tree.outward = sums_around_particles(surface, tree.areas);
  for_each_of(tree.particle_bounds, bundles_per_task,
              [&](std::size_t bundle) { tree.particle_bounds[bundle] = bounds_of_particles(tree, bundle, particles); });
  for (std::size_t node = tree.nodes.size(); node-- > 0;) {
    if (tree.nodes[node].patch >= 0) continue;
    const PatchTree::Bounds &first = tree.bounds[node + 1],
                            &second = tree.bounds[static_cast<std::size_t>(tree.nodes[node + 1].skip)];
    tree.bounds[node] = first.merged(second);
  }
}

void gather_patches(const PatchTree& tree, const PatchTree::Bounds& bounds, float reach, std::vector<Index>& patches) {
  for (std::size_t node = 0; node < tree.nodes.size();) {
    const PatchTree::Node& at = tree.nodes[node];
    const bool meets = may_meet(bounds, tree.bounds[node], reach);
    if (meets && at.patch >= 0) patches.push_back(static_cast<Index>(node));
    node = meets ? node + 1 : static_cast<std::size_t>(at.skip);
  }
}

}  // namespace gracilis
