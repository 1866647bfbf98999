#pragma once

#include <gracilis/opensim/import/bone_files.hpp>
#include <gracilis/scene/scene.hpp>

#include <set>
#include <string>
#include <vector>

namespace gracilis {

/// A body that a model and a scene both have.
struct SharedBody {
  std::string name;
  Index of_model = 0, of_scene = 0;
  RigidTransform frame;  ///< from the model's body to the scene's world in its capture pose
  Real error = 0;        ///< m, root mean square between the surfaces' nearer parts; 0 where it was not registered
  bool registered = false;
};

struct SharedBodies {
  std::vector<SharedBody> bodies;
  std::vector<std::string> left_out;  ///< a sentence for each body of the scene that cannot be found in the model
};

/// Those of the `wanted` bodies of the scene that the model has by name, with the model's surfaces laid on the scene's
/// (closest_similarity, without its scale). `bones`: the model's, in their bodies' own frames. Where the model names
/// surfaces of none of these bodies, its frames are taken to be the scene's: each body lies where `poses` says that the
/// model has it in the scene's capture pose. Bodies whose sizes differ by more than 3 % are left out: they are not the
/// same bones.
SharedBodies shared_bodies(const opensim::Model& model, const Scene& scene, const std::set<Index>& wanted,
                           const std::vector<opensim::ModelBone>& bones, const std::vector<RigidTransform>& poses);

}  // namespace gracilis
