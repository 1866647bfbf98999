#include <gracilis/io/scene/method_problems.hpp>

#include <gracilis/methods/registry.hpp>
#include <gracilis/methods/xpbd/xpbd_method.hpp>
#include <gracilis/scene/validate_sizes.hpp>
#include <gracilis/strings/bone_distances.hpp>

namespace gracilis {

/// Whether fibers are pulled tight among the bones, for which fields of their own are made.
static bool has_far_fields(const Scene& scene) {
  return scene.method.name == "strings" || (scene.method.name == "xpbd" && needs_far_fields(scene));
}

std::vector<Problem> method_problems(const Scene& scene) {
  std::vector<Problem> problems = validate_method(scene);
  if (!problems.empty() || !has_far_fields(scene)) return problems;
  const Problem asked = {"", "strings", "pulling fibers tight",
                         "check the units of the bones, or cut away what is far"};
  if (std::optional<Problem> far = grid_problem(scene, strings::far_field_settings(), asked))
    problems.push_back(std::move(*far));
  return problems;
}

}  // namespace gracilis
