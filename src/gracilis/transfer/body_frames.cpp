#include <gracilis/transfer/body_frames.hpp>

#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/mesh_pieces.hpp>
#include <gracilis/transfer/similarity.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gracilis {

namespace {

constexpr Index samples_of_body = 1000;
constexpr Real largest_scale_error = 0.03;

/// All surfaces of a body, of a model's or a scene's bones.
template <class Bone>
TriangleMesh surface_of(const std::vector<Bone>& bones, Index body) {
  std::vector<TriangleMesh> surfaces;
  for (const Bone& bone : bones)
    if (bone.body == body) surfaces.push_back(bone.surface);
  return merged(surfaces);
}

/// The best of all turns that axes of both allow.
SimilarityFit laid_on(const PairedBone& bone) {
  SimilarityFit best;
  best.error = std::numeric_limits<Real>::infinity();
  for (const Eigen::Matrix3d& turn : principal_turns({&bone})) {
    const SimilarityFit fit = closest_similarity({&bone}, {}, turned({&bone}, turn));
    if (fit.error < best.error) best = fit;
  }
  return best;
}

/// Lays a body's surface on the scene's; says why it does not fit.
std::string register_body(const TriangleMesh& of_model, const TriangleMesh& of_scene, SharedBody& body) {
  const PairedBone bone(body.name, of_model, of_scene, samples_of_body);
  const SimilarityFit fit = laid_on(bone);
  if (std::abs(fit.similarity.scale - 1) > largest_scale_error)
    return fmt::format("its surfaces in the model are {:.3f} times as large", 1 / fit.similarity.scale);
  // The same bones are of the same size: what is left of the scale is taken away about the middle.
  const Vec3 middle = bone.from_points().rowwise().mean();
  body.frame = RigidTransform::Identity();
  body.frame.linear() = fit.similarity.rotation;
  body.frame.translation() = fit.similarity.at(middle) - fit.similarity.rotation * middle;
  body.error = fit.error * extent_of(bone.to_points());
  body.registered = true;
  return "";
}

}  // namespace

SharedBodies shared_bodies(const opensim::Model& model, const Scene& scene, const std::set<Index>& wanted,
                           const std::vector<opensim::ModelBone>& bones, const std::vector<RigidTransform>& poses) {
  SharedBodies shared;
  std::vector<std::pair<TriangleMesh, TriangleMesh>> surfaces;
  bool any = false;
  for (const Index of_scene : wanted) {
    const std::string& name = scene.bodies[static_cast<std::size_t>(of_scene)];
    const Index of_model = opensim::index_of(model.bodies, name);
    if (of_model < 0) {
      shared.left_out.push_back(fmt::format("{}: the model has no body of this name", name));
      continue;
    }
    shared.bodies.push_back({name, of_model, of_scene, poses[static_cast<std::size_t>(of_model)], 0, false});
    surfaces.emplace_back(surface_of(bones, of_model), surface_of(scene.bones, of_scene));
    any |= surfaces.back().first.faces.cols() > 0 || !model.bodies[static_cast<std::size_t>(of_model)].geometry.empty();
  }
  if (!any) return shared;
  std::vector<SharedBody> fitting;
  for (std::size_t i = 0; i < shared.bodies.size(); ++i) {
    const auto& [of_model, of_scene] = surfaces[i];
    const bool both = of_model.faces.cols() > 0 && of_scene.faces.cols() > 0;
    const std::string why =
        both ? register_body(of_model, of_scene, shared.bodies[i]) : "the model or the scene has no surface of it";
    if (why.empty())
      fitting.push_back(shared.bodies[i]);
    else
      shared.left_out.push_back(shared.bodies[i].name + ": " + why);
  }
  shared.bodies = std::move(fitting);
  return shared;
}

}  // namespace gracilis
