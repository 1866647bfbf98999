#include <gracilis/scene/validate_sizes.hpp>

#include <cmath>
#include <cstdio>
#include <string>

namespace gracilis {

static constexpr Real most_nodes = 1 << 30;  ///< of all distance fields: 4 GiB
static constexpr int most_fibers = 10'000;   ///< of a muscle: each is weighed against every end, 0.8 GiB
static constexpr Real most_points = 5e6;     ///< of all fibers of one kind: about 3 GiB with what follows the surface

/// "1.1e+09"
static std::string rounded(Real value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2g", value);
  return text;
}

/// Nodes of a bone's grid, as DistanceFieldSettings ask for it.
static Real field_nodes(const Bone& bone, const DistanceFieldSettings& settings) {
  if (settings.resolution > 0) return std::pow(settings.resolution + 1, 3);
  const Points& vertices = bone.surface.vertices;
  if (vertices.cols() == 0 || !vertices.allFinite()) return 0;  // reported with the surface
  const Vec3 extent = vertices.rowwise().maxCoeff() - vertices.rowwise().minCoeff();
  return ((extent.array() + 2 * settings.domain_margin) / settings.cell_size + 1).prod();
}

std::optional<Problem> grid_problem(const Scene& scene, const DistanceFieldSettings& settings, Problem asked) {
  Real nodes = 0;
  for (const Bone& bone : scene.bones) nodes += field_nodes(bone, settings);
  if (nodes <= most_nodes) return std::nullopt;
  asked.what += " asks for grids of " + rounded(nodes) + " nodes in all, " +
                rounded(nodes * sizeof(float) / (1 << 30)) + " GiB; " + rounded(most_nodes) +
                " are the most that are made";
  return asked;
}

static void check_fields(const Scene& scene, std::vector<Problem>& problems) {
  const DistanceFieldSettings& settings = scene.distance_fields;
  const bool by_resolution = settings.resolution > 0;
  if (!by_resolution && !(settings.cell_size > 0)) return;  // reported with the settings
  const Problem asked =
      by_resolution ? Problem{"", "distance_field", "'resolution'", "give a lower one"}
                    : Problem{"", "distance_field", "'cell_size'", "give larger cells or a smaller 'domain_margin'"};
  if (std::optional<Problem> problem = grid_problem(scene, settings, asked)) problems.push_back(std::move(*problem));
}

static void check_fibers(const Scene& scene, std::vector<Problem>& problems) {
  Real inner = 0, outer = 0;
  for (const Muscle& muscle : scene.muscles) {
    inner += Real(muscle.fibers.count) * (muscle.fibers.segments + 1);
    outer += Real(muscle.fibers.count) * (muscle.contraction.segments + 1);
  }
  for (const Muscle& muscle : scene.muscles)
    if (muscle.fibers.count > most_fibers)
      problems.push_back({"", "fibers",
                          "'count' asks for " + std::to_string(muscle.fibers.count) + " fibers in '" + muscle.name +
                              "'; " + std::to_string(most_fibers) +
                              " are the most that find their ends among each other",
                          "give fewer"});
  const auto require = [&](const char* where, const char* keys, Real points) {
    if (points <= most_points) return;
    problems.push_back({"", where,
                        std::string(keys) + " ask for " + rounded(points) + " points in all; " + rounded(most_points) +
                            " are the most that are made",
                        "give lower ones"});
  };
  require("fibers", "'count' and 'segments'", inner);
  require("contraction", "'segments' and the 'count' of fibers", outer);
}

std::vector<Problem> size_problems(const Scene& scene) {
  std::vector<Problem> problems;
  check_fields(scene, problems);
  check_fibers(scene, problems);
  return problems;
}

}  // namespace gracilis
